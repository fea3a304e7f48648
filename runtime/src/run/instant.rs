//! What is done at an instant between two integrations, and who is shown what of it.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::run::observed::Observed;

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
    /// Shows an event that was found, turns laws that have switched, calls handlers and
    /// controllers. A given time of a handler is an event. The state is the one with which the run
    /// goes on; it is shown where anything has changed it.
    pub(super) fn happen(&mut self, last_good: &mut StateAt<S, M>) -> Result<(), Fault> {
        if self.driver.course.hybrid.is_empty {
            return Ok(());
        }
        let is_found = self.driver.take_found(last_good.time)?;
        if is_found && self.driver.course.unseen > 0 {
            self.schedule.at(last_good.time, 0);
            self.show(last_good.time, &last_good.bodies);
        }
        if self.log.flow.is_break() {
            return Ok(());
        }
        let is_turned = self.driver.turn(last_good.time, &last_good.bodies)?;
        let unseen = self.driver.course.unseen;
        if is_turned && unseen > 0 && self.schedule.at(last_good.time, unseen) {
            self.show(last_good.time, &last_good.bodies);
        }
        let done = self.driver.act(is_found || is_turned, last_good)?;
        let is_unseen = done.stops && self.driver.course.unseen > 0;
        if done.moved || self.driver.course.hybrid.is_switched || is_unseen {
            self.show(last_good.time, &last_good.bodies);
        }
        if done.stops {
            self.log.stop();
        }
        Ok(())
    }
}
