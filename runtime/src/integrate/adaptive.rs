//! Dormand-Prince under the control of `ode45`.

use core::mem::{replace, swap};

use super::controller::Controller;
use super::{
    Checked, Counted, Counts, Course, DormandPrince, DormandPrince5, DormandPrinceStages, Scheme,
    Span, Start, Stride, System, named,
};
use crate::array::Vector;
use crate::error::Fault;
use crate::scalar::Real;

/// An integration with [`DormandPrince`](super::DormandPrince) under way.
#[derive(Clone, Debug)]
pub struct AdaptiveCourse<S, X> {
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
    stages: DormandPrinceStages<X>,
}

/// What a trial ended with.
enum Trial<S, X> {
    Accepted { state: X, error: S },
    Rejected { error: S },
}

impl<S: Real, X: Vector<S>> AdaptiveCourse<S, X> {
    pub(super) fn start<Y: System<S, State = X>>(
        method: &DormandPrince<S>,
        system: &mut Y,
        span: Span<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let controller = Controller::new(method, &span)?;
        let mut counts = Counts::default();
        let last = Counted {
            system,
            counts: &mut counts,
        }
        .rates(span.start, &state)?;
        let slope = state.relative_norm(&state, controller.floor, [(S::one(), &last)]);
        Ok(Self {
            controller,
            end: span.end,
            next_step: controller.first(&span, slope),
            counts,
            time: span.start,
            replaced: false,
            start: span.start,
            step: S::zero(),
            from: state.clone(),
            first: last.clone(),
            stages: DormandPrince5.stages(&last),
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
        let outcome = DormandPrince5
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
        let terms = self.stages.error_terms(step, &self.first, &self.last);
        let error = self
            .state
            .relative_norm(&state, self.controller.floor, terms);
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

    /// Why a trial failed, or why its end or its error is not finite; `None` where all rates are finite, and only their sums are not.
    #[cold]
    #[inline(never)]
    fn refused(
        &mut self,
        system: &mut dyn System<S, State = X>,
        step: S,
        end: S,
        fault: Option<Fault>,
    ) -> Option<Fault> {
        named(fault, || {
            let mut system = Checked { system };
            let start = Start {
                time: self.time,
                state: &self.state,
                slope: &self.first,
            };
            let state = DormandPrince5.stride(&mut system, start, step, &mut self.stages)?;
            system.rates(end, &state)
        })
    }
}

impl<S: Real, X: Vector<S>> Course<S, X> for AdaptiveCourse<S, X> {
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
        let remaining = self.end - self.time;
        let mut size = self.controller.limited(self.time, self.next_step);
        let mut stretched = S::constant(1.1) * size >= remaining;
        if stretched {
            size = remaining;
        }
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
                    Ok(_) => Fault::StepSizeUnderflow {
                        step: size.to_f64(),
                        is_least: self.controller.is_held(self.time),
                        joint: None,
                        resolution: None,
                    },
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

    fn at<Y: System<S, State = X>>(&mut self, _system: &mut Y, time: S) -> Result<X, Fault> {
        let theta = (time - self.start).quotient(self.step);
        let stride = Stride {
            step: self.step,
            from: &self.from,
            first: &self.first,
            stages: &self.stages,
            to: &self.state,
            last: &self.last,
        };
        Ok(DormandPrince5.interpolate(stride, theta))
    }

    fn replace(&mut self, state: X) {
        self.state = state;
        self.replaced = true;
    }

    fn counts(&self) -> Counts {
        self.counts
    }
}
