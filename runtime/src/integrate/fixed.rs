//! A scheme at a fixed step.

use super::lobatto::better_end;
use super::record::{LastStep, Reached, reached};
use super::{
    Advance, Counts, ErrorModel, Heun, ImplicitMidpoint, Integration, Integrator, Kutta3, Memory,
    Method, Midpoint, OneStep, Rk4, Scheme, SemiImplicitEuler, Slopes, StepStart, System, TimeSpan,
    refused,
};
use crate::error::setting::positive;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// A [`Scheme`] at a fixed step: times `t0 + k h`, the last step shortened to the end of the
/// interval.
///
/// Steps do not depend on output times; output between steps is by the interpolant of the scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedStep<S, K> {
    /// The step `h` (s).
    pub step: S,
    /// The method.
    pub scheme: K,
}

/// The constructors of methods that are schemes themselves.
macro_rules! constructors {
    ($($scheme:ident),*) => {$(
        impl $scheme {
            /// This method with a fixed step (s), for [`Simulation`](crate::Simulation).
            #[must_use]
            pub const fn every<S>(step: S) -> FixedStep<S, Self> {
                FixedStep { step, scheme: Self }
            }
        }
    )*};
}

constructors!(
    SemiImplicitEuler,
    Midpoint,
    Heun,
    ImplicitMidpoint,
    Kutta3,
    Rk4
);

impl<S: Real, K: OneStep<S, Y>, Y: System<S>> Integrator<S, Y> for FixedStep<S, K> {
    type Integration = FixedIntegration<S, Y::State, K>;

    fn start(
        &self,
        system: &mut Y,
        span: TimeSpan<S>,
        state: Y::State,
    ) -> Result<FixedIntegration<S, Y::State, K>, Fault> {
        let grid = Grid::new(self.step, &span)?;
        let reached = Reached::start(system, &span, state)?;
        Ok(FixedIntegration {
            scheme: self.scheme,
            grid,
            last: LastStep::none(&reached),
            stages: self.scheme.stages(&reached.slope),
            is_prepared: false,
            reached,
        })
    }
}

impl<S: Real, K: Scheme<S>> Method<S> for FixedStep<S, K> {
    fn fixed_step(&self) -> Option<S> {
        Some(self.step)
    }

    fn companion(&self, _duration: S) -> Option<Self> {
        let step = self.step * S::constant(0.5);
        Some(Self { step, ..*self })
    }

    fn error_model(&self) -> ErrorModel {
        self.scheme.error_model()
    }
}

/// The times of a fixed step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid<S> {
    pub(super) nominal: S,
    origin: S,
    pub(super) end: S,
}

impl<S: Real> Grid<S> {
    pub(super) fn new(step: S, span: &TimeSpan<S>) -> Result<Self, Fault> {
        let nominal = positive("step", step)?;
        span.duration()?;
        Ok(Self {
            nominal,
            origin: span.start,
            end: span.end,
        })
    }

    /// The next step after so many, and the time that it leads to.
    pub(super) fn next(&self, accepted: usize, time: S) -> Result<(S, S), Fault> {
        let index = S::constant((accepted + 1) as f64);
        let mut end = index.fused(self.nominal, self.origin);
        let mut step = self.nominal;
        if end + S::constant(8.0) * self.end.ulp() >= self.end {
            end = self.end;
            step = end - time;
        }
        if end <= time {
            return Err(Fault::Step(StepFault::TooShort {
                step: step.to_f64(),
                time: time.to_f64(),
            }));
        }
        Ok((step, end))
    }
}

/// An integration with a [`FixedStep`] under way.
pub struct FixedIntegration<S: Real, X: Vector<S>, K: Scheme<S>> {
    scheme: K,
    grid: Grid<S>,
    reached: Reached<S, X>,
    last: LastStep<S, X>,
    stages: K::Stages<X>,
    /// Whether the interpolant has what it needs besides these.
    is_prepared: bool,
}

opaque!([S: Real, X: Vector<S>, K: Scheme<S>] FixedIntegration<S, X, K>, "FixedIntegration");

impl<S: Real, X: Vector<S>, K: Scheme<S>> Integration<S, X> for FixedIntegration<S, X, K> {
    reached!();

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        true
    }
}

impl<S: Real, K: OneStep<S, Y>, Y: System<S>> Advance<S, Y> for FixedIntegration<S, Y::State, K> {
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        let reached = &mut self.reached;
        let (step, end) = self.grid.next(reached.counts.accepted, reached.time)?;
        let mut counted = Slopes::counted(system, &mut reached.counts);
        let start = StepStart {
            time: reached.time,
            state: &reached.state,
            slope: &reached.slope,
        };
        let outcome = self
            .scheme
            .advanced(&mut counted, start, step, &mut self.stages);
        let mut state = match outcome {
            Ok(state) if state.is_finite() => state,
            outcome => {
                let from = (reached.time, &reached.state);
                return Err(refused(&self.scheme, system, from, step, outcome.err()));
            }
        };
        system.follow(&reached.state, step, &mut state);
        system.renormalise(&mut state, None);
        self.last.take(reached, (step, end), state);
        self.is_prepared = false;
        Ok(())
    }

    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault> {
        self.reached.know_slope(system)?;
        if !self.is_prepared {
            let (reached, stages) = (&mut self.reached, &mut self.stages);
            self.last.prepare(&self.scheme, system, reached, stages)?;
            self.is_prepared = true;
        }
        let record = self.last.record(&self.reached, &self.stages);
        let theta = self.last.theta(&self.reached, time);
        Ok(self.scheme.interpolate(record, theta))
    }

    fn better_end(&self, system: &mut Y) -> Result<Option<Y::State>, Fault> {
        if self.scheme.error_model().phase_error == 0.0 {
            return Ok(None);
        }
        better_end(system, &self.last, &self.reached).map(Some)
    }
}
