//! What is done at an instant between two integrations, where nobody looks on.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;

/// What an instant was.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Handled {
    /// The first event in the list of those that were found.
    pub(crate) event: Option<&'static str>,
    /// The motion goes on in a new way.
    pub(crate) is_new: bool,
    /// A handler or a controller stops the run.
    pub(crate) stops: bool,
}

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Turns laws that have switched, calls handlers and controllers, and finds modes.
    pub(crate) fn handle(&mut self, at: &mut StateAt<S, M>) -> Result<Handled, Fault> {
        if self.course.hybrid.is_empty {
            return Ok(Handled::default());
        }
        let is_found = self.take_found(at.time)?;
        let is_turned = self.turn(at.time, &at.bodies)?;
        let done = self.act(is_found || is_turned, at)?;
        let event = self.course.hybrid.event.take().filter(|_| is_found);
        Ok(Handled {
            event,
            is_new: is_found || is_turned || done.moved || self.course.hybrid.is_switched,
            stops: done.stops,
        })
    }
}
