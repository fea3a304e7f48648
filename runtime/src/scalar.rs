//! The numbers a kernel computes with.
//!
//! A kernel is generic over [`Scalar`], a handful of operations without branches: real numbers, dual numbers,
//! counting numbers and lanes fit. What must branch on a value (step control, Newton's loop, verdicts on
//! pivots) asks for [`Real`], a scalar that can be compared.

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

/// A number that generated kernels compute with: no branches, no conversions, no panics.
///
/// NaN must travel: every operation with a NaN operand yields NaN, [`Scalar::min`] included.
pub trait Scalar:
    Copy
    + Debug
    + PartialEq
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
{
    /// The scalar nearest to `value`, in every lane.
    fn constant(value: f64) -> Self;

    /// `1 / self`.
    fn reciprocal(self) -> Self;

    /// The square root; NaN for a negative number.
    fn sqrt(self) -> Self;

    /// `self * factor + addend`, rounded once where the target has the instruction, twice elsewhere.
    fn fused(self, factor: Self, addend: Self) -> Self;

    /// The absolute value.
    fn abs(self) -> Self;

    /// The lesser of two numbers; NaN if either is NaN.
    fn min(self, other: Self) -> Self;

    /// `less` where `self < bound`, `otherwise` where not (also where the comparison fails for NaN).
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self;

    /// Zero.
    fn zero() -> Self {
        Self::constant(0.0)
    }

    /// One.
    fn one() -> Self {
        Self::constant(1.0)
    }
}

/// A scalar that can be compared and converted: what steppers, projections and reports compute with.
pub trait Real: Scalar + PartialOrd {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The value as `f64`; the value part of a dual number.
    fn to_f64(self) -> f64;

    /// Whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// The angle of the point `(cosine, self)` in the range `-pi..=pi`.
    fn atan2(self, cosine: Self) -> Self;

    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);

    /// `self` raised to a real power.
    fn powf(self, exponent: f64) -> Self;

    /// The distance from `|self|` to the next larger number of its type.
    fn ulp(self) -> Self {
        self.abs() * Self::EPSILON
    }

    /// The greater of two numbers; NaN if either is NaN.
    fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }

    /// `self / divisor`, rounded once.
    fn quotient(self, divisor: Self) -> Self;
}

/// Elementary functions on `f64` and `f32`, from the standard library or from libm.
pub(crate) mod elementary {
    macro_rules! elementary {
        ($($name:ident, $float:ty, $libm:ident, ($($argument:ident),*);)*) => {$(
            #[cfg(feature = "std")]
            pub(crate) fn $name($($argument: $float),*) -> $float {
                elementary!(@std $float, $name, $($argument),*)
            }
            #[cfg(not(feature = "std"))]
            pub(crate) fn $name($($argument: $float),*) -> $float {
                libm::$libm($($argument),*)
            }
        )*};
        (@std $float:ty, $name:ident, $first:ident $(, $rest:ident)*) => {
            elementary!(@call $name, $first $(, $rest)*)
        };
        (@call sqrt64, $x:ident) => { $x.sqrt() };
        (@call sqrt32, $x:ident) => { $x.sqrt() };
        (@call sin64, $x:ident) => { $x.sin() };
        (@call sin32, $x:ident) => { $x.sin() };
        (@call cos64, $x:ident) => { $x.cos() };
        (@call cos32, $x:ident) => { $x.cos() };
        (@call tan64, $x:ident) => { $x.tan() };
        (@call exp64, $x:ident) => { $x.exp() };
        (@call atan2_64, $x:ident, $y:ident) => { $x.atan2($y) };
        (@call atan2_32, $x:ident, $y:ident) => { $x.atan2($y) };
        (@call pow64, $x:ident, $y:ident) => { $x.powf($y) };
        (@call pow32, $x:ident, $y:ident) => { $x.powf($y) };
    }
    elementary! {
        sqrt64, f64, sqrt, (x);
        sqrt32, f32, sqrtf, (x);
        sin64, f64, sin, (x);
        sin32, f32, sinf, (x);
        cos64, f64, cos, (x);
        cos32, f32, cosf, (x);
        tan64, f64, tan, (x);
        exp64, f64, exp, (x);
        atan2_64, f64, atan2, (x, y);
        atan2_32, f32, atan2f, (x, y);
        pow64, f64, pow, (x, y);
        pow32, f32, powf, (x, y);
    }
}

macro_rules! real {
    ($float:ty, $sqrt:ident, $sin:ident, $cos:ident, $atan2:ident, $pow:ident) => {
        impl Scalar for $float {
            #[inline(always)]
            fn constant(value: f64) -> Self {
                value as $float
            }

            #[inline(always)]
            fn reciprocal(self) -> Self {
                1.0 / self
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                elementary::$sqrt(self)
            }

            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                // Without the instruction it would be a call into the library, six times slower.
                #[cfg(all(feature = "std", any(target_feature = "fma", target_arch = "aarch64")))]
                {
                    self.mul_add(factor, addend)
                }
                #[cfg(not(all(
                    feature = "std",
                    any(target_feature = "fma", target_arch = "aarch64")
                )))]
                {
                    self * factor + addend
                }
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <$float>::abs(self)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other || self.is_nan() {
                    self
                } else {
                    other
                }
            }

            #[inline(always)]
            fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
                if self < bound { less } else { otherwise }
            }
        }

        impl Real for $float {
            const EPSILON: Self = <$float>::EPSILON;

            fn to_f64(self) -> f64 {
                self.into()
            }

            fn is_finite(self) -> bool {
                <$float>::is_finite(self)
            }

            fn atan2(self, cosine: Self) -> Self {
                elementary::$atan2(self, cosine)
            }

            fn sin_cos(self) -> (Self, Self) {
                (elementary::$sin(self), elementary::$cos(self))
            }

            fn powf(self, exponent: f64) -> Self {
                elementary::$pow(self, exponent as $float)
            }

            fn ulp(self) -> Self {
                <$float>::abs(self).next_up() - <$float>::abs(self)
            }

            fn quotient(self, divisor: Self) -> Self {
                self / divisor
            }
        }
    };
}

real!(f64, sqrt64, sin64, cos64, atan2_64, pow64);
real!(f32, sqrt32, sin32, cos32, atan2_32, pow32);

#[cfg(test)]
mod tests {
    use super::{Real, Scalar};

    #[test]
    fn the_lesser_number_lets_nan_travel() {
        assert_eq!(Scalar::min(1.0, 2.0), 1.0);
        assert!(Scalar::min(f64::NAN, 1.0).is_nan());
        assert!(Scalar::min(1.0, f64::NAN).is_nan());
        assert!(Real::max(1.0, f64::NAN).is_nan());
    }
}
