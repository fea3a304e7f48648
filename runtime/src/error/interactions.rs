//! What faults of interactions say.

use core::fmt;

use crate::error::readable::Given;
use crate::error::{Fault, Unheeding};

/// The rule that a setting breaks.
fn rule(setting: &str) -> &'static str {
    match setting {
        "lower limit" => "it comes first and is less than the upper one",
        "restitution" => "it is from 0 to 1",
        "rate of rest" => "it is finite, and zero or more",
        "capacity" => "it is zero or more",
        "stiction" => "it is not below the capacity of sliding",
        "stribeck" => {
            "it is the rate by which friction falls from `.stiction(..)`, positive and finite, and says nothing without that"
        }
        "normal" => "a normal has a length",
        "coefficient" => "a coefficient of friction by load is finite",
        "radius" => "a hinge with friction by load has a positive radius, by `.radius(..)`",
        "guide" => "it is a length, positive and finite",
        _ => "it is finite",
    }
}

/// Says it; nothing of another fault.
pub(super) fn say(fault: &Fault, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match *fault {
        Fault::InteractionSetting {
            joint,
            setting,
            value,
        } => write!(
            f,
            "the {setting} of the interaction on `{joint}` is {}: {}",
            Given(value),
            rule(setting)
        ),
        Fault::MisplacedSetting { joint, setting } => write!(
            f,
            "the interaction on `{joint}` has no `{setting}`: `restitution` and `rest_below` are of limits, `radius` of a point and a plane, and of a hinge with friction by load, `guide` \
             of friction by load, `stiction`, `stribeck`, `released`, `engage` and `release` of friction, brakes and clutches"
        ),
        Fault::NoSuchInteraction {
            number,
            interactions,
        } => write!(
            f,
            "the handle is of interaction {number} of another list than the run was given, which has {interactions}: they count from 0"
        ),
        Fault::NoSuchLimits { joint } => write!(
            f,
            "the run has no limits of `{joint}`: neither its description nor its interactions do, or `.without_limits()` leaves them out"
        ),
        Fault::BeyondLimit {
            joint,
            value,
            limit,
        } => write!(
            f,
            "`{joint}` is at {}, beyond its limit of {}: what starts, drives, sets or balances it must stay between its limits; `.without_limits()` passes those of the description",
            Given(value),
            Given(limit)
        ),
        Fault::DrivenAgainst {
            joint,
            driver,
            limit,
            time,
        } => write!(
            f,
            "at {} s driver `{driver}` moves `{joint}` on against its limit of {}: no stop holds what is prescribed; end that motion before, drive by a force, or say `.without_limits()`",
            Given(time),
            Given(limit)
        ),
        Fault::LimitsLeftOut { joint, by } => {
            let who = match by {
                Unheeding::DenseStep => "`step_dense` and `step_until` do",
                Unheeding::Ensemble => "an ensemble does",
                Unheeding::Derivatives => "runs that carry derivatives do",
            };
            write!(
                f,
                "`{joint}` has limits or another interaction, which {who} not heed: say `.without_limits()` where the motion stays between the limits"
            )
        }
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
            "`GeneralizedAlpha` does not move a mechanism with limits or other interactions; every other method does, `RadauIIA` where the system is stiff, and `.without_limits()` leaves out the limits of the description",
        ),
        _ => Ok(()),
    }
}
