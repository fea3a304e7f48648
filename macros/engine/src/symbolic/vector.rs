//! The vector level: vectors that know their frame, above the scalar level.
//!
//! A vector is one thing whatever axes it is written in; its components are computed on demand, once per frame, from where
//! they are cheapest. A vector given in body axes and asked for in body axes never passes through `A A^T`: this is how
//! `A^T A = I` holds without ever being written down.
//!
//! That is true where `A` is a rotation. A space that has to be exact for `A` of any scale ([`Space::exact`]) computes every
//! vector in its home, the frame in which it is defined, and turns it from there.

use std::collections::HashMap;

use super::arena::{Arena, Expr, Mark};

/// The axes that components refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Frame {
    /// The axes of the ground.
    Global,
    /// The principal axes of a body.
    Body(usize),
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
    index: HashMap<Vector, VectorId>,
    components: HashMap<(VectorId, Frame), Triple>,
    history: Vec<(VectorId, Frame)>,
    /// `A` of every body, from body to global axes, row by row; `None` for a body without orientation.
    rotations: Vec<Option<[Triple; 3]>>,
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

    /// The same space, exact where `A` is a multiple of a rotation. To be called before anything is computed.
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
        attempt(self);
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
        let best = match candidates {
            [] => return None,
            [only] => *only,
            _ => {
                let costs = candidates
                    .iter()
                    .map(|&c| (self.cost(|space| attempt(space, c)), c));
                let mut best: Option<(usize, C)> = None;
                for (cost, candidate) in costs.collect::<Vec<_>>() {
                    if best.is_none_or(|(least, _)| cost < least) {
                        best = Some((cost, candidate));
                    }
                }
                best?.1
            }
        };
        Some(attempt(self, best))
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

    /// The frame in which a vector is defined.
    fn home(&self, vector: VectorId) -> Frame {
        match &self.vectors[vector.0 as usize] {
            Vector::Native(frame, _) | Vector::Cross(frame, ..) => *frame,
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
        }
    }

    /// The components of a vector in a frame, computed in the frame where that is cheapest and turned from there.
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
        let components = self
            .cheapest(&frames, |space, within| {
                let components = space.components_within(vector, within);
                space.turn(components, within, frame)
            })
            .unwrap_or(ZERO);
        self.components.insert((vector, frame), components);
        self.history.push((vector, frame));
        components
    }

    /// The components, with every operation done in the frame itself.
    fn components_within(&mut self, vector: VectorId, frame: Frame) -> Triple {
        match self.vectors[vector.0 as usize].clone() {
            Vector::Native(native, components) => self.turn(components, native, frame),
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
        }
    }

    /// Components in another frame.
    pub fn turn(&mut self, components: Triple, from: Frame, to: Frame) -> Triple {
        if from == to || components == ZERO {
            return components;
        }
        match (from, to) {
            (Frame::Body(body), Frame::Global) => match self.rotations[body] {
                Some(rows) => rows.map(|row| dot(&mut self.arena, row, components)),
                None => components,
            },
            (Frame::Global, Frame::Body(body)) => match self.rotations[body] {
                Some(rows) => [0, 1, 2].map(|k| {
                    let column = [rows[0][k], rows[1][k], rows[2][k]];
                    dot(&mut self.arena, column, components)
                }),
                None => components,
            },
            _ => {
                let global = self.turn(components, from, Frame::Global);
                self.turn(global, Frame::Global, to)
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
        self.cheapest(&frames, |space, frame| {
            let a = space.components(a, frame);
            let b = space.components(b, frame);
            dot(&mut space.arena, a, b)
        })
        .unwrap_or(Arena::ZERO)
    }
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
