//! An embedded pair under the control of its steps.

use core::mem::swap;

use super::controller::{Controller, FIRST_SHARE};
use super::record::{LastStep, Reached, reached};
use super::{
    Adaptive, Advance, Counts, EmbeddedPair, Integration, Memory, OneStep, Slopes, StepRecord,
    StepStart, System, TimeSpan, named,
};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// An integration with an [`Adaptive`] method under way.
pub struct AdaptiveIntegration<S: Real, X: Vector<S>, K: EmbeddedPair<S>> {
    pair: K,
    controller: Controller<S>,
    /// The size of the next step.
    next_step: S,
    reached: Reached<S, X>,
    last: LastStep<S, X>,
    stages: K::Stages<X>,
    /// Whether the interpolant has what it needs besides these.
    is_prepared: bool,
}

opaque!([S: Real, X: Vector<S>, K: EmbeddedPair<S>] AdaptiveIntegration<S, X, K>, "AdaptiveIntegration");

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> Clone for AdaptiveIntegration<S, X, K> {
    fn clone(&self) -> Self {
        Self {
            reached: self.reached.clone(),
            last: self.last.clone(),
            stages: self.stages.clone(),
            ..*self
        }
    }
}

/// What a trial ended with.
enum Trial<S, X> {
    Accepted { state: X, error: S },
    Rejected { error: S },
}

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> AdaptiveIntegration<S, X, K> {
    pub(super) fn start<Y: System<S, State = X>>(
        method: &Adaptive<S, K>,
        system: &mut Y,
        span: TimeSpan<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let controller = Controller::new(method.tolerance, &method.limits, K::POWER, &span)?;
        let reached = Reached::start(system, &span, state)?;
        Ok(Self {
            pair: method.pair,
            controller,
            next_step: controller.first(&span, &reached.state, &reached.slope, FIRST_SHARE),
            last: LastStep::none(&reached),
            stages: method.pair.stages(&reached.slope),
            is_prepared: false,
            reached,
        })
    }

    /// One trial from the slope `self.last.first`, to the time `end`; leaves the slope at the end
    /// in `self.reached`.
    #[inline]
    fn attempt<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        step: S,
        end: S,
    ) -> Result<Trial<S, X>, Fault>
    where
        K: OneStep<S, Y>,
    {
        let reached = &mut self.reached;
        let mut counted = Slopes::counted(system, &mut reached.counts);
        let start = StepStart {
            time: reached.time,
            state: &reached.state,
            slope: &self.last.first,
        };
        let outcome = self
            .pair
            .advanced(&mut counted, start, step, &mut self.stages)
            .and_then(|state| {
                counted.stage(end, &state, &mut reached.slope)?;
                Ok(state)
            });
        let state = match outcome {
            Ok(state) => state,
            Err(fault) => {
                let named = self.refused(system, step, end, Some(fault));
                return Err(named.unwrap_or(fault));
            }
        };
        let record = StepRecord {
            step,
            from: &reached.state,
            first: &self.last.first,
            stages: &self.stages,
            to: &state,
            last: &reached.slope,
        };
        let error = self.pair.error(&record, self.controller.floor);
        if !(error.is_finite() && state.is_finite()) {
            return match self.refused(system, step, end, None) {
                Some(fault) => Err(fault),
                None => Ok(Trial::Rejected { error }),
            };
        }
        Ok(if self.controller.accepts(error) {
            Trial::Accepted { state, error }
        } else {
            Trial::Rejected { error }
        })
    }

    /// Why a trial failed, or why its end or its error is not finite; `None` where all rates are
    /// finite, and only their sums are not.
    #[cold]
    #[inline(never)]
    fn refused<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        step: S,
        end: S,
        fault: Option<Fault>,
    ) -> Option<Fault>
    where
        K: OneStep<S, Y>,
    {
        named(fault, system, |system| {
            let start = StepStart {
                time: self.reached.time,
                state: &self.reached.state,
                slope: &self.last.first,
            };
            let state = self.pair.advanced(system, start, step, &mut self.stages)?;
            system.rates(end, &state)
        })
    }
}

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> Integration<S, X> for AdaptiveIntegration<S, X, K> {
    reached!();

    fn remember(&mut self, memory: &mut Memory<'_, S>) -> bool {
        self.reached.remember(memory);
        memory.number(&mut self.next_step);
        true
    }
}

impl<S, K, Y> Advance<S, Y> for AdaptiveIntegration<S, Y::State, K>
where
    S: Real,
    K: EmbeddedPair<S> + OneStep<S, Y>,
    Y: System<S>,
{
    fn advance(&mut self, system: &mut Y) -> Result<(), Fault> {
        self.reached.know_slope(system)?;
        swap(&mut self.last.first, &mut self.reached.slope);
        let time = self.reached.time;
        let smallest = self.controller.smallest(time);
        let (mut size, mut stretched) = self.controller.opening(time, self.next_step);
        let mut failed_before = false;
        loop {
            let end = self.controller.end_of(time, size, stretched);
            let outcome = self.attempt(system, size, end);
            if let Ok(Trial::Accepted { mut state, error }) = outcome {
                system.renormalise(&mut state, Some(&mut self.reached.slope));
                system.follow(&self.reached.state, end - time, &mut state);
                self.is_prepared = false;
                self.last.go(&mut self.reached, (end - time, end), state);
                self.reached.estimate = Some(error);
                self.next_step = if failed_before {
                    size
                } else {
                    self.controller.grown(size, error)
                };
                return Ok(());
            }
            self.reached.counts.rejected += 1;
            stretched = false;
            if size <= smallest {
                return Err(match outcome {
                    Err(fault) => fault,
                    Ok(_) => self.controller.underflow(size, time),
                });
            }
            let shrunk = match outcome {
                Ok(Trial::Rejected { error }) if !failed_before => {
                    self.controller.shrunk(size, error)
                }
                _ => S::constant(0.5) * size,
            };
            size = smallest.max(shrunk);
            failed_before = true;
        }
    }

    fn at(&mut self, system: &mut Y, time: S) -> Result<Y::State, Fault> {
        if !self.is_prepared {
            let (reached, stages) = (&mut self.reached, &mut self.stages);
            self.last.prepare(&self.pair, system, reached, stages)?;
            self.is_prepared = true;
        }
        let record = self.last.record(&self.reached, &self.stages);
        let theta = self.last.theta(&self.reached, time);
        Ok(self.pair.interpolate(record, theta))
    }
}
