//! Times that a user gives, at which a handler is called.

use core::ops::ControlFlow;

use crate::error::{Fault, StartFault};
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::run::events::context::Event;
use crate::run::events::list::{Happening, Phase};
use crate::run::output::IntoFlow;
use crate::stepping::watch::is_same;

/// Times closer than so many units in the last place are refused.
const CLOSEST: f64 = 64.0;

/// A handler with its times (s), see [`Simulation::at`](crate::Simulation::at).
#[derive(Clone, Debug)]
pub struct Timed<T, K> {
    name: &'static str,
    times: T,
    /// How many of the times are over.
    over: usize,
    handler: K,
}

impl<T, K> Timed<T, K> {
    pub(super) fn new(name: &'static str, times: T, handler: K) -> Self {
        Self {
            name,
            times,
            over: 0,
            handler,
        }
    }
}

/// Whether the next time of a handler is now, or was missed by round-off.
pub(super) fn is_due<S: Real>(next: S, now: S) -> bool {
    now >= next || is_same(now, next)
}

impl<S, M, T, K, R> Happening<S, M> for Timed<T, K>
where
    S: Real,
    M: Mechanism,
    T: AsRef<[S]>,
    K: FnMut(&mut Event<'_, S, M>) -> R,
    R: IntoFlow,
    R::Failure: Into<Fault>,
{
    fn begin(&mut self, start: S) -> Result<(), Fault> {
        let times = self.times.as_ref();
        let mut before = None;
        for &time in times {
            let least = S::constant(CLOSEST) * time.abs().ulp();
            if !time.is_finite() || !before.is_none_or(|before| time - before >= least) {
                return Err(Fault::Start(StartFault::Times {
                    name: self.name,
                    time: time.to_f64(),
                }));
            }
            before = Some(time);
        }
        self.over = times.partition_point(|&time| time < start && !is_same(time, start));
        Ok(())
    }

    fn due(&mut self, time: S, phase: Phase<S>) -> Option<&'static str> {
        let (next, name) = Happening::<S, M>::next_time(self)?;
        let is_due = phase == Phase::Times && is_due(next, time);
        self.over += usize::from(is_due);
        is_due.then_some(name)
    }

    fn next_time(&self) -> Option<(S, &'static str)> {
        let next = self.times.as_ref().get(self.over)?;
        Some((*next, self.name))
    }

    fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let times = self.times.as_ref();
        memory.variant(&mut self.over, times.len() + 1);
        for &time in times {
            memory.same(time);
        }
    }

    fn act(&mut self, event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> {
        (self.handler)(event).into_flow().map_err(Into::into)
    }
}
