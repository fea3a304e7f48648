//! num-dual's numbers as a scalar of the kernels.

use core::f64::consts::FRAC_PI_2;
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

    #[inline(never)]
    fn sin(self) -> Self {
        Self(DualNum::sin(&self.0))
    }

    #[inline(never)]
    fn cos(self) -> Self {
        Self(DualNum::cos(&self.0))
    }

    #[inline(never)]
    fn exp(self) -> Self {
        Self(DualNum::exp(&self.0))
    }

    #[inline(never)]
    fn atan2(self, cosine: Self) -> Self {
        // num-dual divides by the cosine, which may be zero.
        let (y, x) = (self.0, cosine.0);
        let slope = (x.re * y.eps - y.re * x.eps) / (x.re * x.re + y.re * y.re);
        Self::new(y.re.atan2(x.re), slope)
    }

    /// Piecewise constant.
    #[inline(never)]
    fn round(self) -> Self {
        Self(self.0.re.round().into())
    }
}

/// Derivatives of the functions of kernels, against central differences and in every quadrant.
#[test]
fn functions_carry_their_derivatives() {
    let step = 1e-6;
    let agree = |dual: fn(Dual) -> Dual, at: f64| {
        let exact = dual(Dual::new(at, 1.0)).derivative();
        let value = |x: f64| dual(Dual::new(x, 0.0)).0.re;
        let difference = (value(at + step) - value(at - step)) / (2.0 * step);
        assert!(
            (exact - difference).abs() < 1e-8 * (1.0 + exact.abs()),
            "{exact}"
        );
    };
    for at in [-2.8, -1.1, 0.3, FRAC_PI_2, 1.9, 2.7] {
        agree(Scalar::sin, at);
        agree(Scalar::cos, at);
        agree(Scalar::exp, at);
        agree(Scalar::round, at);
        agree(|x| x.sin().atan2(x.cos()), at);
        agree(|x| (x * x).atan2(x + Dual::constant(0.5)), at);
    }
    assert_eq!(Dual::new(2.5, 1.0).round(), Dual::new(3.0, 0.0));
}
