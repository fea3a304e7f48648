//! Numbers that are only known to lie between two bounds: kernels over them enclose what they
//! compute (Moore, Kearfott and Cloud, *Introduction to Interval Analysis*, chapters 2 and 5).

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::ops::{Add, Mul, Neg, Sub};

use crate::math::scalar::{Scalar, elementary};

/// By so many `EPSILON` a function of the library may be off, relative to its value.
const OFF: f64 = 4.0;

/// The numbers from one bound to another; none are known where a bound is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// All numbers.
    const ALL: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };
    /// No number.
    const NONE: Self = Self {
        low: f64::NAN,
        high: f64::NAN,
    };

    pub(crate) const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    /// Whether all numbers are of this sign, and none is zero.
    pub(crate) fn is_beside_zero(self, sign: f64) -> bool {
        if sign > 0.0 {
            self.low > 0.0
        } else {
            self.high < 0.0
        }
    }

    /// Whether zero is none of them.
    pub(crate) fn excludes_zero(self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    /// Whether it is zero alone.
    pub(crate) fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    fn is_none(self) -> bool {
        self.low.is_nan() || self.high.is_nan()
    }

    /// With bounds that were rounded `digits` times.
    fn widened(self, digits: f64) -> Self {
        let part = digits * f64::EPSILON;
        Self {
            low: self.low - part * self.low.abs(),
            high: self.high + part * self.high.abs(),
        }
    }

    fn hull(self, other: Self) -> Self {
        if self.is_none() || other.is_none() {
            return Self::NONE;
        }
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// The image under a function that grows.
    fn grown(self, function: impl Fn(f64) -> f64) -> Self {
        Self::new(function(self.low), function(self.high))
    }

    /// Whether an angle of the interval is `angle` and whole turns, as far as digits tell.
    fn meets(self, angle: f64) -> bool {
        let slack = OFF * f64::EPSILON * (self.low.abs().max(self.high.abs()) + TAU);
        let first = floor((self.low - slack - angle) / TAU);
        let last = floor((self.high + slack - angle) / TAU);
        last > first
    }

    /// The image under sine or cosine, by where these are largest.
    fn waved(self, function: impl Fn(f64) -> f64, top: f64) -> Self {
        if self.is_none() {
            return self;
        }
        let full = Self::new(-1.0, 1.0);
        let width = self.high - self.low;
        // Infinite bounds have an infinite width, or none.
        if width.is_nan() || width >= TAU {
            return full;
        }
        let ends = Self::new(function(self.low), function(self.high));
        let (low, high) = if ends.low <= ends.high {
            (ends.low, ends.high)
        } else {
            (ends.high, ends.low)
        };
        let slack = OFF * f64::EPSILON;
        let is_exact = width == 0.0 && low == 0.0 && self.low == 0.0;
        Self {
            low: match self.meets(top + PI) {
                true => -1.0,
                false if is_exact => low,
                false => low - slack,
            },
            high: match self.meets(top) {
                true => 1.0,
                false if is_exact => high,
                false => high + slack,
            },
        }
    }
}

/// The largest integer that is not above `x`.
fn floor(x: f64) -> f64 {
    let nearest = elementary::round64(x);
    if nearest > x { nearest - 1.0 } else { nearest }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.low + other.low, self.high + other.high).widened(1.0)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_none() || other.is_none() {
            return Self::NONE;
        }
        // Zero times a bound that is infinite: the number itself is not.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let corners = [
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ];
        let corners = corners.map(|corner| Self::new(corner, corner));
        let [a, b, c, d] = corners;
        a.hull(b).hull(c.hull(d)).widened(1.0)
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self::new(-self.high, -self.low)
    }
}

impl Scalar for Interval {
    fn constant(value: f64) -> Self {
        Self::new(value, value)
    }

    fn reciprocal(self) -> Self {
        if self.is_none() || self.excludes_zero() {
            Self::new(1.0 / self.high, 1.0 / self.low).widened(1.0)
        } else {
            Self::ALL
        }
    }

    fn sqrt(self) -> Self {
        // What is negative has no root, and no say.
        if self.high < 0.0 || self.is_none() {
            return Self::NONE;
        }
        let root = |x: f64| elementary::sqrt64(if x < 0.0 { 0.0 } else { x });
        self.grown(root).widened(1.0)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn abs(self) -> Self {
        if self.is_none() || self.low >= 0.0 {
            self
        } else if self.high <= 0.0 {
            -self
        } else {
            Self::new(0.0, self.high.max(-self.low))
        }
    }

    fn min(self, other: Self) -> Self {
        if self.is_none() || other.is_none() {
            return Self::NONE;
        }
        Self::new(self.low.min(other.low), self.high.min(other.high))
    }

    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        if self.is_none() || bound.is_none() {
            return Self::NONE;
        }
        if self.high < bound.low {
            less
        } else if self.low >= bound.high {
            otherwise
        } else {
            less.hull(otherwise)
        }
    }

    fn sin(self) -> Self {
        self.waved(elementary::sin64, FRAC_PI_2)
    }

    fn cos(self) -> Self {
        self.waved(elementary::cos64, 0.0)
    }

    fn exp(self) -> Self {
        let Self { low, high } = self.grown(elementary::exp64).widened(OFF);
        Self::new(low.max(0.0), high)
    }

    fn atan2(self, cosine: Self) -> Self {
        if self.is_none() || cosine.is_none() {
            return Self::NONE;
        }
        Self::new(-PI, PI).widened(1.0)
    }

    fn round(self) -> Self {
        self.grown(elementary::round64)
    }
}

#[cfg(test)]
mod tests;
