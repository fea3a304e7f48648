//! When a run reports, and what its observer may return.

use core::ops::ControlFlow;

use crate::error::Fault;
use crate::error::setting::interval;
use crate::error::setting::positive;
use crate::math::scalar::Real;

/// When a run shows its state to the observer; the start and the end are always among the times.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reporting<S> {
    /// At `t0 + k dt` (s) and at the end.
    Every(S),
    /// At the end of every step.
    EveryStep,
    /// At `t0 + k dt` (s), at the end, and after so many steps without a report.
    EveryOrSteps {
        /// The interval `dt` (s).
        interval: S,
        /// How many steps.
        steps: usize,
    },
}

/// What an observer of a run returns: nothing, or `ControlFlow<()>`, whose `Break(())` stops the
/// run.
#[diagnostic::on_unimplemented(
    message = "an observer does not return `{Self}`",
    label = "nothing, or `ControlFlow<()>`",
    note = "end the closure with `;`, or with `ControlFlow::Continue(())` and `ControlFlow::Break(())`"
)]
pub trait IntoFlow {
    /// Whether the run goes on.
    fn into_flow(self) -> ControlFlow<()>;
}

impl IntoFlow for () {
    fn into_flow(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl IntoFlow for ControlFlow<()> {
    fn into_flow(self) -> Self {
        self
    }
}

impl<S> Reporting<S> {
    /// Reports after so many steps without a report, too: a word for the observer of a run whose
    /// steps have become short, which may then stop it.
    #[must_use]
    pub fn or_steps(self, steps: usize) -> Self {
        match self {
            Self::Every(interval) | Self::EveryOrSteps { interval, .. } => {
                Self::EveryOrSteps { interval, steps }
            }
            Self::EveryStep => self,
        }
    }

    /// The interval (s) between reports, where there is one.
    fn interval(self) -> Option<S> {
        match self {
            Self::Every(interval) | Self::EveryOrSteps { interval, .. } => Some(interval),
            Self::EveryStep => None,
        }
    }
}

/// Reports at `t0 + k dt` (s) and at the end.
///
/// The times do not change the steps, except that [`DormandPrince`](crate::DormandPrince) begins
/// with a step no longer than `dt`, as `ode45` does.
#[must_use]
pub const fn every<S>(dt: S) -> Reporting<S> {
    Reporting::Every(dt)
}

/// Reports at the end of every step.
#[must_use]
pub const fn every_step<S>() -> Reporting<S> {
    Reporting::EveryStep
}

/// The reporting times that are still to come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Schedule<S> {
    start: S,
    end: S,
    reporting: Reporting<S>,
    done: usize,
}

impl<S: Real> Schedule<S> {
    pub(crate) fn new(start: S, end: S, reporting: Reporting<S>) -> Result<Self, Fault> {
        if let Some(dt) = reporting.interval() {
            positive("reporting step", dt)?;
            let latest = if end.abs() > start.abs() { end } else { start };
            if dt < round_off(latest) {
                return Err(Fault::StepTooShort {
                    step: dt.to_f64(),
                    time: latest.to_f64(),
                });
            }
        }
        Ok(Self {
            start,
            end,
            reporting,
            done: 0,
        })
    }

    /// The time from a time to the next report.
    pub(crate) fn first(&self, from: S) -> S {
        match self.next() {
            Some(next) if next - from > round_off(next) => next - from,
            _ => self.reporting.interval().unwrap_or(self.end - from),
        }
    }

    /// The next time to report, if it lies before `reached`, which is the end of a step.
    pub(crate) fn within(&mut self, reached: S) -> Option<S> {
        let next = self.next()?;
        let before = reached - next > round_off(reached);
        before.then(|| self.count(next))
    }

    /// Whether `reached`, the end of a step, is a time to report, after so many steps without a
    /// report.
    pub(crate) fn at(&mut self, reached: S, unseen: usize) -> bool {
        let Some(next) = self.next() else {
            return true;
        };
        if (reached - next).abs() <= round_off(reached) {
            self.count(next);
            return true;
        }
        matches!(self.reporting, Reporting::EveryOrSteps { steps, .. } if unseen >= steps)
    }

    /// The next time to report, counted; none where times are not given.
    pub(crate) fn following(&mut self) -> Option<S> {
        let next = self.next()?;
        Some(self.count(next))
    }

    /// The next time, where times are given.
    fn next(&self) -> Option<S> {
        let dt = self.reporting.interval()?;
        let next = S::constant((self.done + 1) as f64).fused(dt, self.start);
        Some(if next + round_off(self.end) >= self.end {
            self.end
        } else {
            next
        })
    }

    fn count(&mut self, time: S) -> S {
        self.done += 1;
        time
    }
}

/// Times closer than this are the same.
fn round_off<S: Real>(time: S) -> S {
    S::constant(8.0) * time.ulp()
}

/// Refuses an interval whose ends are not finite or not in order.
pub(crate) fn check_interval<S: Real>(start: S, end: S) -> Result<(), Fault> {
    if start.is_finite() && end.is_finite() && start <= end {
        Ok(())
    } else {
        Err(interval(start, end))
    }
}
