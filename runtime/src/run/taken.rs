//! A step of a run: taken, its turns counted, and looked into for events and for the monitor.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;
use crate::run::leg::Taken;
use crate::run::within::{Looks, look_within};

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Takes a step, and looks into it for events and for the monitor, with so many seconds left to
    /// the end of the integration. False of one that must be shorter.
    #[inline(always)]
    pub(crate) fn take(
        &mut self,
        last_good: &mut StateAt<S, M>,
        left: S,
        taken: &mut Taken<S, M>,
    ) -> Result<bool, Fault> {
        let fixed_step = self.course.settings.fixed_step;
        let longest = fixed_step.map_or(left, |step| step.min(left));
        let advanced = match self.advance() {
            Ok(advanced) => advanced,
            Err(fault) => {
                let is_shortened = self.tries_again(last_good.borrowed(), longest)
                    || self.halves(&fault, last_good.time, longest);
                return if is_shortened { Ok(false) } else { Err(fault) };
            }
        };
        taken.end = advanced.end;
        if !self.is_taken(last_good.borrowed(), taken.end)? {
            return Ok(false);
        }
        if !advanced.knows_turns {
            self.convert(last_good);
            self.march.recount(last_good.borrowed())?;
        }
        if self.course.settings.may_branch && self.stabilisation.is_none() {
            self.march.look_for_branches();
        }
        let &mut At {
            time: start,
            bodies: ref near,
        } = last_good;
        (taken.event, taken.better, taken.looks) = (None, None, Looks::NONE);
        if self.looks_for_events() {
            if let Err(fault) = self.ends_within_modes(taken.end, near) {
                let is_halved = self.halves(&fault, start, longest);
                return if is_halved { Ok(false) } else { Err(fault) };
            }
            taken.event = self.event_within((start, near), taken.end)?;
        }
        if let Some(monitor) = &mut self.course.monitor {
            if taken.event.is_none() && monitor.judges() {
                taken.better = self.march.better_end(near);
            }
            taken.looks = look_within(monitor, self.march, near, taken.end, taken.event.as_ref());
        }
        Ok(true)
    }
}
