//! Numbers that carry derivatives along.
//!
//! Kernels over them give the Jacobian of the rates, four columns by each evaluation. Over
//! intervals (`interval.rs`) they enclose a law and its slope.

mod columns;
pub(crate) mod interval;
mod shares;

use core::array::from_fn;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

pub(crate) use columns::{Lifted, by_forward_numbers, lifted, with_differences};

use crate::math::scalar::{Real, Scalar};
use crate::state::sums::greater;

/// A number and its derivatives along `N` directions: what is computed with it carries them along,
/// exact to round-off (forward mode; Griewank and Walther, *Evaluating Derivatives*, chapter 3).
///
/// A kernel over such numbers gives `N` columns of its Jacobian at once. Where a function has no
/// derivative, that of one side is taken: of [`Scalar::abs`] at zero that of positive numbers, of
/// [`Scalar::min`] of equal ones that of the second, of [`Scalar::select`] that of the number which
/// is chosen. [`Scalar::round`] has derivative zero. Where a derivative is infinite, as that of the
/// root at zero, what comes of it is infinite or NaN.
///
/// Numbers are ordered by their values alone, so that whatever branches does so as it would without
/// derivatives. Equal ones have equal derivatives, too.
///
/// ```
/// use holonom::{Forward, Scalar};
///
/// // y = x^2 sin(z) and its derivatives for x and z.
/// let x = Forward::new(3.0_f64, [1.0, 0.0]);
/// let z = Forward::new(0.5, [0.0, 1.0]);
/// let y = x * x * z.sin();
/// assert_eq!(y.value(), 9.0 * 0.5_f64.sin());
/// let [for_x, for_z] = y.derivatives();
/// assert!((for_x - 6.0 * 0.5_f64.sin()).abs() < 1e-15);
/// assert!((for_z - 9.0 * 0.5_f64.cos()).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forward<S, const N: usize> {
    value: S,
    derivatives: [S; N],
}

impl<S: Scalar, const N: usize> Forward<S, N> {
    /// A number with its derivatives.
    #[inline]
    #[must_use]
    pub const fn new(value: S, derivatives: [S; N]) -> Self {
        Self { value, derivatives }
    }

    /// A number that depends on nothing.
    #[inline]
    #[must_use]
    pub fn fixed(value: S) -> Self {
        Self::new(value, [S::zero(); N])
    }

    /// A number that varies along one direction, by one for one.
    ///
    /// ```
    /// # use holonom::Forward;
    /// let second: Forward<f64, 3> = Forward::along(0.7, 1);
    /// assert_eq!(second.derivatives(), [0.0, 1.0, 0.0]);
    /// ```
    #[inline]
    #[must_use]
    pub fn along(value: S, direction: usize) -> Self {
        let one = |k| if k == direction { S::one() } else { S::zero() };
        Self::new(value, from_fn(one))
    }

    /// The number without its derivatives.
    #[inline]
    #[must_use]
    pub const fn value(&self) -> S {
        self.value
    }

    /// Its derivatives, one for each direction.
    #[inline]
    #[must_use]
    pub const fn derivatives(&self) -> [S; N] {
        self.derivatives
    }

    /// The derivative along one direction, to be written.
    #[inline]
    pub(crate) fn derivative_mut(&mut self, direction: usize) -> Option<&mut S> {
        self.derivatives.get_mut(direction)
    }

    /// A function of this number, by its value and its slope here.
    #[inline]
    fn with(self, value: S, slope: S) -> Self {
        Self::new(value, self.derivatives.map(|x| slope * x))
    }

    /// `f(self, other)` of the derivatives.
    #[inline]
    fn both(self, other: Self, f: impl Fn(S, S) -> S) -> [S; N] {
        from_fn(|k| f(self.derivatives[k], other.derivatives[k]))
    }
}

/// What a function of some numbers changes by with one of them, by its place.
#[inline]
pub fn slope<S: Scalar, const K: usize>(
    of: impl Fn(&[Forward<S, 1>; K]) -> Forward<S, 1>,
    numbers: &[S; K],
    by: usize,
) -> S {
    let mut numbers = numbers.map(Forward::fixed);
    if let Some(number) = numbers.get_mut(by) {
        *number = Forward::along(number.value, 0);
    }
    let [slope] = of(&numbers).derivatives;
    slope
}

impl<S: Scalar, const N: usize> Add for Forward<S, N> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.both(other, |x, y| x + y))
    }
}

impl<S: Scalar, const N: usize> Sub for Forward<S, N> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.both(other, |x, y| x - y))
    }
}

impl<S: Scalar, const N: usize> Mul for Forward<S, N> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        Self::new(a * b, self.both(other, |x, y| x.fused(b, a * y)))
    }
}

impl<S: Scalar, const N: usize> Neg for Forward<S, N> {
    type Output = Self;

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn neg(self) -> Self {
        Self::new(-self.value, self.derivatives.map(|x| -x))
    }
}

impl<S: Scalar, const N: usize> Scalar for Forward<S, N> {
    const IS_WIDE: bool = N > 1;

    #[inline]
    fn constant(value: f64) -> Self {
        Self::fixed(S::constant(value))
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn reciprocal(self) -> Self {
        let value = self.value.reciprocal();
        if S::SEVEN_DIGITS {
            // The square of a large mass is beyond the range of `f32`.
            let slopes = self.derivatives.map(|slope| -(slope * value) * value);
            return Self::new(value, slopes);
        }
        self.with(value, -(value * value))
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        self.with(value, S::constant(0.5) * value.reciprocal())
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        let (a, b) = (self.value, factor.value);
        Self::new(
            a.fused(b, addend.value),
            from_fn(|k| {
                let second = factor.derivatives[k].fused(a, addend.derivatives[k]);
                self.derivatives[k].fused(b, second)
            }),
        )
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn abs(self) -> Self {
        let sign = self.value.select(S::zero(), -S::one(), S::one());
        self.with(self.value.abs(), sign)
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn min(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        Self::new(a.min(b), self.both(other, |x, y| a.select(b, x, y)))
    }

    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline)]
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        let choose = |x, y| self.value.select(bound.value, x, y);
        Self::new(
            choose(less.value, otherwise.value),
            less.both(otherwise, choose),
        )
    }

    #[inline]
    fn sin(self) -> Self {
        self.with(self.value.sin(), self.value.cos())
    }

    #[inline]
    fn cos(self) -> Self {
        self.with(self.value.cos(), -self.value.sin())
    }

    #[inline]
    fn exp(self) -> Self {
        let value = self.value.exp();
        self.with(value, value)
    }

    #[inline]
    fn atan2(self, cosine: Self) -> Self {
        let (y, x) = (self.value, cosine.value);
        let inverse = x.fused(x, y * y).reciprocal();
        let (by_sine, by_cosine) = (x * inverse, -(y * inverse));
        let slope = self.both(cosine, |dy, dx| dy.fused(by_sine, by_cosine * dx));
        Self::new(y.atan2(x), slope)
    }

    #[inline]
    fn round(self) -> Self {
        Self::fixed(self.value.round())
    }

    #[inline]
    fn bounds_passed(self, count: usize, bound: impl Fn(usize) -> Self) -> Option<usize> {
        self.value.bounds_passed(count, |place| bound(place).value)
    }

    #[inline]
    fn sines_and_versines<const K: usize>(angles: &[Self; K]) -> [[Self; 2]; K] {
        let values = S::sines_and_versines(&angles.map(|angle| angle.value));
        from_fn(|k| {
            let [sine, versine] = values[k];
            [
                angles[k].with(sine, S::one() - versine),
                angles[k].with(versine, sine),
            ]
        })
    }
}

impl<S: Scalar + PartialOrd, const N: usize> PartialOrd for Forward<S, N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

#[diagnostic::do_not_recommend]
impl<S: Real, const N: usize> Real for Forward<S, N> {
    const EPSILON: Self = Self::new(S::EPSILON, [S::ZERO; N]);
    const ZERO: Self = Self::new(S::ZERO, [S::ZERO; N]);

    fn to_f64(self) -> f64 {
        self.value.to_f64()
    }

    fn is_finite(self) -> bool {
        self.value.is_finite() && self.derivatives.iter().all(|slope| slope.is_finite())
    }

    fn powf(self, exponent: f64) -> Self {
        let slope = S::constant(exponent) * self.value.powf(exponent - 1.0);
        self.with(self.value.powf(exponent), slope)
    }

    fn smallest() -> Self {
        Self::fixed(S::smallest())
    }

    fn ulp(self) -> Self {
        Self::fixed(self.value.ulp())
    }

    fn quotient(self, divisor: Self) -> Self {
        let value = self.value.quotient(divisor.value);
        let slopes = self.both(divisor, |x, y| (x - value * y).quotient(divisor.value));
        Self::new(value, slopes)
    }

    fn plain(self) -> Self {
        Self::fixed(self.value)
    }

    const CARRIES_DERIVATIVES: bool = true;

    fn derivative(self, direction: usize) -> Option<Self> {
        self.derivatives.get(direction).copied().map(Self::fixed)
    }

    fn with_larger_derivatives(self, other: Self) -> Self {
        let larger = |x: S, y: S| greater(x.abs(), y.abs());
        Self::new(self.value, self.both(other, larger))
    }

    fn largest_share(elements: impl Iterator<Item = [Self; 3]> + Clone, floor: Self) -> Self {
        Self::fixed(shares::largest(elements, floor))
    }
}

#[cfg(test)]
mod tests;
