//! Embedded pairs of Runge-Kutta methods, and what a user says of their steps.

use super::controlled::{hooks_of_control, step_limits};
use super::{
    AdaptiveIntegration, BogackiShampine3, DormandPrince5, DormandPrince8, ErrorModel, FixedStep,
    Integrator, Method, OneStep, Scheme, StepLimits, StepRecord, System, TimeSpan, Tolerance,
};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A one-step method that estimates the error of its steps. Its last slope is that at the end of a
/// step, and the first of the next one.
pub trait EmbeddedPair<S: Real>: Scheme<S> + PartialEq {
    /// The power of the step that its estimate goes with.
    const POWER: f64;

    /// The error of a step, relative element by element to the larger of both ends and `floor`.
    fn error<X: Vector<S>>(&self, record: &StepRecord<'_, S, X, Self::Stages<X>>, floor: S) -> S;
}

/// An [`EmbeddedPair`] with the step control of MATLAB's `ode45` and `ode23`.
///
/// First-same-as-last: an integration without faults takes `n k + 1` evaluations for `k` steps,
/// accepted and rejected, of `n` evaluations each. The control (Shampine and Reichelt, *The MATLAB
/// ODE Suite*, SIAM J. Sci. Comput. 18 (1997), 1-22, with later versions), with `p` the power of
/// the step that the error goes with:
///
/// - first step `min(T / 10, time to the first output)`, made smaller to
///   `0.8 rtol^(1/p) / max |y'| / max(|y|, atol / rtol)`; largest step `T / 10`, smallest
///   `16 ulp(t)`;
/// - error `h max |E| / max(|y|, |y new|, atol / rtol)`, accepted up to `rtol`;
/// - after an acceptance `h / max(0.2, 1.25 (error / rtol)^(1/p))`, unchanged if the step had been
///   rejected before;
/// - after a rejection `h max(0.1, 0.8 (rtol / error)^(1/p))`, then halves;
/// - the step is stretched to the end of the interval if `1.1 h` reaches it.
///
/// Beyond these: a trial whose rates cannot be computed counts as rejected and is tried again with
/// half the step, and the integration ends with that fault only where the step gets too small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptive<S, K> {
    /// The error to be allowed in a step.
    pub tolerance: Tolerance<S>,
    /// What steps are held to besides.
    pub limits: StepLimits<S>,
    /// The method.
    pub pair: K,
}

step_limits!(Adaptive<S, K>);

/// The constructors of a pair.
macro_rules! constructors {
    ($pair:ident) => {
        impl<S> Adaptive<S, $pair> {
            /// The method with a tolerance.
            #[must_use]
            pub const fn new(tolerance: Tolerance<S>) -> Self {
                Self {
                    tolerance,
                    limits: StepLimits::new(),
                    pair: $pair,
                }
            }

            /// The same method at a fixed step (s), without control of the error.
            #[must_use]
            pub const fn every(step: S) -> FixedStep<S, $pair> {
                FixedStep {
                    step,
                    scheme: $pair,
                }
            }
        }

        /// With the default [`Tolerance`].
        impl<S: Real> Default for Adaptive<S, $pair> {
            fn default() -> Self {
                Self::new(Tolerance::default())
            }
        }
    };
}

constructors!(BogackiShampine3);
constructors!(DormandPrince5);
constructors!(DormandPrince8);

impl<S, K, Y> Integrator<S, Y> for Adaptive<S, K>
where
    S: Real,
    K: EmbeddedPair<S> + OneStep<S, Y>,
    Y: System<S>,
{
    type Integration = AdaptiveIntegration<S, Y::State, K>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<AdaptiveIntegration<S, Y::State, K>, Fault> {
        AdaptiveIntegration::start(self, system, span, state)
    }
}

impl<S: Real, K: EmbeddedPair<S>> Method<S> for Adaptive<S, K> {
    fn budget(&self) -> Option<usize> {
        Some(self.limits.evaluations)
    }

    /// The result of a step is of one order more than what its error is estimated of.
    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            estimate_power: (K::POWER + 1.0) / K::POWER,
            ..self.pair.error_model()
        }
    }

    hooks_of_control!(S);

    fn companion(&self, duration: S) -> Option<Self> {
        Some(Self {
            tolerance: self.tolerance.of_companion(),
            limits: self.limits.of_companion(duration),
            ..*self
        })
    }
}
