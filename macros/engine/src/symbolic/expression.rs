//! Expressions of constraints and forces, bound to the bodies of a mechanism.

use super::arena::{Arena, Expr, Input};
use super::vector::Triple;
use crate::model::Function;

/// A vector expression, bound to the bodies of a mechanism.
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
    /// The time derivative, in global axes.
    Rate(Box<VectorExpr>),
    /// The angular velocity of the second body against the first.
    Spin([Option<usize>; 2]),
}

/// A scalar expression, bound to the bodies of a mechanism.
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
    /// An angle from `-pi` to `pi`, which counts no turns.
    Direction(Box<AngleExpr>),
    /// An input with its first and second derivative.
    Setpoint([Expr; 3]),
    /// The time derivative.
    Rate(Box<ScalarExpr>),
    /// The side of an expression that switches.
    Side {
        /// The side that is held; zero where it is that of the expression.
        held: Expr,
        /// The expression.
        of: Box<ScalarExpr>,
    },
    /// The first of two expressions where a side is not negative, else the second.
    Select {
        /// The side.
        side: Box<ScalarExpr>,
        /// The expressions.
        parts: Box<[ScalarExpr; 2]>,
    },
    /// A state of the user's own.
    State {
        /// Its place among these.
        place: usize,
        /// Its value.
        value: Expr,
    },
}

/// An angle by multiples of its sine and cosine, and the auxiliary variable near which it lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AngleExpr {
    /// The sine, times a positive number.
    pub sine: ScalarExpr,
    /// The cosine, times the same number.
    pub cosine: ScalarExpr,
    /// The auxiliary variable that counts turns.
    pub near: Expr,
    /// The angle by the coordinates, where these hold it.
    pub paired: Option<PairedAngle>,
}

/// An angle whose cosine and sine are known by pairs of the coordinates, its rate by velocities.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PairedAngle {
    pub(super) cosine: Expr,
    pub(super) sine: Expr,
    /// The velocities that it is the integral of, each with a factor.
    pub(super) along: Vec<(usize, Expr)>,
}

/// What knows an angle by the coordinates: that of the second body against the first about an axis,
/// which is given in the reference configuration by a vector of unit length.
pub(crate) type PairedAngles<'a> =
    dyn Fn(&mut Arena, [Option<usize>; 2], Triple) -> Option<PairedAngle> + 'a;

impl PairedAngle {
    /// Of two bodies that do not turn against each other.
    pub const ZERO: Self = Self {
        cosine: Arena::ONE,
        sine: Arena::ZERO,
        along: Vec::new(),
    };

    /// The angle and another one, forwards or backwards (`sign` is 1 or -1).
    #[must_use]
    pub fn plus(
        mut self,
        arena: &mut Arena,
        velocity: usize,
        cosine: Expr,
        sine: Expr,
        sign: Expr,
    ) -> Self {
        let sine = arena.mul(sign, sine);
        let (cc, ss) = (arena.mul(self.cosine, cosine), arena.mul(self.sine, sine));
        let (sc, cs) = (arena.mul(self.sine, cosine), arena.mul(self.cosine, sine));
        self.cosine = arena.sub(cc, ss);
        self.sine = arena.add(sc, cs);
        self.along.push((velocity, sign));
        self
    }

    /// The time derivative.
    pub(super) fn rate(&self, arena: &mut Arena) -> Expr {
        let terms = self.along.iter().map(|&(velocity, sign)| {
            let rate = arena.input(Input::Velocity(velocity as u32));
            arena.mul(sign, rate)
        });
        let terms: Vec<Expr> = terms.collect();
        arena.sum(terms)
    }
}

/// One constraint of a mechanism.
#[derive(Clone, Debug)]
pub enum Constraint {
    /// One equation.
    Scalar(ScalarExpr),
    /// Three equations, in whatever axes.
    Vector(VectorExpr),
}
