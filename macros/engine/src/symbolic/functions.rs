//! Functions of scalars and their derivatives.

use super::arena::{Arena, Expr, Input};
use super::differentiate::{Gradient, Motion, ScalarExpr};
use super::vector::{Space, Triple};
use crate::model::Function;

impl Function {
    /// `f(x)`.
    pub fn value(self, arena: &mut Arena, x: Expr) -> Expr {
        match self {
            Self::Reciprocal => arena.reciprocal(x),
            Self::SquareRoot => arena.sqrt(x),
            Self::Sine => arena.sin(x),
            Self::Cosine => arena.cos(x),
            Self::Exponential => arena.exp(x),
            Self::SmoothStep => {
                // u^3 (10 + u (6 u - 15))
                let u = arena.clamp(x);
                let inner = affine(arena, 6.0, u, -15.0);
                let inner = arena.mul(u, inner);
                let ten = arena.constant(10.0);
                let inner = arena.add(ten, inner);
                let square = arena.square(u);
                let cube = arena.mul(square, u);
                arena.mul(cube, inner)
            }
        }
    }

    /// `f'(x)`.
    pub fn slope(self, arena: &mut Arena, x: Expr) -> Expr {
        match self {
            Self::Reciprocal => {
                let value = arena.reciprocal(x);
                -arena.square(value)
            }
            Self::SquareRoot => {
                let root = arena.sqrt(x);
                let twice = arena.add(root, root);
                arena.reciprocal(twice)
            }
            Self::Sine => arena.cos(x),
            Self::Cosine => -arena.sin(x),
            Self::Exponential => arena.exp(x),
            Self::SmoothStep => {
                // 30 u^2 (1 - u)^2
                let (u, rest) = unit(arena, x);
                let product = arena.mul(u, rest);
                let square = arena.square(product);
                let thirty = arena.constant(30.0);
                arena.mul(thirty, square)
            }
        }
    }

    /// `f''(x)`.
    pub fn curvature(self, arena: &mut Arena, x: Expr) -> Expr {
        match self {
            Self::Reciprocal => {
                let value = arena.reciprocal(x);
                let square = arena.square(value);
                let cube = arena.mul(square, value);
                arena.add(cube, cube)
            }
            Self::SquareRoot => {
                // -2 (f')^3
                let slope = self.slope(arena, x);
                let square = arena.square(slope);
                let cube = arena.mul(square, slope);
                -arena.add(cube, cube)
            }
            Self::Sine => -arena.sin(x),
            Self::Cosine => -arena.cos(x),
            Self::Exponential => arena.exp(x),
            Self::SmoothStep => {
                // 60 u (1 - u) (1 - 2 u)
                let (u, rest) = unit(arena, x);
                let product = arena.mul(u, rest);
                let sixty = arena.constant(60.0);
                let scaled = arena.mul(sixty, product);
                let slope = arena.sub(rest, u);
                arena.mul(scaled, slope)
            }
        }
    }
}

/// `a x + b`.
fn affine(arena: &mut Arena, a: f64, x: Expr, b: f64) -> Expr {
    let (a, b) = (arena.constant(a), arena.constant(b));
    let product = arena.mul(a, x);
    arena.add(product, b)
}

/// `u`, which is `x` between 0 and 1, and `1 - u`.
fn unit(arena: &mut Arena, x: Expr) -> (Expr, Expr) {
    let u = arena.clamp(x);
    (u, arena.sub(Arena::ONE, u))
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
    cosine: Expr,
    sine: Expr,
    /// The velocities that it is the integral of, each with a factor.
    along: Vec<(usize, Expr)>,
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

    fn rate(&self, arena: &mut Arena) -> Expr {
        let terms = self.along.iter().map(|&(velocity, sign)| {
            let rate = arena.input(Input::Velocity(velocity as u32));
            arena.mul(sign, rate)
        });
        let terms: Vec<Expr> = terms.collect();
        arena.sum(terms)
    }
}

impl AngleExpr {
    /// `atan2(s, c) + 2 pi round((near - atan2(s, c)) / 2 pi)`.
    pub fn value(&self, space: &mut Space, motion: &Motion) -> Expr {
        let (sine, cosine) = self.parts(space, motion);
        nearest_angle(&mut space.arena, self.near, sine, cosine)
    }

    /// `(c s' - s c') / (c^2 + s^2)`.
    pub fn rate(&self, space: &mut Space, motion: &Motion) -> Expr {
        if let Some(paired) = &self.paired {
            return paired.rate(&mut space.arena);
        }
        let (s, c) = self.parts(space, motion);
        let (ds, dc) = (
            self.sine.rate(space, motion),
            self.cosine.rate(space, motion),
        );
        let forth = space.arena.mul(c, ds);
        let back = space.arena.mul(s, dc);
        let area = space.arena.sub(forth, back);
        let inverse = inverse_square(&mut space.arena, s, c);
        space.arena.mul(area, inverse)
    }

    /// `(c s'' - s c'' - 2 angle' (c c' + s s')) / (c^2 + s^2)` without accelerations.
    pub fn bias(&self, space: &mut Space, motion: &Motion) -> Expr {
        if self.paired.is_some() {
            return Arena::ZERO;
        }
        let (s, c) = self.parts(space, motion);
        let rate = self.rate(space, motion);
        let (ds, dc) = (
            self.sine.rate(space, motion),
            self.cosine.rate(space, motion),
        );
        let (dds, ddc) = (
            self.sine.bias(space, motion),
            self.cosine.bias(space, motion),
        );
        let arena = &mut space.arena;
        let products = [arena.mul(c, dds), -arena.mul(s, ddc)];
        let area = arena.sum(products);
        let growth = [arena.mul(c, dc), arena.mul(s, ds)];
        let growth = arena.sum(growth);
        let twice = arena.add(growth, growth);
        let turning = arena.mul(rate, twice);
        let area = arena.sub(area, turning);
        let inverse = inverse_square(arena, s, c);
        arena.mul(area, inverse)
    }

    /// Adds `seed` times the gradient.
    pub fn pull_back(
        &self,
        space: &mut Space,
        motion: &Motion,
        seed: Expr,
        gradient: &mut Gradient,
    ) {
        if let (Some(paired), false) = (&self.paired, gradient.is_by_bodies) {
            for &(velocity, sign) in &paired.along {
                let factor = space.arena.mul(sign, seed);
                gradient.push_along(velocity, factor);
            }
            return;
        }
        // Not those of pairs, which lack the positive number that both are multiplied with.
        let s = self.sine.value(space, motion);
        let c = self.cosine.value(space, motion);
        let inverse = inverse_square(&mut space.arena, s, c);
        let seed = space.arena.mul(seed, inverse);
        let (on_sine, on_cosine) = (space.arena.mul(seed, c), space.arena.mul(seed, s));
        self.sine.pull_back(space, motion, on_sine, gradient);
        self.cosine.pull_back(space, motion, -on_cosine, gradient);
    }

    fn parts(&self, space: &mut Space, motion: &Motion) -> (Expr, Expr) {
        if let Some(PairedAngle { cosine, sine, .. }) = &self.paired {
            return (*sine, *cosine);
        }
        (
            self.sine.value(space, motion),
            self.cosine.value(space, motion),
        )
    }
}

/// The angle of this sine and cosine, times any positive number, that is nearest to another.
pub(crate) fn nearest_angle(arena: &mut Arena, near: Expr, sine: Expr, cosine: Expr) -> Expr {
    let within = arena.atan2(sine, cosine);
    let turn = arena.constant(std::f64::consts::TAU);
    let beyond = arena.sub(near, within);
    let turns = arena.div(beyond, turn);
    let turns = arena.round(turns);
    let full = arena.mul(turn, turns);
    arena.add(within, full)
}

/// `1 / (c^2 + s^2)`.
fn inverse_square(arena: &mut Arena, s: Expr, c: Expr) -> Expr {
    let (ss, cc) = (arena.square(s), arena.square(c));
    let sum = arena.add(cc, ss);
    arena.reciprocal(sum)
}
