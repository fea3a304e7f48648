//! The numbers a kernel computes with.
//!
//! A kernel is generic over [`Scalar`], a handful of operations without branches: real numbers,
//! numbers that carry derivatives along ([`Forward`](crate::Forward)), counting numbers and lanes
//! fit. What must branch on a value (step control, Newton's loop, verdicts on pivots) asks for
//! [`Real`], a scalar that can be compared.

use core::array::from_fn;
use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

use crate::math::versine;

/// A number that generated kernels compute with: no branches, no conversions, no panics.
///
/// NaN must travel: every operation with a NaN operand yields NaN, [`Scalar::min`] and the
/// functions included.
///
/// Most kernels need no function but the square root. [`Scalar::sin`], [`Scalar::cos`] and
/// [`Scalar::exp`] are called where a definition or a mechanism writes them: drivers, force laws,
/// functions of time. [`Scalar::atan2`] and [`Scalar::round`] make an angle that counts turns from
/// the orientations of two bodies and from its auxiliary variable.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no type of numbers that mechanisms compute with",
    label = "neither `f64` nor `f32`",
    note = "write times, steps and tolerances with a point: `0.0..=1.0`, not `0..=1`"
)]
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

    /// `self * factor + addend`, rounded once where the target has the instruction, twice
    /// elsewhere.
    fn fused(self, factor: Self, addend: Self) -> Self;

    /// The absolute value.
    fn abs(self) -> Self;

    /// The lesser of two numbers; NaN if either is NaN.
    fn min(self, other: Self) -> Self;

    /// `less` where `self < bound`, `otherwise` where not (also where the comparison fails for
    /// NaN).
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self;

    /// The sine of an angle (rad); NaN for an infinite one.
    fn sin(self) -> Self;

    /// The cosine of an angle (rad); NaN for an infinite one.
    fn cos(self) -> Self;

    /// The exponential function; infinite beyond the range of numbers.
    fn exp(self) -> Self;

    /// The angle (rad) of the point `(cosine, self)`, from `-pi` to `pi`; zero for the point
    /// `(0, 0)`.
    fn atan2(self, cosine: Self) -> Self;

    /// The nearest integer, halves away from zero. Piecewise constant: a dual number has derivative
    /// zero here, at the jumps too.
    fn round(self) -> Self;

    /// The sines of angles (rad), and their versines, `1 - cos`: what turns by these angles are
    /// made of, see [`crate::state::JointState`]. Both keep their digits however small or large the
    /// angle is; NaN for an infinite one.
    ///
    /// By [`Scalar::sin`] and [`Scalar::cos`] of half the angles, if a type does not know better:
    /// `f64` and `f32` have no call of a function where all angles are below 0.9 rad.
    #[must_use]
    fn sines_and_versines<const N: usize>(angles: &[Self; N]) -> [[Self; 2]; N] {
        angles.map(versine::of)
    }

    /// Whether numbers have no more than the seven digits of `f32`: a series may end where these
    /// are right.
    const SEVEN_DIGITS: bool = false;

    /// Whether a number is several, side by side: what [`Scalar::are_within`] denies of it may hold
    /// of some of them.
    const HAS_LANES: bool = false;

    /// Whether a number is an array: lanes, or derivatives. What is done with each of several is
    /// then called. Of a loop compilers would make vectors across these, by gathers and scatters,
    /// which takes up to four times as long as one after the other.
    const IS_WIDE: bool = false;

    /// Whether the absolute values of these numbers are known to be at most `bound`; NaN, which
    /// shows in whatever is computed of it, does not count. A type that cannot tell says no.
    #[must_use]
    fn are_within<const N: usize>(numbers: &[Self; N], bound: f64) -> bool {
        let _ = (numbers, bound);
        false
    }

    /// How many of `count` increasing bounds are not above this number; all of them for NaN.
    ///
    /// `None` where a number is several that disagree, and of a type that cannot tell. Then every
    /// bound is compared by [`Scalar::select`].
    #[must_use]
    fn bounds_passed(self, count: usize, bound: impl Fn(usize) -> Self) -> Option<usize> {
        let _ = (count, bound);
        None
    }

    /// Zero.
    fn zero() -> Self {
        Self::constant(0.0)
    }

    /// One.
    fn one() -> Self {
        Self::constant(1.0)
    }
}

/// A scalar that can be compared and converted: what steppers, projections and reports compute
/// with.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no type of numbers that mechanisms compute with",
    label = "neither `f64` nor `f32`",
    note = "write times, steps and tolerances with a point: `0.0..=1.0`, not `0..=1`"
)]
pub trait Real: Scalar + PartialOrd {
    /// The distance from 1 to the next larger number.
    const EPSILON: Self;

    /// Zero, as a constant.
    const ZERO: Self;

    /// The value as `f64`; the value part of a dual number.
    fn to_f64(self) -> f64;

    /// Whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;

    /// `self` raised to a real power.
    fn powf(self, exponent: f64) -> Self;

    /// The smallest positive number of all digits.
    fn smallest() -> Self {
        Self::constant(f64::MIN_POSITIVE)
    }

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

    /// The number without derivatives, where it carries any: what a control has chosen, as a step,
    /// is no function of what it was chosen by.
    #[must_use]
    fn plain(self) -> Self {
        self
    }

    /// Whether numbers carry derivatives, whose errors count in a step control beside their own.
    #[doc(hidden)]
    const CARRIES_DERIVATIVES: bool = false;

    /// The derivative along a direction, as a number that depends on nothing; `None` where there
    /// are no so many.
    #[doc(hidden)]
    fn derivative(self, direction: usize) -> Option<Self> {
        let _ = direction;
        None
    }

    /// A number whose derivatives are the larger ones of those of two, in size.
    #[doc(hidden)]
    #[must_use]
    fn with_larger_derivatives(self, other: Self) -> Self {
        let _ = other;
        self
    }

    /// The largest of some increments, each relative to the larger of two numbers and a floor; of
    /// `[increment, number, number]`. NaN if any is NaN.
    #[doc(hidden)]
    fn largest_share(elements: impl Iterator<Item = [Self; 3]> + Clone, floor: Self) -> Self {
        elements.fold(Self::zero(), |most, [increment, x, y]| {
            let scale = x.abs().max(y.abs()).max(floor);
            most.max(increment.abs().quotient(scale))
        })
    }
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
        (@call exp32, $x:ident) => { $x.exp() };
        (@call round64, $x:ident) => { $x.round() };
        (@call round32, $x:ident) => { $x.round() };
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
        exp32, f32, expf, (x);
        round64, f64, round, (x);
        round32, f32, roundf, (x);
        atan2_64, f64, atan2, (x, y);
        atan2_32, f32, atan2f, (x, y);
        pow64, f64, pow, (x, y);
        pow32, f32, powf, (x, y);
    }
}

macro_rules! real {
    ($float:ty, $sqrt:ident, $sin:ident, $cos:ident, $exp:ident, $atan2:ident, $round:ident, $pow:ident, $coefficients:ident, $polynomial:ident, $quarter:ident, $quarter_bound:expr) => {
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

            #[inline]
            fn sin(self) -> Self {
                elementary::$sin(self)
            }

            #[inline]
            fn cos(self) -> Self {
                elementary::$cos(self)
            }

            #[inline]
            fn exp(self) -> Self {
                elementary::$exp(self)
            }

            #[inline]
            fn atan2(self, cosine: Self) -> Self {
                elementary::$atan2(self, cosine)
            }

            #[inline]
            fn round(self) -> Self {
                elementary::$round(self)
            }

            #[inline]
            fn bounds_passed(self, count: usize, bound: impl Fn(usize) -> Self) -> Option<usize> {
                let (mut passed, mut above) = (0, count);
                while passed < above {
                    let middle = passed + (above - passed) / 2;
                    if self < bound(middle) {
                        above = middle;
                    } else {
                        passed = middle + 1;
                    }
                }
                Some(passed)
            }

            const SEVEN_DIGITS: bool = size_of::<Self>() == 4;

            #[inline(always)]
            fn are_within<const N: usize>(numbers: &[Self; N], bound: f64) -> bool {
                // One comparison, and one branch for whoever asks.
                let most = numbers.iter().fold(0.0, |most, number| {
                    let size = number.abs();
                    if size > most { size } else { most }
                });
                most <= bound as $float
            }

            #[inline(always)]
            fn sines_and_versines<const N: usize>(angles: &[Self; N]) -> [[Self; 2]; N] {
                const SMALL: $float = versine::SMALL as $float;

                #[inline(always)]
                fn of_small(angle: $float) -> [$float; 2] {
                    versine::of_small(angle, &versine::$coefficients, versine::$polynomial)
                }

                /// Less whole quarters of a turn, unless it is small: what is left is.
                #[inline(always)]
                fn of_some_turns(angle: $float) -> [$float; 2] {
                    // The sum is rounded to whole numbers, whose lowest bits are its own.
                    const WHOLE: $float = 1.5 / <$float>::EPSILON;
                    const PER_QUARTER: $float = core::f64::consts::FRAC_2_PI as $float;
                    let sum = angle * PER_QUARTER + WHOLE;
                    let is_small = angle.abs() < SMALL;
                    let place = if is_small { 0 } else { sum.to_bits() & 3 };
                    let quarters = if is_small { 0.0 } else { sum - WHOLE };
                    let [first, second, third] = versine::$quarter;
                    let rest = angle - quarters * first;
                    let near = rest - quarters * second;
                    let lost = (rest - near) - quarters * second - quarters * third;
                    versine::ahead(of_small(near + lost), place as u8)
                }

                /// Eight at once, so that a compiler has whole registers of them whatever their
                /// number is.
                #[inline(always)]
                fn of_some_turns_each(angles: &[$float; 8]) -> [[$float; 8]; 2] {
                    let [mut sines, mut versines] = [[0.0; 8]; 2];
                    let places = sines.iter_mut().zip(&mut versines);
                    for ((sine, versine), &angle) in places.zip(angles) {
                        [*sine, *versine] = of_some_turns(angle);
                    }
                    [sines, versines]
                }

                // The same number for an angle, whatever stands beside it.
                #[cold]
                #[inline(never)]
                fn of_any<const N: usize>(angles: &[$float; N], turns: &mut [[$float; 2]; N]) {
                    const SOME: $float = $quarter_bound;
                    // Of few, and without registers of several, each by itself is less to do.
                    let are_together = N >= 4
                        && cfg!(any(target_feature = "sse2", target_feature = "neon"))
                        && angles
                            .iter()
                            .fold(true, |near, angle| near & (angle.abs() < SOME));
                    if !are_together {
                        for (turn, &angle) in turns.iter_mut().zip(angles) {
                            *turn = if angle.abs() < SOME {
                                of_some_turns(angle)
                            } else {
                                versine::of(angle)
                            };
                        }
                        return;
                    }
                    for first in (0..N).step_by(8) {
                        let eight = from_fn(|k| angles.get(first + k).copied().unwrap_or(0.0));
                        let [sines, versines] = of_some_turns_each(&eight);
                        let places = turns.iter_mut().skip(first);
                        for (turn, (&sine, &versine)) in places.zip(sines.iter().zip(&versines)) {
                            *turn = [sine, versine];
                        }
                    }
                }

                // One branch for all, which does not keep them from being computed side by side.
                let small = angles
                    .iter()
                    .fold(true, |small, angle| small & (angle.abs() < SMALL));
                let mut turns = [[0.0; 2]; N];
                // Loops, because `map` of many is called, and its results pass through memory.
                if small {
                    let (first, last) = turns.split_at_mut(versine::cut(N));
                    let (angles, last_angles) = angles.split_at(versine::cut(N));
                    for (turn, &angle) in first.iter_mut().zip(angles) {
                        *turn = of_small(angle);
                    }
                    for (turn, &angle) in last.iter_mut().zip(last_angles) {
                        *turn = of_small(angle);
                    }
                } else {
                    of_any(angles, &mut turns);
                }
                turns
            }
        }

        #[diagnostic::do_not_recommend]
        impl Real for $float {
            const EPSILON: Self = <$float>::EPSILON;
            const ZERO: Self = 0.0;

            #[inline]
            fn smallest() -> Self {
                <$float>::MIN_POSITIVE
            }

            #[inline]
            fn to_f64(self) -> f64 {
                self.into()
            }

            #[inline]
            fn is_finite(self) -> bool {
                <$float>::is_finite(self)
            }

            #[inline]
            fn powf(self, exponent: f64) -> Self {
                elementary::$pow(self, exponent as $float)
            }

            #[inline]
            fn ulp(self) -> Self {
                <$float>::abs(self).next_up() - <$float>::abs(self)
            }

            #[inline]
            fn quotient(self, divisor: Self) -> Self {
                self / divisor
            }
        }
    };
}

real!(
    f64,
    sqrt64,
    sin64,
    cos64,
    exp64,
    atan2_64,
    round64,
    pow64,
    SIX,
    six,
    QUARTER_BY_FORTY,
    12_000.0
);
real!(
    f32,
    sqrt32,
    sin32,
    cos32,
    exp32,
    atan2_32,
    round32,
    pow32,
    THREE,
    three,
    QUARTER_BY_SEVENTEEN,
    190.0
);

/// The increment of an element for a difference.
pub(crate) fn increment<S: Real>(element: S) -> S {
    (S::EPSILON * element.abs().max(S::constant(1e-5))).sqrt()
}

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

    fn functions_of<S: Real>(tolerance: S) {
        let near = |a: S, b: f64| (a - S::constant(b)).abs() < tolerance;
        let half = S::constant(0.5);
        assert!(near(half.sin(), 0.479_425_538_604_203));
        assert!(near(half.cos(), 0.877_582_561_890_372_8));
        assert!(near(half.exp(), 1.648_721_270_700_128_2));
        assert!(near(S::one().atan2(-S::one()), 2.356_194_490_192_345));
        assert!(near((-S::one()).atan2(-S::one()), -2.356_194_490_192_345));
        assert_eq!(S::zero().atan2(S::zero()), S::zero());
        for (given, nearest) in [
            (0.4, 0.0),
            (0.5, 1.0),
            (-0.5, -1.0),
            (2.5, 3.0),
            (-7.2, -7.0),
        ] {
            assert_eq!(S::constant(given).round(), S::constant(nearest));
        }
        let nan = S::constant(f64::NAN);
        let travelled = [
            nan.sin(),
            nan.cos(),
            nan.exp(),
            nan.atan2(S::one()),
            S::one().atan2(nan),
            nan.round(),
            S::constant(f64::INFINITY).sin(),
            S::constant(f64::INFINITY).cos(),
        ];
        assert!(travelled.iter().all(|value| value.to_f64().is_nan()));
    }

    #[test]
    fn functions_have_their_values_and_let_nan_travel() {
        functions_of(1e-15_f64);
        functions_of(1e-6_f32);
    }
}
