//! num-dual's numbers as a scalar of the kernels.

use core::ops::{Add, Mul, Neg, Sub};

use holonom::Scalar;
use num_dual::{Dual64, DualNum};

/// A value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual(pub Dual64);

impl Dual {
    /// A value and its derivative.
    pub(crate) fn new(value: f64, derivative: f64) -> Self {
        Self(Dual64::new(value, derivative))
    }

    /// The derivative.
    pub(crate) fn derivative(self) -> f64 {
        self.0.eps
    }
}

impl Add for Dual {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Sub for Dual {
    type Output = Self;

    #[inline(never)]
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl Mul for Dual {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl Neg for Dual {
    type Output = Self;

    #[inline(never)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Scalar for Dual {
    #[inline(never)]
    fn constant(value: f64) -> Self {
        Self(value.into())
    }

    #[inline(never)]
    fn reciprocal(self) -> Self {
        Self(self.0.recip())
    }

    #[inline(never)]
    fn sqrt(self) -> Self {
        Self(DualNum::sqrt(&self.0))
    }

    #[inline(never)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    #[inline(never)]
    fn abs(self) -> Self {
        if self.0.re < 0.0 { -self } else { self }
    }

    #[inline(never)]
    fn min(self, other: Self) -> Self {
        if self.0.re < other.0.re || self.0.re.is_nan() {
            self
        } else {
            other
        }
    }

    #[inline(never)]
    fn select(self, bound: Self, less: Self, otherwise: Self) -> Self {
        if self.0.re < bound.0.re {
            less
        } else {
            otherwise
        }
    }
}
