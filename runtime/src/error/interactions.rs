//! What faults of interactions say.

use core::fmt;

use crate::error::Fault;
use crate::error::readable::Given;

/// Says it; nothing of another fault.
pub(super) fn say(fault: &Fault, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match *fault {
        Fault::InteractionSetting {
            joint,
            setting,
            value,
        } => write!(
            f,
            "the {setting} of the interaction on `{joint}` is {}: limits are in order; a restitution is from 0 to 1, a capacity is zero or more, a stiction is not below the capacity, and rates are \
             finite; a normal has a length",
            Given(value)
        ),
        Fault::MisplacedSetting { joint, setting } => write!(
            f,
            "the interaction on `{joint}` has no `{setting}`: `restitution` and `rest_below` are of limits, `radius` of a point and a plane, `stiction`, `stribeck` \
             and `released` of friction, brakes and clutches"
        ),
        Fault::NoSuchInteraction {
            number,
            interactions,
        } => write!(
            f,
            "there is no interaction {number}: the run has {interactions}, and they count from 0"
        ),
        Fault::BeyondLimit {
            joint,
            value,
            limit,
        } => write!(
            f,
            "`{joint}` is at {}, beyond its limit of {}: start between the limits, and let no handler leave them",
            Given(value),
            Given(limit)
        ),
        Fault::NoMode { joint, time } => write!(
            f,
            "at {} s no choice of modes satisfies all interactions, that on `{joint}` among them: an engaged dog may hold what is driven, \
             or numbers are out of range",
            Given(time)
        ),
        Fault::EndlessModes {
            joint,
            changes,
            time,
        } => write!(
            f,
            "the modes of interactions changed {changes} times within a moment at {} s, last on `{joint}`: take a stiction that is nearer \
             to the capacity, a smoother curve, or a tighter tolerance",
            Given(time)
        ),
        Fault::NoInteractions => f.write_str(
            "`GeneralizedAlpha` does not move a mechanism with interactions; every other method does, `RadauIIA` where the system is stiff",
        ),
        _ => Ok(()),
    }
}
