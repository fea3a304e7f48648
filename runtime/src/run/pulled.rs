//! A driver that is asked for one thing after the other: by a companion, and by a user's own loop.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::monitor::Seen;
use crate::run::driver::Driver;
use crate::run::handled::Handled;
use crate::run::leg::Leg;

/// Where a driver is that is asked.
pub(crate) struct Way<S: Real, M: Mechanism> {
    pub(crate) at: StateAt<S, M>,
    pub(crate) leg: Leg<S, M>,
    /// Whether the last step is still to be accepted: it lies beyond what was asked for, or has
    /// just been taken.
    pub(crate) is_open: bool,
    /// When (s) it began.
    began: S,
    /// What the equations had seen before somebody looked into it.
    pub(crate) seen: Option<Seen<S>>,
}

/// What a driver has come to.
#[derive(Clone, Copy)]
pub(crate) enum Pulled {
    /// The end of a step, which is accepted.
    Step,
    /// The time that was asked for.
    Time,
    /// The end of an integration, and what was done there.
    Instant(Handled),
}

impl<S: Real, M: Mechanism> Way<S, M> {
    /// Before a first step.
    pub(crate) fn from(at: StateAt<S, M>) -> Self {
        Self {
            leg: Leg::at(at.time),
            began: at.time,
            at,
            is_open: false,
            seen: None,
        }
    }

    /// When (s) a last step ends.
    pub(crate) fn reached(&self) -> S {
        if self.is_open {
            self.leg.taken.reached()
        } else {
            self.at.time
        }
    }
}

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Goes on to the end of a step, or to a time (s) within it, which is not before any that was
    /// asked for. How long (s) after the beginning of an integration it is asked for output tells
    /// methods how to begin.
    pub(crate) fn pull(
        &mut self,
        way: &mut Way<S, M>,
        time: S,
        first_output: &dyn Fn(S) -> S,
    ) -> Result<Pulled, Fault> {
        while !way.is_open {
            if way.at.time >= time {
                return Ok(Pulled::Time);
            }
            if let Some(pulled) = self.take_next(way, first_output)? {
                return Ok(pulled);
            }
        }
        if way.leg.taken.reached() > time {
            let seen = self.march.equations().seen();
            way.seen.get_or_insert(seen);
            let bodies = self.march.within((way.at.time, &way.at.bodies), time)?;
            let bodies = self.stabilised_if(time, bodies)?;
            way.at = At { time, bodies };
            return Ok(Pulled::Time);
        }
        self.accept_last(way)
    }

    /// Takes a step, or goes across a length of zero: what was done behind it. Of a step that must
    /// be shorter there is nothing to say, and it is tried again.
    fn take_next(
        &mut self,
        way: &mut Way<S, M>,
        first_output: &dyn Fn(S) -> S,
    ) -> Result<Option<Pulled>, Fault> {
        if way.leg.under_way.is_none() {
            let first = first_output(way.leg.from);
            if !self.open(&mut way.leg, first, &mut way.at, None)? {
                return self.close_and_handle(way);
            }
        }
        let Some(begun) = way.leg.under_way else {
            return Ok(None);
        };
        let left = way.leg.until - way.at.time;
        way.began = way.at.time;
        way.is_open = self.take(&mut way.at, left, &mut way.leg.taken)?;
        if !way.is_open {
            return self.close_and_handle(way);
        }
        self.keep_to_budget(&begun, 1)?;
        Ok(None)
    }

    /// Accepts what the last step has reached.
    fn accept_last(&mut self, way: &mut Way<S, M>) -> Result<Pulled, Fault> {
        way.is_open = false;
        let seen = way.seen.take();
        // What looks into the step evaluate is not what the monitor is shown, which is its end.
        if let Some(seen) = seen {
            self.march.equations_mut().recall(seen);
        }
        let Leg {
            under_way: Some(begun),
            taken,
            ..
        } = &mut way.leg
        else {
            return Ok(Pulled::Step);
        };
        self.count_looks(taken, begun, seen.is_some());
        self.commit(taken, begun, &mut way.at)?;
        if way.leg.taken.event.is_some() || way.leg.is_done() {
            let pulled = self.close_and_handle(way)?;
            return Ok(pulled.unwrap_or(Pulled::Step));
        }
        self.convert(&mut way.at);
        Ok(Pulled::Step)
    }

    /// Leaves the rest of a step within which somebody has looked, and the integration with it.
    pub(crate) fn leave_step(&mut self, way: &mut Way<S, M>) -> Result<(), Fault> {
        let was_open = core::mem::take(&mut way.is_open);
        if let Some(seen) = way.seen.take() {
            self.march.equations_mut().recall(seen);
        }
        if let (true, Some(begun)) = (was_open, &mut way.leg.under_way) {
            self.count_looks(&way.leg.taken, begun, true);
            // The step ends here, as it does at an event.
            let mut before = At {
                time: way.began,
                bodies: way.at.bodies,
            };
            self.observe_event(way.at, begun, &mut before)?;
            way.at = before;
        }
        if way.leg.under_way.is_some() {
            self.course.passing.forget_plan();
            self.close(&mut way.leg, &mut way.at);
        }
        if was_open {
            self.forget_found(&way.at)?;
        }
        Ok(())
    }

    /// Ends the integration under way, and does what is to be done there; nothing behind a step
    /// that must be shorter.
    fn close_and_handle(&mut self, way: &mut Way<S, M>) -> Result<Option<Pulled>, Fault> {
        if !self.close(&mut way.leg, &mut way.at) {
            return Ok(None);
        }
        self.handle(&mut way.at)
            .map(|handled| Some(Pulled::Instant(handled)))
    }
}
