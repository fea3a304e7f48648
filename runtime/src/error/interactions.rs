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
             finite; a normal has a length; a coefficient of friction by load is finite, and a hinge with it has a positive radius",
            Given(value)
        ),
        Fault::MisplacedSetting { joint, setting } => write!(
            f,
            "the interaction on `{joint}` has no `{setting}`: `restitution` and `rest_below` are of limits, `radius` of a point and a plane, and of a hinge with friction by load, `guide` \
             of friction by load, `stiction`, `stribeck` and `released` of friction, brakes and clutches"
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
            "at {} s no choice of modes satisfies all interactions, that on `{joint}` among them: a stop or an engaged dog may hold what is driven, \
             or numbers are out of range",
            Given(time)
        ),
        Fault::NoUniqueFriction { joint, time } => write!(
            f,
            "at {} s the friction of `{joint}` by its load has no effort, or several (Painleve's paradox): what it adds to its own load, times its coefficient, \
             reaches 1; take a smaller coefficient, a longer guide, or a spring and a damper that bear the load",
            Given(time)
        ),
        Fault::LoadNotUnique { joint } => write!(
            f,
            "the load of `{joint}` is not determined, as friction by load asks for: its equations depend on others, or stops share what they hold; \
             take joints whose equations are independent (`guide::redundant`), or `Interaction::friction` with a known capacity"
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
