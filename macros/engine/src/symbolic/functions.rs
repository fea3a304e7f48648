//! Functions of scalars and their derivatives.

use super::arena::{Arena, Expr};
use crate::model::Function;

impl Function {
    /// `f(x)`.
    pub fn value(self, arena: &mut Arena, x: Expr) -> Expr {
        match self {
            Self::Reciprocal => arena.reciprocal(x),
            Self::SquareRoot => arena.sqrt(x),
            Self::Sine => arena.sin(x),
            Self::Cosine => arena.cos(x),
            Self::ArcSine => {
                let cosine = beside(arena, x);
                arena.atan2(x, cosine)
            }
            Self::ArcCosine => {
                let sine = beside(arena, x);
                arena.atan2(sine, x)
            }
            Self::ArcTangent => arena.atan2(x, Arena::ONE),
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
            Self::Curve(curve) => arena.curve(curve, x),
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
            Self::ArcSine => {
                let cosine = beside(arena, x);
                arena.reciprocal(cosine)
            }
            Self::ArcCosine => -Self::ArcSine.slope(arena, x),
            Self::ArcTangent => {
                let square = arena.square(x);
                let sum = arena.add(Arena::ONE, square);
                arena.reciprocal(sum)
            }
            Self::Exponential => arena.exp(x),
            Self::SmoothStep => {
                // 30 u^2 (1 - u)^2
                let (u, rest) = unit(arena, x);
                let product = arena.mul(u, rest);
                let square = arena.square(product);
                let thirty = arena.constant(30.0);
                arena.mul(thirty, square)
            }
            Self::Curve(curve) => arena.curve(curve.derived(), x),
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
            Self::ArcSine => {
                // x (f')^3
                let slope = self.slope(arena, x);
                let square = arena.square(slope);
                let cube = arena.mul(square, slope);
                arena.mul(x, cube)
            }
            Self::ArcCosine => -Self::ArcSine.curvature(arena, x),
            Self::ArcTangent => {
                // -2 x (f')^2
                let slope = self.slope(arena, x);
                let square = arena.square(slope);
                let product = arena.mul(x, square);
                -arena.add(product, product)
            }
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
            Self::Curve(curve) => arena.curve(curve.derived().derived(), x),
        }
    }
}

/// The cosine of an angle whose sine is `x`, or the other way round: not negative, NaN beyond -1
/// and 1. As a product, so that it keeps its digits near these.
fn beside(arena: &mut Arena, x: Expr) -> Expr {
    let (above, below) = (arena.sub(Arena::ONE, x), arena.add(Arena::ONE, x));
    let square = arena.mul(above, below);
    arena.sqrt(square)
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
