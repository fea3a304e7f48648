//! An embedded pair under the control of its steps.

use core::mem::{replace, swap};

use super::controller::{Controller, FIRST_SHARE};
use super::{
    Adaptive, Counted, Counts, Course, EmbeddedPair, Ends, Span, Start, Stride, System, named,
};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// An integration with an [`Adaptive`] method under way.
pub struct AdaptiveCourse<S: Real, X: Vector<S>, K: EmbeddedPair<S>> {
    pair: K,
    controller: Controller<S>,
    end: S,
    /// The size of the next step.
    next_step: S,
    counts: Counts,
    time: S,
    state: X,
    /// The slope at `state`, if `replaced` does not say otherwise.
    last: X,
    replaced: bool,
    /// The last accepted step: its start, its size, the slopes within.
    start: S,
    step: S,
    from: X,
    first: X,
    stages: K::Stages<X>,
    /// Whether the interpolant has what it needs besides these.
    prepared: bool,
}

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> Clone for AdaptiveCourse<S, X, K> {
    fn clone(&self) -> Self {
        Self {
            state: self.state.clone(),
            last: self.last.clone(),
            from: self.from.clone(),
            first: self.first.clone(),
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

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> AdaptiveCourse<S, X, K> {
    pub(super) fn start<Y: System<S, State = X>>(
        method: &Adaptive<S, K>,
        system: &mut Y,
        span: Span<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let controller = Controller::new(method.tolerance, &method.limits, K::POWER, &span)?;
        let mut counts = Counts::default();
        let last = Counted {
            system,
            counts: &mut counts,
        }
        .rates(span.start, &state)?;
        Ok(Self {
            pair: method.pair,
            controller,
            end: span.end,
            next_step: controller.first(&span, &state, &last, FIRST_SHARE),
            counts,
            time: span.start,
            replaced: false,
            start: span.start,
            step: S::zero(),
            from: state.clone(),
            first: last.clone(),
            stages: method.pair.stages(&last),
            prepared: false,
            state,
            last,
        })
    }

    /// One trial from `self.first`, to the time `end`; leaves the slope at the end in `self.last`.
    #[inline]
    fn attempt<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        step: S,
        end: S,
    ) -> Result<Trial<S, X>, Fault> {
        let mut counted = Counted {
            system,
            counts: &mut self.counts,
        };
        let start = Start {
            time: self.time,
            state: &self.state,
            slope: &self.first,
        };
        let outcome = self
            .pair
            .stride(&mut counted, start, step, &mut self.stages)
            .and_then(|state| {
                counted.stage(end, &state, &mut self.last)?;
                Ok(state)
            });
        let state = match outcome {
            Ok(state) => state,
            Err(fault) => {
                let named = self.refused(system, step, end, Some(fault));
                return Err(named.unwrap_or(fault));
            }
        };
        let stride = Stride {
            step,
            from: &self.state,
            first: &self.first,
            stages: &self.stages,
            to: &state,
            last: &self.last,
        };
        let error = self.pair.error(&stride, self.controller.floor);
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
    fn refused(
        &mut self,
        system: &mut dyn System<S, State = X>,
        step: S,
        end: S,
        fault: Option<Fault>,
    ) -> Option<Fault> {
        named(fault, system, |system| {
            let start = Start {
                time: self.time,
                state: &self.state,
                slope: &self.first,
            };
            let state = self.pair.stride(system, start, step, &mut self.stages)?;
            system.rates(end, &state)
        })
    }
}

impl<S: Real, X: Vector<S>, K: EmbeddedPair<S>> Course<S, X> for AdaptiveCourse<S, X, K> {
    fn time(&self) -> S {
        self.time
    }

    fn state(&self) -> &X {
        &self.state
    }

    fn advance<Y: System<S, State = X>>(&mut self, system: &mut Y) -> Result<(), Fault> {
        if replace(&mut self.replaced, false) {
            let mut system = Counted {
                system,
                counts: &mut self.counts,
            };
            self.first = system.rates(self.time, &self.state)?;
        } else {
            swap(&mut self.first, &mut self.last);
        }
        let smallest = self.controller.smallest(self.time);
        let interval = (self.time, self.end);
        let (mut size, mut stretched) = self.controller.opening(interval, self.next_step);
        let mut failed_before = false;
        loop {
            let end = if stretched {
                self.end
            } else {
                self.time + size
            };
            let outcome = self.attempt(system, size, end);
            if let Ok(Trial::Accepted { mut state, error }) = outcome {
                system.settle(&mut state, Some(&mut self.last));
                self.counts.accepted += 1;
                self.prepared = false;
                self.start = self.time;
                self.step = end - self.time;
                self.time = end;
                self.from = replace(&mut self.state, state);
                self.next_step = if failed_before {
                    size
                } else {
                    self.controller.grown(size, error)
                };
                return Ok(());
            }
            self.counts.rejected += 1;
            stretched = false;
            if size <= smallest {
                return Err(match outcome {
                    Err(fault) => fault,
                    Ok(_) => self.controller.underflow(size, self.time),
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

    fn at<Y: System<S, State = X>>(&mut self, system: &mut Y, time: S) -> Result<X, Fault> {
        if !self.prepared {
            let mut counted = Counted {
                system,
                counts: &mut self.counts,
            };
            let ends = Ends {
                step: self.step,
                from: &self.from,
                first: &self.first,
                last: &self.last,
            };
            self.pair
                .prepare(&mut counted, self.start, ends, &mut self.stages)?;
            self.prepared = true;
        }
        let theta = (time - self.start).quotient(self.step);
        let stride = Stride {
            step: self.step,
            from: &self.from,
            first: &self.first,
            stages: &self.stages,
            to: &self.state,
            last: &self.last,
        };
        Ok(self.pair.interpolate(stride, theta))
    }

    fn replace(&mut self, state: X) {
        self.state = state;
        self.replaced = true;
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
