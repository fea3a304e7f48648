//! Differentiation on vectors.
//!
//! Two rules, never a component of `p`: a virtual rotation `dw` (body axes) moves a vector `A s` by
//! `A (dw x s)`, and time does the same with `w`. Everything else is the product rule.

use std::collections::BTreeMap;

use super::arena::{Arena, Expr};
use super::functions::AngleExpr;
use super::identities::TwoVectors;
use super::vector::{Frame, Space, Triple, VectorId, ZERO};
use crate::model::Function;

/// A vector expression of a constraint, bound to the bodies of a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum VectorExpr {
    /// A vector fixed on a body (in its principal axes), or on the ground (`None`).
    Fixed(Option<usize>, Triple),
    /// A point fixed on a body, from its centre of mass; or on the ground, from the global origin.
    Point(Option<usize>, Triple),
    /// A sum with signs and constant factors.
    Sum(Vec<(Expr, VectorExpr)>),
    /// A scalar expression times a vector expression.
    Scaled(Box<ScalarExpr>, Box<VectorExpr>),
    /// A cross product.
    Cross(Box<VectorExpr>, Box<VectorExpr>),
}

/// A scalar expression of a constraint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ScalarExpr {
    /// A number that does not depend on the state.
    Constant(Expr),
    /// A scalar product.
    Dot(Box<VectorExpr>, Box<VectorExpr>),
    /// A sum with constant factors.
    Sum(Vec<(Expr, ScalarExpr)>),
    /// A product.
    Product(Box<ScalarExpr>, Box<ScalarExpr>),
    /// The time.
    Time,
    /// A function.
    Function(Function, Box<ScalarExpr>),
    /// An angle over many turns.
    Angle(Box<AngleExpr>),
    /// The time derivative, which has no derivative of its own.
    Rate(Box<ScalarExpr>),
}

/// Position and rates of the bodies, as vectors.
#[derive(Clone, Debug)]
pub struct Motion {
    /// `r` of every body.
    pub position: Vec<VectorId>,
    /// `v` of every body.
    pub velocity: Vec<VectorId>,
    /// `w` of every body.
    pub spin: Vec<VectorId>,
    /// The components of `w` in body axes.
    pub spin_components: Vec<Triple>,
    /// The point of every body whose acceleration is an unknown and about which moments are taken,
    /// from the centre of mass in body axes: the centre of mass itself unless a plan says
    /// otherwise. Positions and velocities are always those of centres of mass.
    pub reference: Vec<Triple>,
    /// The time.
    pub time: Expr,
}

impl Motion {
    /// A point of a body from the point of reference.
    fn arm(&self, space: &mut Space, body: usize, point: Triple) -> Triple {
        let reference = self.reference[body];
        [0, 1, 2].map(|k| space.arena.sub(point[k], reference[k]))
    }
}

/// The gradient of a scalar: the force and the moment on every body by which a virtual motion
/// `(dr, dw)` is multiplied.
#[derive(Clone, Debug, Default)]
pub struct Gradient {
    force: BTreeMap<usize, Vec<(Expr, VectorId)>>,
    moment: BTreeMap<usize, Vec<(Expr, VectorId)>>,
    /// What is along a velocity by itself, not by way of a body.
    along: Vec<(usize, Expr)>,
    /// Whether nothing goes along velocities by itself, but all by way of the bodies.
    pub(super) is_by_bodies: bool,
}

impl Gradient {
    /// A gradient that is made of forces and moments on bodies alone, whatever coordinates know.
    #[must_use]
    pub fn by_bodies() -> Self {
        Self {
            is_by_bodies: true,
            ..Self::default()
        }
    }

    /// Adds a moment on a body.
    pub fn add_moment(&mut self, body: usize, moment: VectorId) {
        let moments = self.moment.entry(body).or_default();
        moments.push((Arena::ONE, moment));
    }

    /// Adds a generalised force on a velocity.
    pub(super) fn push_along(&mut self, velocity: usize, factor: Expr) {
        self.along.push((velocity, factor));
    }

    /// Adds what is along velocities by itself to the generalised forces on them.
    pub(crate) fn add_along(&self, arena: &mut Arena, generalised: &mut [Expr]) {
        for &(velocity, factor) in &self.along {
            generalised[velocity] = arena.add(generalised[velocity], factor);
        }
    }

    /// The factor of `dr` of a body.
    pub fn force(&self, space: &mut Space, body: usize) -> VectorId {
        space.sum(self.force.get(&body).into_iter().flatten().copied())
    }

    /// The factor of `dw` of a body.
    pub fn moment(&self, space: &mut Space, body: usize) -> VectorId {
        space.sum(self.moment.get(&body).into_iter().flatten().copied())
    }
}

pub(super) fn body_frame(body: Option<usize>) -> Frame {
    body.map_or(Frame::Global, Frame::Body)
}

impl VectorExpr {
    /// The vector itself.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(body, s) => space.native(body_frame(*body), *s),
            Self::Point(None, s) => space.native(Frame::Global, *s),
            Self::Point(Some(body), s) => {
                let arm = space.native(Frame::Body(*body), *s);
                space.sum([(Arena::ONE, motion.position[*body]), (Arena::ONE, arm)])
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.value(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let factor = factor.value(space, motion);
                let vector = vector.value(space, motion);
                space.scale(factor, vector)
            }
            Self::Cross(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.cross(Frame::Global, a, b)
            }
        }
    }

    /// The time derivative.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => space.native(Frame::Global, ZERO),
            Self::Fixed(Some(body), s) => {
                let vector = space.native(Frame::Body(*body), *s);
                space.cross(Frame::Body(*body), motion.spin[*body], vector)
            }
            Self::Point(Some(body), s) => {
                let arm = Self::Fixed(Some(*body), *s).rate(space, motion);
                space.sum([(Arena::ONE, motion.velocity[*body]), (Arena::ONE, arm)])
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.rate(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let (f, v) = (factor.value(space, motion), vector.value(space, motion));
                let (df, dv) = (factor.rate(space, motion), vector.rate(space, motion));
                space.sum([(df, v), (f, dv)])
            }
            Self::Cross(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (
                    space.cross(Frame::Global, da, b),
                    space.cross(Frame::Global, a, db),
                );
                space.sum([(Arena::ONE, first), (Arena::ONE, second)])
            }
        }
    }

    /// The second time derivative without the terms of `v'` and `w'`.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> VectorId {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => space.native(Frame::Global, ZERO),
            Self::Fixed(Some(body), s) => space.spun(*body, motion.spin_components[*body], *s),
            Self::Point(Some(body), s) => {
                let arm = motion.arm(space, *body, *s);
                space.spun(*body, motion.spin_components[*body], arm)
            }
            Self::Sum(terms) => {
                let terms: Vec<_> = terms
                    .iter()
                    .map(|(factor, term)| (*factor, term.bias(space, motion)))
                    .collect();
                space.sum(terms)
            }
            Self::Scaled(factor, vector) => {
                let (f, v) = (factor.value(space, motion), vector.value(space, motion));
                let (df, dv) = (factor.rate(space, motion), vector.rate(space, motion));
                let (ddf, ddv) = (factor.bias(space, motion), vector.bias(space, motion));
                let two = space.arena.constant(2.0);
                let mixed = space.arena.mul(two, df);
                space.sum([(ddf, v), (mixed, dv), (f, ddv)])
            }
            Self::Cross(a, b) => {
                let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, mixed, last) = (
                    space.cross(Frame::Global, dda, b),
                    space.cross(Frame::Global, da, db),
                    space.cross(Frame::Global, a, ddb),
                );
                let two = space.arena.constant(2.0);
                space.sum([(Arena::ONE, first), (two, mixed), (Arena::ONE, last)])
            }
        }
    }

    /// Adds the gradient of `covector . self`.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        factor: Expr,
        covector: VectorId,
        gradient: &mut Gradient,
    ) {
        match self {
            Self::Fixed(None, _) | Self::Point(None, _) => {}
            Self::Fixed(Some(body), s) => {
                // c . (dw x s) = dw . (s x c)
                let vector = space.native(Frame::Body(*body), *s);
                let covector = space.outside(covector, *body);
                let moment = space.cross(Frame::Body(*body), vector, covector);
                gradient
                    .moment
                    .entry(*body)
                    .or_default()
                    .push((factor, moment));
            }
            Self::Point(Some(body), s) => {
                gradient
                    .force
                    .entry(*body)
                    .or_default()
                    .push((factor, covector));
                let arm = motion.arm(space, *body, *s);
                Self::Fixed(Some(*body), arm).pull_back(space, motion, factor, covector, gradient);
            }
            Self::Sum(terms) => {
                for (coefficient, term) in terms {
                    let factor = space.arena.mul(factor, *coefficient);
                    term.pull_back(space, motion, factor, covector, gradient);
                }
            }
            Self::Scaled(scalar, vector) => {
                let value = scalar.value(space, motion);
                let scaled = space.arena.mul(factor, value);
                vector.pull_back(space, motion, scaled, covector, gradient);
                let vector = vector.value(space, motion);
                let along = space.dot(covector, vector);
                let seed = space.arena.mul(factor, along);
                scalar.pull_back(space, motion, seed, gradient);
            }
            Self::Cross(a, b) => {
                // c . (da x b) = da . (b x c) and c . (a x db) = db . (c x a)
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                let (on_a, on_b) = (
                    space.cross(Frame::Global, v, covector),
                    space.cross(Frame::Global, covector, u),
                );
                a.pull_back(space, motion, factor, on_a, gradient);
                b.pull_back(space, motion, factor, on_b, gradient);
            }
        }
    }
}

impl ScalarExpr {
    /// The number itself.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(value) => *value,
            Self::Dot(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.dot(a, b)
            }
            Self::Sum(terms) => weighted(space, motion, terms, Self::value),
            Self::Product(a, b) => {
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                space.arena.mul(a, b)
            }
            Self::Time => motion.time,
            Self::Function(function, inner) => {
                let inner = inner.value(space, motion);
                function.value(&mut space.arena, inner)
            }
            Self::Angle(angle) => angle.value(space, motion),
            Self::Rate(inner) => inner.rate(space, motion),
        }
    }

    /// The time derivative.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(_) => Arena::ZERO,
            Self::Dot(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (space.dot(da, b), space.dot(a, db));
                space.arena.add(first, second)
            }
            Self::Sum(terms) => weighted(space, motion, terms, Self::rate),
            Self::Product(a, b) => {
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let (first, second) = (space.arena.mul(da, b), space.arena.mul(a, db));
                space.arena.add(first, second)
            }
            Self::Time => Arena::ONE,
            Self::Function(function, inner) => {
                let (x, dx) = (inner.value(space, motion), inner.rate(space, motion));
                let slope = function.slope(&mut space.arena, x);
                space.arena.mul(slope, dx)
            }
            Self::Angle(angle) => angle.rate(space, motion),
            Self::Rate(_) => unreachable!("there is no rate of a rate in the language"),
        }
    }

    /// The second time derivative without the terms of `v'` and `w'`.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> Expr {
        match self {
            Self::Constant(_) => Arena::ZERO,
            Self::Dot(a, b) => match TwoVectors::of(a, b) {
                Some(pair) if space.has_identities() => space
                    .cheapest(&[false, true], |space, turning| {
                        if turning {
                            pair.bias(space, motion)
                        } else {
                            product_rule(space, motion, a, b)
                        }
                    })
                    .expect("two ways were tried"),
                _ => product_rule(space, motion, a, b),
            },
            Self::Sum(terms) => weighted(space, motion, terms, Self::bias),
            Self::Product(a, b) => {
                let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
                let (da, db) = (a.rate(space, motion), b.rate(space, motion));
                let (a, b) = (a.value(space, motion), b.value(space, motion));
                let arena = &mut space.arena;
                let (first, mixed, last) =
                    (arena.mul(dda, b), arena.mul(da, db), arena.mul(a, ddb));
                let twice = arena.add(mixed, mixed);
                arena.sum([first, twice, last])
            }
            Self::Time => Arena::ZERO,
            Self::Function(function, inner) => {
                let (x, dx) = (inner.value(space, motion), inner.rate(space, motion));
                let ddx = inner.bias(space, motion);
                let arena = &mut space.arena;
                let (slope, curvature) = (function.slope(arena, x), function.curvature(arena, x));
                let square = arena.square(dx);
                let (first, second) = (arena.mul(curvature, square), arena.mul(slope, ddx));
                arena.add(first, second)
            }
            Self::Angle(angle) => angle.bias(space, motion),
            Self::Rate(_) => unreachable!("there is no rate of a rate in the language"),
        }
    }

    /// Adds `seed` times the gradient.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        seed: Expr,
        gradient: &mut Gradient,
    ) {
        match self {
            Self::Constant(_) => {}
            Self::Dot(a, b) => {
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                a.pull_back(space, motion, seed, v, gradient);
                b.pull_back(space, motion, seed, u, gradient);
            }
            Self::Sum(terms) => {
                for (factor, term) in terms {
                    let seed = space.arena.mul(seed, *factor);
                    term.pull_back(space, motion, seed, gradient);
                }
            }
            Self::Product(a, b) => {
                let (u, v) = (a.value(space, motion), b.value(space, motion));
                let (on_a, on_b) = (space.arena.mul(seed, v), space.arena.mul(seed, u));
                a.pull_back(space, motion, on_a, gradient);
                b.pull_back(space, motion, on_b, gradient);
            }
            Self::Time => {}
            Self::Function(function, inner) => {
                let x = inner.value(space, motion);
                let slope = function.slope(&mut space.arena, x);
                let seed = space.arena.mul(seed, slope);
                inner.pull_back(space, motion, seed, gradient);
            }
            Self::Angle(angle) => angle.pull_back(space, motion, seed, gradient),
            Self::Rate(_) => unreachable!("only positions have a gradient in the language"),
        }
    }
}

/// `(a . b)''` without accelerations, by the product rule.
fn product_rule(space: &mut Space, motion: &Motion, a: &VectorExpr, b: &VectorExpr) -> Expr {
    let (dda, ddb) = (a.bias(space, motion), b.bias(space, motion));
    let (da, db) = (a.rate(space, motion), b.rate(space, motion));
    let (a, b) = (a.value(space, motion), b.value(space, motion));
    let (first, mixed, last) = (space.dot(dda, b), space.dot(da, db), space.dot(a, ddb));
    let twice = space.arena.add(mixed, mixed);
    space.arena.sum([first, twice, last])
}

fn weighted(
    space: &mut Space,
    motion: &Motion,
    terms: &[(Expr, ScalarExpr)],
    of: impl Fn(&ScalarExpr, &mut Space, &Motion) -> Expr,
) -> Expr {
    let mut sum = Arena::ZERO;
    for (factor, term) in terms {
        let value = of(term, space, motion);
        let product = space.arena.mul(*factor, value);
        sum = space.arena.add(sum, product);
    }
    sum
}
