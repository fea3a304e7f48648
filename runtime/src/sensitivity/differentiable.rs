//! Through what derivatives go.

use crate::formulation::{AugmentedLagrangian, Baumgarte, Penalty, StandardLagrange};
use crate::forward::Forward;
use crate::integrate::{
    Adams, AdamsBashforthMoulton4, Adaptive, BogackiShampine3, DormandPrince5, DormandPrince8,
    FixedStep, Heun, Kutta3, Midpoint, Rk4, SemiImplicitEuler, StepLimits, Tolerance,
};
use crate::math::scalar::Real;

/// A formulation or an integrator that derivatives go through: all formulations, and explicit
/// methods.
///
/// The derivatives of an [`AugmentedLagrangian`] are as exact as its tolerance.
#[diagnostic::on_unimplemented(
    message = "derivatives do not go through `{Self}`",
    label = "neither a formulation nor an explicit method",
    note = "take `Rk4::every(step)` or `DormandPrince::new(tolerance)`: an implicit method ends its \
            iteration when the values are right, and the derivatives are not yet"
)]
pub trait Differentiable<S: Real, const K: usize>: Sized {
    /// The same for numbers that carry derivatives along `K` directions.
    type Carrying;

    /// Its settings depend on nothing.
    fn carrying(self) -> Self::Carrying;

    /// The same for directions of such scales: changes of parameters that count. A method that
    /// controls its steps holds derivatives to the absolute tolerance of values over them.
    #[must_use]
    fn scaled(self, scales: &[S; K]) -> Self::Carrying {
        let _ = scales;
        self.carrying()
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for StandardLagrange {
    type Carrying = Self;

    fn carrying(self) -> Self {
        self
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for Baumgarte<S> {
    type Carrying = Baumgarte<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        Baumgarte {
            alpha: Forward::fixed(self.alpha),
            beta: Forward::fixed(self.beta),
        }
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for Penalty<S> {
    type Carrying = Penalty<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        Penalty {
            alpha: Forward::fixed(self.alpha),
            omega: Forward::fixed(self.omega),
            mu: Forward::fixed(self.mu),
            radian: self.radian.map(Forward::fixed),
        }
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for AugmentedLagrangian<S> {
    type Carrying = AugmentedLagrangian<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        AugmentedLagrangian {
            alpha: Forward::fixed(self.alpha),
            omega: Forward::fixed(self.omega),
            mu: Forward::fixed(self.mu),
            radian: self.radian.map(Forward::fixed),
            tolerance: Forward::fixed(self.tolerance),
            max_iterations: self.max_iterations,
            is_exact: self.is_exact,
        }
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for Tolerance<S> {
    type Carrying = Tolerance<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        Tolerance {
            relative: Forward::fixed(self.relative),
            absolute: Forward::fixed(self.absolute),
        }
    }

    fn scaled(self, scales: &[S; K]) -> Self::Carrying {
        Tolerance {
            relative: Forward::fixed(self.relative),
            absolute: Forward::new(
                self.absolute,
                scales.map(|scale| self.absolute.quotient(scale)),
            ),
        }
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for StepLimits<S> {
    type Carrying = StepLimits<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        StepLimits {
            first: self.first.map(Forward::fixed),
            least: self.least.map(Forward::fixed),
            largest: self.largest.map(Forward::fixed),
            evaluations: self.evaluations,
        }
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for AdamsBashforthMoulton4<S> {
    type Carrying = AdamsBashforthMoulton4<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        AdamsBashforthMoulton4 {
            step: Forward::fixed(self.step),
        }
    }
}

/// Explicit one-step methods.
macro_rules! explicit {
    ($($scheme:ident),*) => {$(
        impl<S: Real, const K: usize> Differentiable<S, K> for FixedStep<S, $scheme> {
            type Carrying = FixedStep<Forward<S, K>, $scheme>;

            fn carrying(self) -> Self::Carrying {
                FixedStep {
                    step: Forward::fixed(self.step),
                    scheme: self.scheme,
                }
            }
        }
    )*};
}

explicit!(
    SemiImplicitEuler,
    Midpoint,
    Heun,
    Kutta3,
    Rk4,
    BogackiShampine3,
    DormandPrince5,
    DormandPrince8
);

/// Embedded pairs of them.
macro_rules! embedded {
    ($($pair:ident),*) => {$(
        impl<S: Real, const K: usize> Differentiable<S, K> for Adaptive<S, $pair> {
            type Carrying = Adaptive<Forward<S, K>, $pair>;

            fn carrying(self) -> Self::Carrying {
                Adaptive {
                    tolerance: self.tolerance.carrying(),
                    limits: self.limits.carrying(),
                    pair: self.pair,
                }
            }

            fn scaled(self, scales: &[S; K]) -> Self::Carrying {
                Adaptive {
                    tolerance: self.tolerance.scaled(scales),
                    limits: self.limits.carrying(),
                    pair: self.pair,
                }
            }
        }
    )*};
}

embedded!(BogackiShampine3, DormandPrince5, DormandPrince8);

impl<S: Real, const K: usize> Differentiable<S, K> for Adams<S> {
    type Carrying = Adams<Forward<S, K>>;

    fn carrying(self) -> Self::Carrying {
        Adams {
            tolerance: self.tolerance.carrying(),
            limits: self.limits.carrying(),
        }
    }

    fn scaled(self, scales: &[S; K]) -> Self::Carrying {
        Adams {
            tolerance: self.tolerance.scaled(scales),
            limits: self.limits.carrying(),
        }
    }
}
