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

use std::collections::VecDeque;

use super::arena::{Arena, Expr, Mark};
use super::table::Table;

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
    /// `w` and its components in body axes.
    spin: VectorId,
    components: Triple,
    /// `a` and its components in body axes.
    vector: VectorId,
    fixed: Triple,
}

/// A place in the history of a space, to come back to.
#[derive(Clone, Copy, Debug)]
pub struct SpaceMark {
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
    /// Whether identities of rotations are tried beside the product rule.
    identities: bool,
    /// Trials within trials that are going on.
    trials: usize,
    /// The choices made in the trial that is going on, in the order in which they were needed.
    choices: Vec<usize>,
    /// Those that are known, from the trial of what is being done.
    known_choices: VecDeque<usize>,
}

/// Trials within trials; deeper down, the first candidate is taken. Without a bound, their number
/// is exponential in the depth of a vector.
const MOST_TRIALS: usize = 4;

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

    /// The same space, trying identities of rotations. To be called before anything is computed.
    #[must_use]
    pub fn with_identities(mut self) -> Self {
        self.identities = true;
        self
    }

    /// Whether identities of rotations are tried beside the product rule.
    #[must_use]
    pub fn has_identities(&self) -> bool {
        self.identities
    }

    /// The rotation matrix of a body.
    #[must_use]
    pub fn rotation(&self, body: usize) -> Option<&[Triple; 3]> {
        self.rotations[body].as_ref()
    }

    /// The present place, for [`Space::rollback`].
    #[must_use]
    pub fn mark(&self) -> SpaceMark {
        SpaceMark {
            arena: self.arena.mark(),
            vectors: self.vectors.len(),
            components: self.history.len(),
        }
    }

    /// Forgets everything made since the mark.
    pub fn rollback(&mut self, mark: SpaceMark) {
        for key in self.history.drain(mark.components..) {
            self.components.remove(&key);
        }
        for vector in self.vectors.drain(mark.vectors..) {
            self.index.remove(&vector);
        }
        self.arena.rollback(mark.arena);
    }

    /// What something would cost, in operations at every evaluation; nothing is kept.
    pub fn cost<T>(&mut self, attempt: impl FnOnce(&mut Self) -> T) -> usize {
        let mark = self.mark();
        self.trials += 1;
        attempt(self);
        self.trials -= 1;
        let cost = self.arena.operations_since(mark.arena);
        self.rollback(mark);
        cost
    }

    /// Does the cheapest of some attempts; the first on ties.
    pub fn cheapest<C: Copy, T>(
        &mut self,
        candidates: &[C],
        mut attempt: impl FnMut(&mut Self, C) -> T,
    ) -> Option<T> {
        let place = match candidates {
            [] => return None,
            [_] => 0,
            _ if !self.known_choices.is_empty() => {
                let known = self.known_choices.pop_front().expect("not empty");
                self.choices.push(known);
                known
            }
            _ if self.trials >= MOST_TRIALS => {
                self.choices.push(0);
                0
            }
            _ => {
                let before = self.choices.len();
                let mut best: Option<(usize, usize, Vec<usize>)> = None;
                for (place, &candidate) in candidates.iter().enumerate() {
                    let cost = self.cost(|space| attempt(space, candidate));
                    let choices = self.choices.drain(before..);
                    if best.as_ref().is_none_or(|(least, ..)| cost < *least) {
                        best = Some((cost, place, choices.collect()));
                    }
                    if cost == 0 {
                        break;
                    }
                }
                let (_, place, choices) = best?;
                // What is done now was just tried: with the same choices all the way down.
                self.known_choices = choices.into();
                self.choices.push(place);
                place
            }
        };
        let done = attempt(self, candidates[place]);
        if self.trials == 0 && self.known_choices.is_empty() {
            self.choices.clear();
        }
        Some(done)
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
        let frame = Frame::Body(body);
        let spun = Spun {
            body,
            spin: self.native(frame, spin),
            components: spin,
            vector: self.native(frame, fixed),
            fixed,
        };
        let spun = self.intern(Vector::Spun(spun));
        self.scale(factor, spun)
    }

    /// A vector as a multiple of one that parallel vectors have in common.
    pub fn direction(&mut self, vector: Triple) -> (Expr, Triple) {
        let mut components = vector.into_iter().filter(|&c| c != Arena::ZERO);
        let (first, other) = (components.next(), components.next());
        let Some(first) = first.filter(|_| !self.identities && !self.exact) else {
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
        match &self.vectors[vector.0 as usize] {
            Vector::Native(_, ZERO) => {}
            Vector::Native(frame, _) => {
                if !frames.contains(frame) {
                    frames.push(*frame);
                }
            }
            Vector::Sum(terms) => {
                for &(_, term) in terms {
                    self.native_frames(term, frames);
                }
            }
            Vector::Cross(_, a, b) => {
                self.native_frames(*a, frames);
                self.native_frames(*b, frames);
            }
            Vector::Spun(spun) => self.native_frames(spun.vector, frames),
        }
    }

    /// The components of a vector in a frame, computed in the frame where that is cheapest and
    /// turned from there.
    pub fn components(&mut self, vector: VectorId, frame: Frame) -> Triple {
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
            .cheapest(&ways, |space, (within, at_once)| {
                let components = space.components_within(vector, within);
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

    /// Says that the components of a vector in a frame are known.
    pub fn give(&mut self, vector: VectorId, frame: Frame, components: Triple) {
        self.components.insert((vector, frame), components);
        self.history.push((vector, frame));
    }

    /// The components, with every operation done in the frame itself.
    fn components_within(&mut self, vector: VectorId, frame: Frame) -> Triple {
        match self.vectors[vector.0 as usize].clone() {
            Vector::Native(native, components)
                if !self.identities || frame == native || frame == Frame::Global =>
            {
                self.turn(components, native, frame)
            }
            Vector::Native(..) => {
                let global = self.components(vector, Frame::Global);
                self.turn(global, Frame::Global, frame)
            }
            Vector::Sum(terms) => {
                let mut sum = ZERO;
                for (factor, term) in terms {
                    let term = self.components(term, frame);
                    for (sum, component) in sum.iter_mut().zip(term) {
                        let product = self.arena.mul(factor, component);
                        *sum = self.arena.add(*sum, product);
                    }
                }
                sum
            }
            Vector::Cross(_, a, b) => {
                let a = self.components(a, frame);
                let b = self.components(b, frame);
                cross(&mut self.arena, a, b)
            }
            Vector::Spun(spun) => self.spun_within(spun, frame),
        }
    }

    /// From the products `w_k w_l` in body axes; by Lagrange's identity `(w . a) w - (w . w) a`
    /// elsewhere.
    fn spun_within(&mut self, spun: Spun, frame: Frame) -> Triple {
        let own = Frame::Body(spun.body);
        if frame == own || !self.identities {
            let components = spin_twice(&mut self.arena, spun.components, spun.fixed);
            return self.turn(components, own, frame);
        }
        let along = self.dot(spun.spin, spun.vector);
        let square = self.dot(spun.spin, spun.spin);
        let (w, a) = (
            self.components(spun.spin, frame),
            self.components(spun.vector, frame),
        );
        [0, 1, 2].map(|k| {
            let first = self.arena.mul(along, w[k]);
            let second = self.arena.mul(square, a[k]);
            self.arena.sub(first, second)
        })
    }

    /// `a . b`, in the frame where it is cheapest, or by an identity where that is cheaper.
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
                if self.identities && !frames.contains(&Frame::Global) {
                    frames.push(Frame::Global);
                }
            }
        }
        let mut ways: Vec<Option<Frame>> = frames.into_iter().map(Some).collect();
        if self.identities && self.identity(a, b).is_some() {
            ways.push(None);
        }
        self.cheapest(&ways, |space, way| match (way, space.identity(a, b)) {
            (None, Some(identity)) => space.apply(identity),
            (way, _) => {
                let frame = way.unwrap_or(Frame::Global);
                let a = space.components(a, frame);
                let b = space.components(b, frame);
                dot(&mut space.arena, a, b)
            }
        })
        .expect("vectors are defined in some frame")
    }

    /// Another way to a scalar product.
    fn identity(&self, a: VectorId, b: VectorId) -> Option<Identity> {
        match (&self.vectors[a.0 as usize], &self.vectors[b.0 as usize]) {
            (Vector::Sum(terms), _) if self.is_spinning(terms) => {
                Some(Identity::Distribute(terms.clone(), b))
            }
            (_, Vector::Sum(terms)) if self.is_spinning(terms) => {
                Some(Identity::Distribute(terms.clone(), a))
            }
            (Vector::Spun(spun), _) => Some(Identity::Lagrange(*spun, b)),
            (_, Vector::Spun(spun)) => Some(Identity::Lagrange(*spun, a)),
            (Vector::Cross(_, a, b), Vector::Cross(_, c, d)) => {
                Some(Identity::Crosses([*a, *b, *c, *d]))
            }
            _ => None,
        }
    }

    fn is_spinning(&self, terms: &[(Expr, VectorId)]) -> bool {
        terms
            .iter()
            .any(|(_, term)| matches!(self.vectors[term.0 as usize], Vector::Spun(_)))
    }

    fn apply(&mut self, identity: Identity) -> Expr {
        match identity {
            Identity::Distribute(terms, other) => {
                let mut sum = Arena::ZERO;
                for (factor, term) in terms {
                    let product = self.dot(term, other);
                    let product = self.arena.mul(factor, product);
                    sum = self.arena.add(sum, product);
                }
                sum
            }
            Identity::Lagrange(spun, other) => {
                let (along, across) =
                    (self.dot(spun.spin, spun.vector), self.dot(spun.spin, other));
                let (square, share) =
                    (self.dot(spun.spin, spun.spin), self.dot(spun.vector, other));
                let first = self.arena.mul(along, across);
                let second = self.arena.mul(square, share);
                self.arena.sub(first, second)
            }
            Identity::Crosses([a, b, c, d]) => {
                let (ac, bd) = (self.dot(a, c), self.dot(b, d));
                let (ad, bc) = (self.dot(a, d), self.dot(b, c));
                let first = self.arena.mul(ac, bd);
                let second = self.arena.mul(ad, bc);
                self.arena.sub(first, second)
            }
        }
    }
}

/// A way to a scalar product that needs no components.
enum Identity {
    /// Term by term of a sum.
    Distribute(Vec<(Expr, VectorId)>, VectorId),
    /// `(w x (w x a)) . b = (w . a) (w . b) - (w . w) (a . b)`.
    Lagrange(Spun, VectorId),
    /// `(a x b) . (c x d) = (a . c) (b . d) - (a . d) (b . c)`.
    Crosses([VectorId; 4]),
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
