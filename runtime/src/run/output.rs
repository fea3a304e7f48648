//! When a run reports, and what its observer may return.

use core::convert::Infallible;
use core::ops::ControlFlow;

use crate::error::setting::interval;
use crate::error::setting::positive;
use crate::error::{Fault, RunError, SimulationError, StartFault, StepFault};
use crate::math::scalar::Real;

/// When a run shows its state to the observer; the start and the end are always among the times.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

/// What an observer of a run returns: nothing, `ControlFlow<()>`, whose `Break(())` stops the run,
/// or a `Result` of either, whose error stops the run and is handed on as
/// [`RunError::Observer`].
///
/// The error of a run follows from it: an observer that cannot fail leaves [`SimulationError`].
#[diagnostic::on_unimplemented(
    message = "an observer does not return `{Self}`",
    label = "nothing, `ControlFlow<()>`, or a `Result` of either",
    note = "end the closure with `;`, with `ControlFlow::Continue(())` and `ControlFlow::Break(())`, or with `Ok::<(), Error>(())`"
)]
pub trait IntoFlow {
    /// The error of the observer; [`Infallible`] where it has none.
    type Failure;

    /// The error of a run with states `X`.
    type Error<X>: From<SimulationError<X>>;

    /// Whether the run goes on.
    ///
    /// # Errors
    /// What the observer could not do.
    fn into_flow(self) -> Result<ControlFlow<()>, Self::Failure>;

    /// The error of a run that the observer ended by its own.
    fn failed<X>(failure: Self::Failure) -> Self::Error<X>;
}

impl IntoFlow for () {
    type Failure = Infallible;
    type Error<X> = SimulationError<X>;

    fn into_flow(self) -> Result<ControlFlow<()>, Infallible> {
        Ok(ControlFlow::Continue(()))
    }

    fn failed<X>(failure: Infallible) -> SimulationError<X> {
        match failure {}
    }
}

impl IntoFlow for ControlFlow<()> {
    type Failure = Infallible;
    type Error<X> = SimulationError<X>;

    fn into_flow(self) -> Result<Self, Infallible> {
        Ok(self)
    }

    fn failed<X>(failure: Infallible) -> SimulationError<X> {
        match failure {}
    }
}

impl<E> IntoFlow for Result<(), E> {
    type Failure = E;
    type Error<X> = RunError<X, E>;

    fn into_flow(self) -> Result<ControlFlow<()>, E> {
        self.map(ControlFlow::Continue)
    }

    fn failed<X>(failure: E) -> RunError<X, E> {
        RunError::Observer(failure)
    }
}

impl<E> IntoFlow for Result<ControlFlow<()>, E> {
    type Failure = E;
    type Error<X> = RunError<X, E>;

    fn into_flow(self) -> Self {
        self
    }

    fn failed<X>(failure: E) -> RunError<X, E> {
        RunError::Observer(failure)
    }
}

/// What a run gives: its report, what its observer could not do, or why it could not go on from
/// its last good time (s) and state. An observer's error stopped the run before anything else.
pub(crate) fn outcome<R: IntoFlow, T, S: Real, X>(
    report: Result<T, Fault>,
    failure: Option<R::Failure>,
    (time, state): (S, X),
) -> Result<T, R::Error<X>> {
    if let Some(failure) = failure {
        return Err(R::failed(failure));
    }
    report.map_err(|fault| {
        let time = time.to_f64();
        R::Error::from(SimulationError { time, fault, state })
    })
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
    pub(crate) fn interval(self) -> Option<S> {
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
                return Err(Fault::Step(StepFault::TooShort {
                    step: dt.to_f64(),
                    time: latest.to_f64(),
                }));
            }
        }
        Ok(Self {
            start,
            end,
            reporting,
            done: 0,
        })
    }

    /// The interval, the reporting, and how many reporting times are done.
    #[cfg(feature = "std")]
    pub(crate) fn parts(&self) -> ((S, S), Reporting<S>, usize) {
        ((self.start, self.end), self.reporting, self.done)
    }

    /// Goes on after so many reporting times.
    pub(crate) fn after(mut self, done: usize) -> Self {
        self.done = done;
        self
    }

    /// The time from a time to the next report.
    pub(crate) fn first(&self, from: S) -> S {
        match self.next() {
            Some(next) if next - from > round_off(next) => next - from,
            _ => self.reporting.interval().unwrap_or(self.end - from),
        }
    }

    /// The same where it is not known how many reports are done.
    pub(crate) fn first_after(&self, from: S) -> S {
        let Some(dt) = self.reporting.interval() else {
            return self.end - from;
        };
        let done = (from - self.start + round_off(from)).quotient(dt);
        self.after(done.to_f64() as usize).first(from)
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
pub(crate) fn check_interval<S: Real>(start: S, end: S) -> Result<(), StartFault> {
    if start.is_finite() && end.is_finite() && start <= end {
        Ok(())
    } else {
        Err(interval(start, end))
    }
}
