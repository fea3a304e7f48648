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

    /// The same, where its settings depend on nothing, or for directions of such scales.
    fn lifted(self, scales: Option<&[S; K]>) -> Self::Carrying;

    /// Its settings depend on nothing.
    #[must_use]
    fn carrying(self) -> Self::Carrying {
        self.lifted(None)
    }

    /// The same for directions of such scales: changes of parameters that count. A method that
    /// controls its steps holds derivatives to the absolute tolerance of values over them.
    #[must_use]
    fn scaled(self, scales: &[S; K]) -> Self::Carrying {
        self.lifted(Some(scales))
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for StandardLagrange {
    type Carrying = Self;

    fn lifted(self, _scales: Option<&[S; K]>) -> Self {
        self
    }
}

impl<S: Real, const K: usize> Differentiable<S, K> for Tolerance<S> {
    type Carrying = Tolerance<Forward<S, K>>;

    fn lifted(self, scales: Option<&[S; K]>) -> Self::Carrying {
        let absolute = self.absolute;
        Tolerance {
            relative: Forward::fixed(self.relative),
            absolute: match scales {
                Some(scales) => {
                    Forward::new(absolute, scales.map(|scale| absolute.quotient(scale)))
                }
                None => Forward::fixed(absolute),
            },
        }
    }
}

/// Settings field by field: a `number`, an optional one (`maybe`), what is no number (`same`), or
/// settings that are differentiable themselves (`settings`).
macro_rules! differentiable {
    ($($type:ident $([$with:ident])? { $($field:ident: $kind:ident),* $(,)? })*) => {$(
        impl<S: Real, const K: usize> Differentiable<S, K> for $type<S $(, $with)?> {
            type Carrying = $type<Forward<S, K> $(, $with)?>;

            fn lifted(self, scales: Option<&[S; K]>) -> Self::Carrying {
                let _ = scales;
                $type { $($field: differentiable!(@$kind self.$field, scales)),* }
            }
        }
    )*};
    (@number $value:expr, $scales:expr) => { Forward::fixed($value) };
    (@maybe $value:expr, $scales:expr) => { $value.map(Forward::fixed) };
    (@same $value:expr, $scales:expr) => { $value };
    (@settings $value:expr, $scales:expr) => { $value.lifted($scales) };
}

differentiable! {
    Baumgarte { alpha: number, beta: number }
    Penalty { alpha: number, omega: number, mu: number, radian: maybe }
    AugmentedLagrangian {
        alpha: number, omega: number, mu: number, radian: maybe,
        tolerance: number, max_iterations: same, is_exact: same,
    }
    StepLimits { first: maybe, least: maybe, largest: maybe, evaluations: same }
    FixedStep[SemiImplicitEuler] { step: number, scheme: same }
    FixedStep[Midpoint] { step: number, scheme: same }
    FixedStep[Heun] { step: number, scheme: same }
    FixedStep[Kutta3] { step: number, scheme: same }
    FixedStep[Rk4] { step: number, scheme: same }
    FixedStep[BogackiShampine3] { step: number, scheme: same }
    FixedStep[DormandPrince5] { step: number, scheme: same }
    FixedStep[DormandPrince8] { step: number, scheme: same }
    AdamsBashforthMoulton4 { step: number }
    Adaptive[BogackiShampine3] { tolerance: settings, limits: settings, pair: same }
    Adaptive[DormandPrince5] { tolerance: settings, limits: settings, pair: same }
    Adaptive[DormandPrince8] { tolerance: settings, limits: settings, pair: same }
    Adams { tolerance: settings, limits: settings }
}
