//! A number that writes down what is computed with it.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, Mul, Neg, Sub};

use holonom::Scalar;

use crate::tape::{Binary, Obstacle, Operation, Place, Unary, with};

/// The type of numbers that a program is written for.
pub trait Precision: Copy + fmt::Debug + Default + 'static {
    /// Whether it is `float`, else `double`.
    const IS_SINGLE: bool;
}

/// `double` in C, `f64` in Rust.
#[derive(Clone, Copy, Debug, Default)]
pub struct Double;

/// `float` in C, `f32` in Rust.
#[derive(Clone, Copy, Debug, Default)]
pub struct Single;

impl Precision for Double {
    const IS_SINGLE: bool = false;
}

impl Precision for Single {
    const IS_SINGLE: bool = true;
}

/// A number that writes down what is computed with it. A function that is called once with such
/// numbers *is* its own text, as long as it has no branch on them.
///
/// Numbers cannot be compared. A comparison for equality, which every [`Scalar`] has, is noted, and
/// what was traced is refused.
#[derive(Clone, Copy)]
pub struct Traced<P = Double> {
    place: Place,
    precision: PhantomData<P>,
}

impl<P> Traced<P> {
    pub(crate) fn at(place: Place) -> Self {
        Self {
            place,
            precision: PhantomData,
        }
    }

    pub(crate) fn place(self) -> Place {
        self.place
    }

    fn put(operation: Operation) -> Self {
        Self::at(with(|tape| tape.put(operation)))
    }

    fn unary(self, function: Unary) -> Self {
        Self::put(Operation::Unary(function, self.place))
    }

    fn binary(self, function: Binary, other: Self) -> Self {
        Self::put(Operation::Binary(function, [self.place, other.place]))
    }
}

impl<P> fmt::Debug for Traced<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Traced").field(&self.place).finish()
    }
}

/// Of numbers that are known; of others it is noted that they were compared.
impl<P> PartialEq for Traced<P> {
    fn eq(&self, other: &Self) -> bool {
        with(
            |tape| match (tape.constant(self.place), tape.constant(other.place)) {
                (Some(one), Some(other)) => one == other,
                _ => {
                    tape.refuse(Obstacle::Comparison);
                    false
                }
            },
        )
    }
}

impl<P> Add for Traced<P> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.binary(Binary::Sum, other)
    }
}

impl<P> Sub for Traced<P> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.binary(Binary::Difference, other)
    }
}

impl<P> Mul for Traced<P> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.binary(Binary::Product, other)
    }
}

impl<P> Neg for Traced<P> {
    type Output = Self;

    fn neg(self) -> Self {
        self.unary(Unary::Negation)
    }
}

impl<P: Precision> Scalar for Traced<P> {
    const SEVEN_DIGITS: bool = P::IS_SINGLE;

    /// Where `f64` would take one of two ways by the size of an angle, both are computed, and one
    /// is taken, as lanes do.
    const HAS_LANES: bool = true;

    fn constant(value: f64) -> Self {
        let value = if P::IS_SINGLE {
            f64::from(<f32 as Scalar>::constant(value))
        } else {
            value
        };
        Self::at(with(|tape| tape.number(value)))
    }

    fn reciprocal(self) -> Self {
        self.unary(Unary::Reciprocal)
    }

    fn sqrt(self) -> Self {
        self.unary(Unary::SquareRoot)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        Self::put(Operation::Fused([self.place, factor.place, addend.place]))
    }

    fn abs(self) -> Self {
        self.unary(Unary::Magnitude)
    }

    fn min(self, other: Self) -> Self {
        self.binary(Binary::Least, other)
    }

    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        let of = [self, bound, less, otherwise].map(Self::place);
        Self::put(Operation::Select(of))
    }

    fn sin(self) -> Self {
        self.unary(Unary::Sine)
    }

    fn cos(self) -> Self {
        self.unary(Unary::Cosine)
    }

    fn exp(self) -> Self {
        self.unary(Unary::Exponential)
    }

    fn atan2(self, cosine: Self) -> Self {
        self.binary(Binary::Angle, cosine)
    }

    fn round(self) -> Self {
        self.unary(Unary::Rounding)
    }

    fn sines_and_versines<const N: usize>(angles: &[Self; N]) -> [[Self; 2]; N] {
        angles.map(|angle| {
            [
                angle.unary(Unary::TurnSine),
                angle.unary(Unary::TurnVersine),
            ]
        })
    }
}
