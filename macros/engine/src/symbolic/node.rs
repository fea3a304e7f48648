//! What an arena holds: signed references, numbers known later, operations.
//!
//! What every operation asks for is inlined always: that is done without optimisation, too.

use super::index::Key;
use crate::model::Curve;

/// A signed reference to a node: its value, or the value with the other sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Expr(u32);

impl Expr {
    #[inline(always)]
    pub(super) const fn new(node: u32, negative: bool) -> Self {
        Self(node << 1 | negative as u32)
    }

    /// The place of the node in the arena.
    #[inline(always)]
    #[must_use]
    pub const fn node(self) -> usize {
        (self.0 >> 1) as usize
    }

    /// Whether the sign is turned.
    #[inline(always)]
    #[must_use]
    pub const fn is_negative(self) -> bool {
        self.0 & 1 == 1
    }

    /// The reference without its sign.
    #[inline(always)]
    #[must_use]
    pub const fn abs(self) -> Self {
        Self(self.0 & !1)
    }

    /// The other sign where asked for. Zero, the first node, has no sign.
    #[inline(always)]
    pub(super) const fn with_sign_of(self, negative: bool) -> Self {
        if self.0 >> 1 == 0 {
            Self(0)
        } else {
            Self(self.0 ^ negative as u32)
        }
    }
}

impl std::ops::Neg for Expr {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.with_sign_of(true)
    }
}

/// A number that is known only when the generated code runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Input {
    /// A number of the description that the macro cannot see.
    Symbol(u32),
    /// One that depends on inputs of the mechanism.
    Varying(u32),
    /// `2 a`, the factor of `Phi'` in `gamma*`.
    RateGain,
    /// `b^2`, the factor of `Phi` in `gamma*`.
    PositionGain,
    /// `e`, the compliance of a constraint by its first row.
    Compliance(u32),
    /// The time.
    Time,
    /// An element of the coordinates, auxiliary variables behind those of bodies.
    Coordinate(u32),
    /// An element of the velocities.
    Velocity(u32),
    /// A wanted acceleration, of a joint.
    Acceleration(u32),
    /// An element of the upper right-hand side (forces).
    Upper(u32),
    /// An element of the lower right-hand side (rows).
    Lower(u32),
}

/// When a number is known: a node is as late as the latest of its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// At expansion.
    Literal,
    /// Once per mechanism, in `prepare`.
    Parameter,
    /// Whenever inputs are set, in `take_inputs`.
    Input,
    /// Once per formulation, in `coefficients`; of what depends on inputs too, at every evaluation.
    Coefficient,
    /// At every evaluation.
    State,
    /// With the right-hand side, after the factorisation.
    RightHandSide,
}

impl Stage {
    /// When what is made of two values is known. What depends on inputs and on coefficients is left
    /// to the evaluation, so that either can change by itself.
    #[inline(always)]
    pub(super) const fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::Input, Self::Coefficient) | (Self::Coefficient, Self::Input) => Self::State,
            _ if (self as u8) < other as u8 => other,
            _ => self,
        }
    }
}

impl Input {
    /// What tells it from all other inputs.
    const fn key(self) -> (u64, u32) {
        match self {
            Self::Symbol(place) => (0, place),
            Self::RateGain => (1, 0),
            Self::PositionGain => (2, 0),
            Self::Compliance(place) => (3, place),
            Self::Time => (4, 0),
            Self::Coordinate(place) => (5, place),
            Self::Velocity(place) => (6, place),
            Self::Upper(place) => (7, place),
            Self::Lower(place) => (8, place),
            Self::Varying(place) => (9, place),
            Self::Acceleration(place) => (10, place),
        }
    }

    /// When the input is known.
    #[must_use]
    pub const fn stage(self) -> Stage {
        match self {
            Self::Symbol(_) => Stage::Parameter,
            Self::Varying(_) => Stage::Input,
            Self::RateGain | Self::PositionGain | Self::Compliance(_) => Stage::Coefficient,
            Self::Time | Self::Coordinate(_) | Self::Velocity(_) | Self::Acceleration(_) => {
                Stage::State
            }
            Self::Upper(_) | Self::Lower(_) => Stage::RightHandSide,
        }
    }
}

/// An operation. Constants are positive; the first operand of a sum and both factors of a product
/// are unsigned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A positive number (or zero), as bits.
    Constant(u64),
    /// A number known later.
    Input(Input),
    /// A sum or a difference.
    Add(Expr, Expr),
    /// A product.
    Multiply(Expr, Expr),
    /// `1 / x`.
    Reciprocal(Expr),
    /// The square root.
    SquareRoot(Expr),
    /// -1 where the operand is negative, else 1.
    Sign(Expr),
    /// The operand, at least 0 and at most 1.
    Clamp(Expr),
    /// The nearest integer.
    Round(Expr),
    /// The sine.
    Sine(Expr),
    /// The cosine.
    Cosine(Expr),
    /// The exponential function.
    Exponential(Expr),
    /// The angle of a point, from sine and cosine.
    Angle(Expr, Expr),
    /// The first operand where it is not zero, else the sign of the second.
    Side(Expr, Expr),
    /// The second operand where the first, a side, is not negative; else zero.
    Above(Expr, Expr),
    /// The second operand where the first, a side, is negative; else zero.
    Below(Expr, Expr),
    /// A spline or a derivative of it, whose numbers are known when the generated code runs.
    Curve(Curve, Expr),
}

impl Node {
    /// The operands.
    pub fn operands(self) -> impl Iterator<Item = Expr> {
        let (first, second) = self.pair();
        first.into_iter().chain(second)
    }

    /// The operands, for loops over whole arenas.
    #[inline(always)]
    pub(super) const fn pair(self) -> (Option<Expr>, Option<Expr>) {
        match self {
            Self::Constant(_) | Self::Input(_) => (None, None),
            Self::Add(a, b)
            | Self::Multiply(a, b)
            | Self::Angle(a, b)
            | Self::Side(a, b)
            | Self::Above(a, b)
            | Self::Below(a, b) => (Some(a), Some(b)),
            Self::Reciprocal(a)
            | Self::SquareRoot(a)
            | Self::Sign(a)
            | Self::Clamp(a)
            | Self::Round(a)
            | Self::Sine(a)
            | Self::Cosine(a)
            | Self::Exponential(a)
            | Self::Curve(_, a) => (Some(a), None),
        }
    }

    /// What tells it from all other nodes.
    pub(super) const fn key(self) -> Key {
        #[inline(always)]
        const fn two(a: Expr, b: Expr) -> u64 {
            (a.0 as u64) << 32 | b.0 as u64
        }
        match self {
            Self::Constant(bits) => Key::new(0, bits),
            Self::Input(input) => {
                let (kind, place) = input.key();
                Key::new(1, kind << 32 | place as u64)
            }
            Self::Add(a, b) => Key::new(2, two(a, b)),
            Self::Multiply(a, b) => Key::new(3, two(a, b)),
            Self::Reciprocal(a) => Key::new(4, a.0 as u64),
            Self::SquareRoot(a) => Key::new(5, a.0 as u64),
            Self::Sign(a) => Key::new(6, a.0 as u64),
            Self::Clamp(a) => Key::new(7, a.0 as u64),
            Self::Round(a) => Key::new(8, a.0 as u64),
            Self::Sine(a) => Key::new(9, a.0 as u64),
            Self::Cosine(a) => Key::new(10, a.0 as u64),
            Self::Exponential(a) => Key::new(11, a.0 as u64),
            Self::Angle(a, b) => Key::new(12, two(a, b)),
            Self::Side(a, b) => Key::new(16, two(a, b)),
            Self::Above(a, b) => Key::new(17, two(a, b)),
            Self::Below(a, b) => Key::new(18, two(a, b)),
            Self::Curve(curve, a) => {
                let kind = 19 + curve.derivative as u64;
                Key::new(kind, (curve.spline as u64) << 32 | a.0 as u64)
            }
        }
    }

    /// The same operation on other operands.
    pub(super) fn with_operands(self, other: impl Fn(Expr) -> Expr) -> Self {
        match self {
            Self::Constant(_) | Self::Input(_) => self,
            Self::Add(a, b) => Self::Add(other(a), other(b)),
            Self::Multiply(a, b) => Self::Multiply(other(a), other(b)),
            Self::Angle(a, b) => Self::Angle(other(a), other(b)),
            Self::Side(a, b) => Self::Side(other(a), other(b)),
            Self::Above(a, b) => Self::Above(other(a), other(b)),
            Self::Below(a, b) => Self::Below(other(a), other(b)),
            Self::Reciprocal(a) => Self::Reciprocal(other(a)),
            Self::SquareRoot(a) => Self::SquareRoot(other(a)),
            Self::Sign(a) => Self::Sign(other(a)),
            Self::Clamp(a) => Self::Clamp(other(a)),
            Self::Round(a) => Self::Round(other(a)),
            Self::Sine(a) => Self::Sine(other(a)),
            Self::Cosine(a) => Self::Cosine(other(a)),
            Self::Exponential(a) => Self::Exponential(other(a)),
            Self::Curve(curve, a) => Self::Curve(curve, other(a)),
        }
    }

    /// The value, by the values of the operands; NaN of a spline.
    ///
    /// # Panics
    /// If it is an input, which has none by itself.
    pub(super) fn value(self, of: impl Fn(Expr) -> f64) -> f64 {
        match self {
            Self::Constant(bits) => f64::from_bits(bits),
            Self::Input(input) => panic!("{input:?} is no operation"),
            Self::Add(a, b) => of(a) + of(b),
            Self::Multiply(a, b) => of(a) * of(b),
            Self::Reciprocal(a) => of(a).recip(),
            Self::SquareRoot(a) => of(a).sqrt(),
            Self::Sign(a) => {
                if of(a) < 0.0 {
                    -1.0
                } else {
                    1.0
                }
            }
            Self::Clamp(a) => of(a).clamp(0.0, 1.0),
            Self::Round(a) => of(a).round(),
            Self::Sine(a) => of(a).sin(),
            Self::Cosine(a) => of(a).cos(),
            Self::Exponential(a) => of(a).exp(),
            Self::Angle(sine, cosine) => of(sine).atan2(of(cosine)),
            Self::Side(held, a) => {
                let held = of(held);
                side(if held == 0.0 { of(a) } else { held })
            }
            Self::Above(side, a) if of(side) >= 0.0 => of(a),
            Self::Below(side, a) if of(side) < 0.0 => of(a),
            Self::Above(side, _) | Self::Below(side, _) => 0.0 * of(side),
            Self::Curve(..) => f64::NAN,
        }
    }

    /// Whether the node costs an operation.
    #[must_use]
    pub const fn is_operation(self) -> bool {
        !matches!(
            self,
            Self::Constant(_)
                | Self::Input(_)
                | Self::Sign(_)
                | Self::Clamp(_)
                | Self::Round(_)
                | Self::Side(..)
                | Self::Above(..)
                | Self::Below(..)
        )
    }
}

/// The sign of a number: 1, -1, 0 at zero, NaN of NaN.
pub(super) fn side(a: f64) -> f64 {
    if a > 0.0 {
        1.0
    } else if a < 0.0 {
        -1.0
    } else {
        a + 0.0
    }
}
