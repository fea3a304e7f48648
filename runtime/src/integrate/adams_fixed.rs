//! The predictor-corrector method of Adams at a fixed step.

use core::mem::swap;

use super::fixed::Grid;
use super::record::{LastStep, Reached, reached};
use super::tableau::terms;
use super::{
    Advance, Counts, ErrorModel, Integration, Integrator, Look, Memory, Method, NoStages,
    OneStep as _, Rk4, Slopes, StepStart, System, TimeSpan, dense, named,
};
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// The method of Adams, Bashforth and Moulton of order 4 at a fixed step: predicted from the slopes
/// at four times, corrected with that at the predicted state. Two evaluations a step, whatever the
/// order; no estimate of the error.
///
/// With `h` the step, `f0` the slope at its start and `f1`, `f2`, `f3` those at the starts of the
/// steps before, `y* = y + h/24 (55 f0 - 59 f1 + 37 f2 - 9 f3)` and
/// `y + h/24 (9 f(t + h, y*) + 19 f0 - 5 f1 + f2)`: Hairer, Norsett and Wanner, *Solving Ordinary
/// Differential Equations I*, (III.1.5) and (III.1.8), evaluated after both (PECE). The first three
/// steps, and a last one that is shortened to the end of the interval, are those of [`Rk4`]. Output
/// within a step is by the cubic through states and slopes at both ends.
///
/// A state that was corrected after a step goes on with the slope there; the slopes before stay as
/// they were.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdamsBashforthMoulton4<S> {
    /// The step `h` (s).
    pub step: S,
}

impl<S> AdamsBashforthMoulton4<S> {
    /// The method with this step (s).
    #[must_use]
    pub const fn every(step: S) -> Self {
        Self { step }
    }
}

/// Of the slopes at the start of a step and of the three before, newest first.
const PREDICTOR: [f64; 4] = [55.0 / 24.0, -59.0 / 24.0, 37.0 / 24.0, -9.0 / 24.0];

/// Of the slope at the predicted state, at the start of the step and of the two before.
const CORRECTOR: [f64; 4] = [9.0 / 24.0, 19.0 / 24.0, -5.0 / 24.0, 1.0 / 24.0];

/// Steps of an integration until it has the slopes that it needs.
const FIRST_STEPS: usize = 3;

/// For steps of half a radian an angle is off by half of what `|p|` leaves its length by.
const ANGLE_ERROR: f64 = 1.0;
/// The limit of that ratio times half the angle of a step, from the root of the method's polynomial
/// next to `exp(i z)`.
const ANGLE_ERROR_OF_SHORT_STEPS: f64 = 0.33;

impl<S: Real, Y: System<S>> Integrator<S, Y> for AdamsBashforthMoulton4<S> {
    type Integration = AdamsFixedIntegration<S, Y::State>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<AdamsFixedIntegration<S, Y::State>, Fault> {
        let grid = Grid::new(self.step, &span)?;
        let reached = Reached::start(system, &span, state)?;
        let slope = &reached.slope;
        Ok(AdamsFixedIntegration {
            grid,
            before: [slope.clone(), slope.clone()],
            last: LastStep::none(&reached),
            reached,
        })
    }
}

impl<S: Real> Method<S> for AdamsBashforthMoulton4<S> {
    fn fixed_step(&self) -> Option<S> {
        Some(self.step)
    }

    fn companion(&self, _duration: S) -> Option<Self> {
        let step = self.step * S::constant(0.5);
        Some(Self { step })
    }

    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            angle_error: ANGLE_ERROR,
            angle_error_of_short_steps: ANGLE_ERROR_OF_SHORT_STEPS,
            ..Default::default()
        }
    }
}

/// An integration with [`AdamsBashforthMoulton4`] under way.
#[derive(Clone)]
pub struct AdamsFixedIntegration<S: Real, X: Vector<S>> {
    grid: Grid<S>,
    reached: Reached<S, X>,
    last: LastStep<S, X>,
    /// The slopes at the starts of the two steps before the last, newest first.
    before: [X; 2],
}

opaque!([S: Real, X: Vector<S>] AdamsFixedIntegration<S, X>, "AdamsFixedIntegration");

impl<S: Real, X: Vector<S>> AdamsFixedIntegration<S, X> {
    /// Whether a step is one of those that the slopes before it belong to. The last one may differ
    /// from them by the round-off of its ends.
    fn goes_on(&self, step: S) -> bool {
        let round_off = S::constant(16.0) * self.grid.end.ulp();
        self.reached.counts.accepted >= FIRST_STEPS && (self.grid.nominal - step).abs() <= round_off
    }

    /// The state after a step; not finite where a slope is not.
    fn advanced<Y: System<S, State = X>, L: Look<S, X>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        step: S,
    ) -> Result<X, Fault> {
        let Reached {
            time,
            state,
            slope: first,
            ..
        } = &self.reached;
        let (time, second, [third, fourth]) = (*time, &self.last.first, &self.before);
        if !self.goes_on(step) {
            let start = StepStart {
                time,
                state,
                slope: first,
            };
            return Rk4.advanced(system, start, step, &mut NoStages);
        }
        let predicted = state.plus(terms(PREDICTOR, step, [first, second, third, fourth]));
        let mut slope = first.clone();
        system.stage(time + step, &predicted, &mut slope)?;
        Ok(state.plus(terms(CORRECTOR, step, [&slope, first, second, third])))
    }

    /// Why a step failed, or led to a state that is not finite.
    #[cold]
    #[inline(never)]
    fn refused<Y: System<S, State = X>>(
        &self,
        system: &mut Y,
        step: S,
        fault: Option<Fault>,
    ) -> Fault {
        named(fault, system, |system| self.advanced(system, step))
            .unwrap_or(Fault::Step(StepFault::StateNotFinite))
    }
}

impl<S: Real, X: Vector<S>> Integration<S, X> for AdamsFixedIntegration<S, X> {
    reached!();

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.vector(&mut self.last.first);
        for slope in &mut self.before {
            memory.vector(slope);
        }
        true
    }
}

impl<S: Real, Y: System<S>> Advance<S, Y> for AdamsFixedIntegration<S, Y::State> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        let reached = &self.reached;
        let (step, end) = self.grid.next(reached.counts.accepted, reached.time)?;
        let mut counts = reached.counts;
        let mut counted = Slopes::counted(system, &mut counts);
        let outcome = self.advanced(&mut counted, step);
        self.reached.counts = counts;
        let mut state = match outcome {
            Ok(state) if state.is_finite() => state,
            outcome => return Err(self.refused(system, step, outcome.err())),
        };
        system.renormalise(&mut state, None);
        system.follow(&self.reached.state, step, &mut state);
        let [third, fourth] = &mut self.before;
        swap(third, fourth);
        swap(&mut self.last.first, third);
        self.last.take(&mut self.reached, (step, end), state);
        Ok(())
    }

    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault> {
        self.reached.know_slope(system)?;
        let record = self.last.record(&self.reached, &NoStages);
        Ok(dense::cubic(&record, self.last.theta(&self.reached, time)))
    }
}
