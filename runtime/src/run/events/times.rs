//! Times that a user gives, at which a handler is called.

use crate::error::StartFault;
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::stepping::watch::is_same;

/// Times closer than so many units in the last place are refused.
const CLOSEST: f64 = 64.0;

/// The times (s) at which a handler is called, by its name, and how many of them are over.
#[derive(Debug)]
pub struct Times<'t, S> {
    pub(super) name: &'static str,
    pub(super) times: &'t [S],
    pub(super) over: &'t mut usize,
}

impl<S: Real> Times<'_, S> {
    /// Begins a run at a time (s): what is before it is over.
    pub(super) fn begin(&mut self, start: S) -> Result<(), StartFault> {
        let mut before = None;
        for &time in self.times {
            let is_beyond = |before: S| time - before >= S::constant(CLOSEST) * resolution(time);
            if !time.is_finite() || !before.is_none_or(is_beyond) {
                return Err(StartFault::Times {
                    name: self.name,
                    time: time.to_f64(),
                });
            }
            before = Some(time);
        }
        let is_over = |&time: &S| time < start && !is_same(time, start);
        *self.over = self.times.partition_point(is_over);
        Ok(())
    }

    /// Hands over what it remembers, with its times.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        memory.variant(self.over, self.times.len() + 1);
        for &time in self.times {
            memory.same(time);
        }
    }

    /// The next time (s).
    pub(crate) fn next(&self) -> Option<S> {
        self.times.get(*self.over).copied()
    }

    /// By what name a handler is to be called at a time, if it is.
    pub(super) fn due(&self, time: S) -> Option<&'static str> {
        let next = self.next()?;
        (time >= next || is_same(time, next)).then_some(self.name)
    }

    /// The same, and counts the call.
    pub(super) fn call(&mut self, time: S) -> Option<&'static str> {
        let name = self.due(time)?;
        *self.over += 1;
        Some(name)
    }
}

/// A unit in the last place of a time (s).
fn resolution<S: Real>(time: S) -> S {
    time.abs().ulp()
}
