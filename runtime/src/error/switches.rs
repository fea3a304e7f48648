//! What faults of laws that switch say.

use core::fmt;

use crate::error::Fault;
use crate::error::readable::Given;

/// Says it; nothing of another fault.
pub(super) fn say(fault: &Fault, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match *fault {
        Fault::SlidingLaw {
            law,
            expression,
            time,
        } => write!(
            f,
            "the law of `{law}` holds `{expression}` at its zero from {} s on: on both sides the motion leads back to it, and a law has no value between; \
             dry friction is `Interaction::friction`, a stop `Interaction::limits`, and a controller takes a `smooth_step` or its period",
            Given(time)
        ),
        Fault::SwitchUndecided {
            law,
            expression,
            time,
        } => write!(
            f,
            "`{expression}` in the law of `{law}` is not a number at {} s, or changes its sign there more often than can be followed: use a smaller step, or a method that controls its steps",
            Given(time)
        ),
        Fault::OnSwitch { law, expression } => write!(
            f,
            "`{expression}` in the law of `{law}` is zero in this state, and the law is another one on each side: there is no derivative, and what sticks has \
             a range of equilibria; take a state beside it (a rate that is not zero), or a law by `smooth_step`"
        ),
        Fault::SwitchLeftOut { law } => write!(
            f,
            "the law of `{law}` switches: derivatives of a run jump there, which this run would leave out; take differences of runs, or a law by `smooth_step`"
        ),
        _ => Ok(()),
    }
}
