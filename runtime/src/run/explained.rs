//! What a run knows of the cause of a fault.

use crate::constraints::row_units::characteristic_length;
use crate::error::{Fault, ModeFault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::fastest;
use crate::nonsmooth::jam;
use crate::run::driver::Driver;
use crate::run::passages::LENGTH;
use crate::state::vector::Vector as _;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// A fault with what the run knows of its cause.
    #[cold]
    pub(super) fn explained(&self, fault: Fault, last_good: StateAt<S, M>) -> Fault {
        /// A violation that decays at a rate `a` is stable under an explicit method of order 4 or 5
        /// up to about this over `a`, and grows for some time from somewhat less on.
        const STABLE: f64 = 2.0;
        /// Radians in a step that no motion has, and lengths of a mechanism that no joint is open
        /// by.
        const BEYOND: f64 = 1e6;
        let equations = self.march.equations();
        let fault = jam::explained(equations.interactions(), fault, last_good.time);
        let not_finite = matches!(
            fault,
            Fault::Step(StepFault::RatesNotFinite { .. } | StepFault::StateNotFinite)
        );
        if not_finite
            && let (Some(step), Some(rate)) =
                (self.course.settings.fixed_step, equations.decay_rate())
            && step * rate > S::constant(STABLE)
        {
            return Fault::Step(StepFault::TooLong {
                step: step.to_f64(),
                rate: rate.to_f64(),
            });
        }
        let (constants, state) = (equations.constants(), &last_good.bodies);
        // A step in which something turns by radians, or moves by lengths of the mechanism, is too
        // long whatever came of it: pivots of such numbers may vanish, too.
        let turned = match fault {
            Fault::Step(StepFault::Singular { .. }) => Some(BEYOND),
            Fault::Step(StepFault::ZeroOrientation { .. }) => {
                self.course.gone.is_some().then_some(1.0)
            }
            // Points that an unstable method throws across each other, step by step.
            Fault::Mode(ModeFault::SlidingLaw {
                expression: LENGTH, ..
            }) => Some(1.0),
            // What a law of time pulls out of reach moves as fast, but is not open as wide.
            Fault::Step(StepFault::NotConverged { residual, .. }) => {
                let length = characteristic_length::<S, M>(constants, state);
                let is_wide = exceeds(S::constant(residual), BEYOND * length.to_f64());
                let is_lost = is_wide || !M::REPORT.time.constraints;
                (self.course.gone.is_some() && is_lost).then_some(1.0)
            }
            _ => not_finite.then_some(1.0),
        };
        let rate = fastest::<S, M>(constants, state);
        let rate = self.course.gone.map_or(rate, |gone| rate.max(gone));
        if let (Some(turned), Some(step)) = (turned, self.course.settings.fixed_step)
            && (exceeds(step * rate, turned) || not_finite && has_grown::<S, M>(state))
        {
            return Fault::Step(StepFault::Unstable {
                step: step.to_f64(),
            });
        }
        let tolerance = self.course.settings.tolerance;
        equations.explained(fault, tolerance.map(|of| of.absolute), last_good)
    }
}

/// Whether derivatives that a state carries are beyond what may be multiplied. What stands still
/// may have such derivatives where a step is too long.
fn has_grown<S: Real, M: Mechanism>(state: &M::State<S>) -> bool {
    let largest = S::smallest().sqrt().reciprocal().to_f64();
    let mut grown = false;
    state.for_each(|element| {
        let slopes = (0..).map_while(|direction| element.derivative(direction));
        grown |= slopes.fold(false, |any, slope| any | exceeds(slope.abs(), largest));
    });
    grown
}

/// Whether a number is above a bound; what is no number is above any.
fn exceeds<S: Real>(number: S, bound: f64) -> bool {
    let is_within = number <= S::constant(bound);
    !is_within
}
