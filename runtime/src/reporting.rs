//! When a run reports.

use crate::error::Fault;
use crate::integrate::positive;
use crate::scalar::Real;

/// When a run shows its state to the observer; the start and the end are always among the times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reporting<S> {
    /// At `t0 + k dt` (s) and at the end.
    Every(S),
    /// At the end of every step.
    EveryStep,
}

/// Reports at `t0 + k dt` (s) and at the end.
///
/// The times do not change the steps, except that [`DormandPrince`](crate::DormandPrince) begins with a step no longer than `dt`, as
/// `ode45` does.
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
        if let Reporting::Every(dt) = reporting {
            positive("reporting step", dt)?;
        }
        Ok(Self {
            start,
            end,
            reporting,
            done: 0,
        })
    }

    /// The time from the start to the first report after it.
    pub(crate) fn first(&self) -> S {
        match self.reporting {
            Reporting::Every(dt) => dt.min(self.end - self.start),
            Reporting::EveryStep => self.end - self.start,
        }
    }

    /// The next time to report, if it lies before `reached`, which is the end of a step.
    pub(crate) fn within(&mut self, reached: S) -> Option<S> {
        let next = self.next()?;
        let before = reached - next > round_off(reached);
        before.then(|| self.count(next))
    }

    /// The time to report, if it is `reached` but for round-off.
    pub(crate) fn at(&mut self, reached: S) -> Option<S> {
        match self.next() {
            Some(next) => {
                let here = (reached - next).abs() <= round_off(reached);
                here.then(|| self.count(next))
            }
            None => Some(reached),
        }
    }

    /// The next time to report, counted; none where times are not given.
    pub(crate) fn following(&mut self) -> Option<S> {
        let next = self.next()?;
        Some(self.count(next))
    }

    /// The next time, where times are given.
    fn next(&self) -> Option<S> {
        let Reporting::Every(dt) = self.reporting else {
            return None;
        };
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
    if !start.is_finite() {
        return Err(Fault::Setting {
            name: "start of the interval",
            value: start.to_f64(),
        });
    }
    if !end.is_finite() || end < start {
        let value = (end - start).to_f64();
        return Err(Fault::Setting {
            name: "end of the interval less its start",
            value,
        });
    }
    Ok(())
}
