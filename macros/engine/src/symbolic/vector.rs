//! The vector level: vectors that know their frame, above the scalar level.
//!
//! A vector is one thing whatever axes it is written in; its components are computed on demand,
//! once per frame, from where they are cheapest. A vector given in body axes and asked for in body
//! axes never passes through `A A^T`: this is how `A^T A = I` holds without ever being written
//! down.
//!
//! That is true where `A` is a rotation. A space that has to be exact for `A` of any scale
//! ([`Space::exact`]) computes every vector in its home, the frame in which it is defined, and
//! turns it from there.

use super::arena::{Arena, Expr, Mark};
use super::table::Table;
use search::Search;

mod search;
mod turns;

/// The axes that components refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Frame {
    /// The axes of the ground.
    Global,
    /// The principal axes of a body.
    Body(usize),
}

impl Frame {
    /// The axes of a body, or of the ground (`None`).
    pub(super) fn of(body: Option<usize>) -> Self {
        body.map_or(Self::Global, Self::Body)
    }
}

/// Three components.
pub type Triple = [Expr; 3];

/// The zero vector in any frame.
pub const ZERO: Triple = [Arena::ZERO; 3];

/// A reference to a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VectorId(u32);

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Vector {
    /// Components known in a frame.
    Native(Frame, Triple),
    /// A sum of multiples.
    Sum(Vec<(Expr, VectorId)>),
    /// A cross product, and the frame in which it is defined.
    Cross(Frame, VectorId, VectorId),
    /// `w x (w x a)` of a vector `a` fixed on a body.
    Spun(Spun),
}

/// `w x (w x a)` of a vector fixed on a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Spun {
    body: usize,
    /// `w`, body axes.
    spin: Triple,
    /// `a`, body axes.
    fixed: Triple,
}

/// A place in the history of a space, to come back to.
#[derive(Clone, Copy, Debug)]
struct SpaceMark {
    arena: Mark,
    vectors: usize,
    components: usize,
}

/// The vectors of a kernel and the arena of their components.
#[derive(Clone, Debug, Default)]
pub struct Space {
    /// The scalar level.
    pub arena: Arena,
    vectors: Vec<Vector>,
    index: Table<Vector, VectorId>,
    components: Table<(VectorId, Frame), Triple>,
    history: Vec<(VectorId, Frame)>,
    /// `A` of every body, from body to global axes, row by row; `None` for a body without
    /// orientation.
    rotations: Vec<Option<[Triple; 3]>>,
    /// Bodies whose vectors may be turned from the one to the other without global axes.
    related: Vec<[usize; 2]>,
    /// Whether `A` may be any multiple of a rotation.
    exact: bool,
}

impl Space {
    /// A space for bodies with the given rotation matrices.
    #[must_use]
    pub fn new(arena: Arena, rotations: Vec<Option<[Triple; 3]>>) -> Self {
        Self {
            arena,
            rotations,
            ..Self::default()
        }
    }

    /// The same space, exact where `A` is a multiple of a rotation. To be called before anything is
    /// computed.
    #[must_use]
    pub fn exact(mut self) -> Self {
        self.exact = true;
        self
    }

    /// The rotation matrix of a body.
    #[must_use]
    pub fn rotation(&self, body: usize) -> Option<&[Triple; 3]> {
        self.rotations[body].as_ref()
    }

    /// The present place, for [`Space::rollback`].
    fn mark(&self) -> SpaceMark {
        SpaceMark {
            arena: self.arena.mark(),
            vectors: self.vectors.len(),
            components: self.history.len(),
        }
    }

    /// Forgets everything made since the mark.
    fn rollback(&mut self, mark: SpaceMark) {
        for key in self.history.drain(mark.components..) {
            self.components.remove(&key);
        }
        for vector in self.vectors.drain(mark.vectors..) {
            self.index.remove(&vector);
        }
        self.arena.rollback(mark.arena);
    }

    /// Does the cheapest of some attempts, in operations at every evaluation; the first on ties.
    fn cheapest<C: Copy, T>(
        &mut self,
        search: &mut Search,
        candidates: &[C],
        mut attempt: impl FnMut(&mut Self, &mut Search, C) -> T,
    ) -> Option<T> {
        let place = search.choose(candidates.len(), |search, place| {
            let mark = self.mark();
            attempt(self, search, candidates[place]);
            let cost = self.arena.operations_since(mark.arena);
            self.rollback(mark);
            cost
        })?;
        Some(attempt(self, search, candidates[place]))
    }

    fn intern(&mut self, vector: Vector) -> VectorId {
        if let Some(&id) = self.index.get(&vector) {
            return id;
        }
        let id = VectorId(u32::try_from(self.vectors.len()).expect("fewer than 2^32 vectors"));
        self.vectors.push(vector.clone());
        self.index.insert(vector, id);
        id
    }

    /// A vector by its components in a frame.
    pub fn native(&mut self, frame: Frame, components: Triple) -> VectorId {
        let frame = if components == ZERO {
            Frame::Global
        } else {
            frame
        };
        self.intern(Vector::Native(frame, components))
    }

    /// Whether the vector is zero for every state.
    #[must_use]
    pub fn is_zero(&self, vector: VectorId) -> bool {
        matches!(self.vectors[vector.0 as usize], Vector::Native(_, ZERO))
    }

    /// A sum of multiples.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (Expr, VectorId)>) -> VectorId {
        let terms: Vec<_> = terms
            .into_iter()
            .filter(|&(factor, vector)| factor != Arena::ZERO && !self.is_zero(vector))
            .collect();
        match terms[..] {
            [] => self.native(Frame::Global, ZERO),
            [(Arena::ONE, vector)] => vector,
            _ => self.intern(Vector::Sum(terms)),
        }
    }

    /// `factor * vector`.
    pub fn scale(&mut self, factor: Expr, vector: VectorId) -> VectorId {
        self.sum([(factor, vector)])
    }

    /// `a x b`, defined in a frame: the axes of a body for what turns with it, else global.
    pub fn cross(&mut self, home: Frame, a: VectorId, b: VectorId) -> VectorId {
        if self.is_zero(a) || self.is_zero(b) || a == b {
            return self.native(Frame::Global, ZERO);
        }
        self.intern(Vector::Cross(home, a, b))
    }

    /// `w x (w x a)` of a vector `a` fixed on a body, from components in body axes.
    pub fn spun(&mut self, body: usize, spin: Triple, fixed: Triple) -> VectorId {
        if fixed == ZERO {
            return self.native(Frame::Global, ZERO);
        }
        let (factor, fixed) = self.direction(fixed);
        let spun = self.intern(Vector::Spun(Spun { body, spin, fixed }));
        self.scale(factor, spun)
    }

    /// A vector as a multiple of one that parallel vectors have in common.
    pub fn direction(&mut self, vector: Triple) -> (Expr, Triple) {
        let mut components = vector.into_iter().filter(|&c| c != Arena::ZERO);
        let (first, other) = (components.next(), components.next());
        let Some(first) = first.filter(|_| !self.exact) else {
            return (Arena::ONE, vector);
        };
        let is_known = |c: &Expr| self.arena.literal(*c).is_some();
        if other.is_some() && !vector.iter().all(is_known) {
            return (Arena::ONE, vector);
        }
        (first, vector.map(|c| self.arena.div(c, first)))
    }

    /// The frame in which a vector is defined.
    fn home(&self, vector: VectorId) -> Frame {
        match &self.vectors[vector.0 as usize] {
            Vector::Native(frame, _) | Vector::Cross(frame, ..) => *frame,
            Vector::Spun(spun) => Frame::Body(spun.body),
            Vector::Sum(terms) => {
                let mut homes = terms.iter().map(|&(_, term)| self.home(term));
                let first = homes.next().unwrap_or(Frame::Global);
                if homes.all(|home| home == first) {
                    first
                } else {
                    Frame::Global
                }
            }
        }
    }

    /// The frames in which parts of the vector are known.
    fn native_frames(&self, vector: VectorId, frames: &mut Vec<Frame>) {
        let add = |frame: Frame, frames: &mut Vec<Frame>| {
            if !frames.contains(&frame) {
                frames.push(frame);
            }
        };
        match &self.vectors[vector.0 as usize] {
            Vector::Native(_, ZERO) => {}
            Vector::Native(frame, _) => add(*frame, frames),
            Vector::Sum(terms) => {
                for &(_, term) in terms {
                    self.native_frames(term, frames);
                }
            }
            Vector::Cross(_, a, b) => {
                self.native_frames(*a, frames);
                self.native_frames(*b, frames);
            }
            Vector::Spun(spun) => add(Frame::Body(spun.body), frames),
        }
    }

    /// The components of a vector in a frame, computed in the frame where that is cheapest and
    /// turned from there.
    pub fn components(&mut self, vector: VectorId, frame: Frame) -> Triple {
        self.components_by(&mut Search::default(), vector, frame)
    }

    fn components_by(&mut self, search: &mut Search, vector: VectorId, frame: Frame) -> Triple {
        if let Some(&known) = self.components.get(&(vector, frame)) {
            return known;
        }
        let mut frames = vec![frame];
        if self.exact {
            frames = vec![self.home(vector)];
        } else {
            self.native_frames(vector, &mut frames);
        }
        let related = frames
            .iter()
            .filter(|&&within| self.is_related(within, frame));
        let ways = frames.iter().map(|&within| (within, false));
        let ways: Vec<(Frame, bool)> = ways.chain(related.map(|&within| (within, true))).collect();
        let components = self
            .cheapest(search, &ways, |space, search, (within, at_once)| {
                let components = space.components_within(search, vector, within);
                if at_once {
                    space.turn_at_once(components, within, frame)
                } else {
                    space.turn(components, within, frame)
                }
            })
            .expect("a vector is defined in some frame");
        self.components.insert((vector, frame), components);
        self.history.push((vector, frame));
        components
    }

    /// A vector as it is to be multiplied with what turns with a body. Where `A` may have any
    /// scale, a vector of the body itself is known by its global components then: `A a . A (d x s)`
    /// is `d . (s x A^T A a)`, and not `d . (s x a)`.
    pub fn outside(&mut self, vector: VectorId, body: usize) -> VectorId {
        if !self.exact || self.home(vector) != Frame::Body(body) {
            return vector;
        }
        let components = self.components(vector, Frame::Global);
        self.native(Frame::Global, components)
    }

    /// A vector as the factor of what turns with a body. Where `A` may have any scale, it is known
    /// by its components `A^T a` in the axes of the body: a sum with the moments of forces, which
    /// are given there, would be turned out and back otherwise.
    pub fn moment_on(&mut self, vector: VectorId, body: usize) -> VectorId {
        if !self.exact {
            return vector;
        }
        let frame = Frame::Body(body);
        let outside = self.outside(vector, body);
        let components = self.components(outside, frame);
        self.native(frame, components)
    }

    /// The components, with every operation done in the frame itself.
    fn components_within(&mut self, search: &mut Search, vector: VectorId, frame: Frame) -> Triple {
        match self.vectors[vector.0 as usize].clone() {
            Vector::Native(native, components) => self.turn(components, native, frame),
            Vector::Sum(terms) => {
                let mut sum = ZERO;
                for (factor, term) in terms {
                    let term = self.components_by(search, term, frame);
                    for (sum, component) in sum.iter_mut().zip(term) {
                        let product = self.arena.mul(factor, component);
                        *sum = self.arena.add(*sum, product);
                    }
                }
                sum
            }
            Vector::Cross(_, a, b) => {
                let a = self.components_by(search, a, frame);
                let b = self.components_by(search, b, frame);
                cross(&mut self.arena, a, b)
            }
            // From the products `w_k w_l` in body axes.
            Vector::Spun(Spun { body, spin, fixed }) => {
                let components = spin_twice(&mut self.arena, spin, fixed);
                self.turn(components, Frame::Body(body), frame)
            }
        }
    }

    /// `a . b`, in the frame where it is cheapest.
    pub fn dot(&mut self, a: VectorId, b: VectorId) -> Expr {
        if self.is_zero(a) || self.is_zero(b) {
            return Arena::ZERO;
        }
        let mut frames = Vec::new();
        match (self.exact, self.home(a), self.home(b)) {
            (true, first, second) if first == second => frames.push(Frame::Global),
            (true, first, second) => frames.extend([first, second]),
            (false, ..) => {
                self.native_frames(a, &mut frames);
                self.native_frames(b, &mut frames);
            }
        }
        self.cheapest(&mut Search::default(), &frames, |space, search, frame| {
            let a = space.components_by(search, a, frame);
            let b = space.components_by(search, b, frame);
            dot(&mut space.arena, a, b)
        })
        .expect("vectors are defined in some frame")
    }
}

/// `w x (w x s)` in body axes, from the products `w_k w_l` that all vectors of the body share.
fn spin_twice(arena: &mut Arena, w: Triple, s: Triple) -> Triple {
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].map(|(k, l, m)| {
        let mut sum = Arena::ZERO;
        for (other, component) in [(l, s[l]), (m, s[m])] {
            let product = arena.mul(w[k], w[other]);
            let term = arena.mul(component, product);
            sum = arena.add(sum, term);
        }
        if s[k] == Arena::ZERO {
            return sum;
        }
        let first = arena.square(w[l.min(m)]);
        let second = arena.square(w[l.max(m)]);
        let squares = arena.add(first, second);
        let term = arena.mul(s[k], squares);
        arena.sub(sum, term)
    })
}

/// The scalar product of components in one frame.
pub fn dot(arena: &mut Arena, a: Triple, b: Triple) -> Expr {
    let products = [0, 1, 2].map(|k| arena.mul(a[k], b[k]));
    arena.sum(products)
}

/// The cross product of components in one frame.
pub fn cross(arena: &mut Arena, a: Triple, b: Triple) -> Triple {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| {
        let forth = arena.mul(a[k], b[l]);
        let back = arena.mul(a[l], b[k]);
        arena.sub(forth, back)
    })
}
