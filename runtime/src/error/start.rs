//! Why a run, a step or an analysis cannot begin as it was asked for.

use core::fmt;

use crate::error::left_out::{LeavesOut, Unheeding};
use crate::error::quantity::{Open, Quantity};
use crate::error::readable::{Given, Measured};

/// Why a run, a step or an analysis cannot be done as it was asked for: a setting, an interval, a
/// start, or a part of the mechanism that it would leave out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StartFault {
    /// A tolerance, a step or a coefficient that is not finite and positive.
    Setting {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A spectral radius that is not from 0 to 1.
    SpectralRadius {
        /// Its value.
        value: f64,
    },
    /// The factor of a penalty is so large that its compliance is lost in round-off, while
    /// equations are kept that depend on others and have nothing else to go by.
    PenaltyFactor {
        /// The factor `alpha`.
        alpha: f64,
        /// The largest that the masses of the mechanism and the digits of the numbers allow.
        largest: f64,
    },
    /// An interval of time whose ends are not finite or not in order.
    Interval {
        /// Where it begins (s).
        start: f64,
        /// Where it ends (s).
        end: f64,
    },
    /// An instant of [`Simulation::breaks`](crate::Simulation::breaks) is not finite.
    BreakNotFinite {
        /// The instant (s).
        instant: f64,
    },
    /// Times of [`Simulation::at`](crate::Simulation::at) that are not finite, or do not increase
    /// by more than round-off.
    Times {
        /// The name of the handler.
        name: &'static str,
        /// The first such time (s).
        time: f64,
    },
    /// A setting of an [`Interaction`](crate::run::Interaction) that is not acceptable.
    InteractionSetting {
        /// The field of the joint or the point.
        joint: &'static str,
        /// Which one.
        setting: &'static str,
        /// Its value.
        value: f64,
    },
    /// A setting that this kind of [`Interaction`](crate::run::Interaction) does not have.
    MisplacedSetting {
        /// The field of the joint or the point.
        joint: &'static str,
        /// Which one.
        setting: &'static str,
    },
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha) does not move a mechanism with
    /// [`Interaction`](crate::run::Interaction)s.
    NoInteractions,
    /// The mechanism has a state of the user's own, with a rate, which was asked to be left out.
    StateLeftOut {
        /// The state's field.
        state: &'static str,
        /// Who leaves it out.
        by: LeavesOut,
    },
    /// Limits and other interactions were to be left out, without
    /// [`without_limits`](crate::Simulation::without_limits).
    LimitsLeftOut {
        /// The field of the first joint or point with one.
        joint: &'static str,
        /// What does not heed them.
        by: Unheeding,
    },
    /// Derivatives of a run were asked for, and a law switches: they jump where it does, which no
    /// run of derivatives takes into account. A gradient by the adjoint is refused where it jumps.
    SwitchLeftOut {
        /// The field of the force or state.
        law: &'static str,
    },
    /// A run with handlers, controllers, checkpoints or a trajectory was to be
    /// [`verified`](crate::Simulation::verified): what closures do cannot be done twice.
    NotVerified,
    /// A run that its caller leads ([`Simulation::begin`](crate::Simulation::begin)) was to be
    /// [`verified`](crate::Simulation::verified), to keep checkpoints or to record a trajectory.
    NotLed,
    /// A run was to begin where a joint is open, or where its bodies move against it.
    Inconsistent {
        /// The joint's field.
        joint: &'static str,
        /// What is violated.
        quantity: Quantity,
        /// By how much, in the unit of the quantity.
        violation: f64,
        /// Whether it is refused whatever was asked for, because joint coordinates describe no such
        /// state.
        is_final: bool,
    },
    /// The derivatives of a start violate those of the constraints: along a direction a parameter
    /// moves a joint, and the bodies do not go with it.
    DirectionOpens {
        /// The joint's field.
        joint: &'static str,
        /// The number of the direction.
        direction: usize,
        /// The derivative of its equation.
        violation: f64,
    },
}

/// The setting of a clutch whose two quantities are one.
pub(crate) const OF_ITSELF: &str = "ratio of a quantity to itself";

const NOT_VERIFIED: &str = "a run with handlers, controllers, checkpoints or a trajectory has no companion that `verified()` could compare it with, for closures cannot be called twice; \
     compare with a second run of another tolerance or step";

const NOT_LED: &str = "a run that is led by `begin()` is not verified, keeps no checkpoints and records no trajectory; `run(..)` does so, with an observer";

const PLACES: &str = "`restitution` and `rest_below` are of limits, `radius` of a point and a plane, of a hinge and of a screw with friction by load, `guide` \
     of slides and hinges with friction by load, `collar` of such hinges, `stiction`, `stribeck`, `released`, `engage` and `release` of friction, brakes and clutches, `one_way` of those but friction by load, `capacity_factor` of those whose capacity is finite";

const NO_INTERACTIONS: &str = "`GeneralizedAlpha` does not move a mechanism with limits or other interactions; every other method does, `RadauIIA` where the system is stiff, and `.without_limits()` leaves out the limits of the description";

impl fmt::Display for StartFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Setting { name, value } => write!(
                f,
                "`{name}` must be finite and positive, not {}",
                Given(value)
            ),
            Self::SpectralRadius { value } => write!(
                f,
                "the spectral radius of the generalized-alpha method is from 0 to 1, not {}",
                Given(value)
            ),
            Self::PenaltyFactor { alpha, largest } => write!(
                f,
                "`alpha = {}` is lost in round-off for these masses, and equations that depend on others have nothing else to go by: give \
                 {} at most",
                Given(alpha),
                Measured(largest)
            ),
            Self::Interval { start, end } => write!(
                f,
                "the interval from {} s to {} s {}",
                Given(start),
                Given(end),
                misfit(start, end)
            ),
            Self::BreakNotFinite { instant } => write!(
                f,
                "an instant of `breaks` is {}: it must be finite",
                Given(instant)
            ),
            Self::Times { name, time } => write!(
                f,
                "the times of `{name}` must be finite, and each greater than the one before; {} s is not",
                Given(time)
            ),
            Self::InteractionSetting {
                joint,
                setting,
                value,
            } => write!(
                f,
                "the {setting} of the interaction on `{joint}` is {}: {}",
                Given(value),
                rule(setting)
            ),
            Self::MisplacedSetting { joint, setting } => write!(
                f,
                "the interaction on `{joint}` has no `{setting}`: {PLACES}"
            ),
            Self::NoInteractions => f.write_str(NO_INTERACTIONS),
            Self::StateLeftOut { state, by } => write!(
                f,
                "the state `{state}` of the mechanism has a rate of its own: {}",
                why(by)
            ),
            Self::LimitsLeftOut { joint, by } => write!(
                f,
                "`{joint}` has limits or another interaction, which {} not heed: say `.without_limits()` where the motion stays between the limits",
                who(by)
            ),
            Self::SwitchLeftOut { law } => write!(
                f,
                "the law of `{law}` switches: derivatives of a run jump there, which this run would leave out; take differences of runs, or a law by `smooth_step`"
            ),
            Self::NotVerified => f.write_str(NOT_VERIFIED),
            Self::NotLed => f.write_str(NOT_LED),
            Self::Inconsistent {
                joint,
                quantity,
                violation,
                is_final,
            } => {
                let open = Open {
                    joint,
                    quantity,
                    violation,
                };
                write!(f, "{open} at the start{}", mend(is_final))
            }
            Self::DirectionOpens {
                joint,
                direction,
                violation,
            } => write!(
                f,
                "along direction {direction} joint `{joint}` opens at the start, at {}: the derivatives of the state are not those of states that satisfy the constraints; \
                 `IndependentCoordinates::sensitivities` finds them",
                Measured(violation)
            ),
        }
    }
}

impl core::error::Error for StartFault {}

/// What corrects a start.
fn mend(is_final: bool) -> &'static str {
    if is_final {
        ", and joint coordinates describe no such state: `.assembled()` or `assemble` corrects it"
    } else {
        ": `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
    }
}

/// What an interval must do and does not.
fn misfit(start: f64, end: f64) -> &'static str {
    if !start.is_finite() {
        "must begin at a finite time"
    } else if !end.is_finite() {
        "must end at a finite time"
    } else if end < start {
        "must not end before it begins"
    } else {
        "must have a length"
    }
}

/// The rule that a setting of an interaction breaks.
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
        "least distance" => "it is positive, or `f64::NEG_INFINITY` where there is none",
        "greatest distance" => "it is positive, and infinite where there is none",
        "normal" => "a normal has a length",
        "coefficient" => "a coefficient of friction by load is finite",
        "radius" => {
            "a hinge or a screw with friction by load has a positive radius, by `.radius(..)`"
        }
        "guide" | "collar" => "it is a length, positive and finite",
        "axis" | "zero direction" => {
            "it has a length, and the zero direction of a cam is not along its axis"
        }
        "profile" => "the profile of a cam is a spline without a fault, see `Spline::fault`",
        "period of a profile" => "a profile is `Spline::periodic`, and repeats itself after 2 pi",
        "least radius of curvature" => {
            "a cam is convex: `h + h''` of its profile is positive at all angles"
        }
        "ratio" => "it is finite and not zero: what holds one quantity alone is a brake",
        OF_ITSELF => "a clutch is between two quantities: what holds one alone is a brake",
        _ => "it is finite",
    }
}

fn why(by: LeavesOut) -> &'static str {
    match by {
        LeavesOut::StepMethod => {
            "the generalized-alpha method moves bodies alone; take another method"
        }
        LeavesOut::Kinematics => "a kinematic analysis integrates nothing; take a simulation",
        LeavesOut::Linearisation => {
            "linearisations and equilibria know the chosen coordinates alone"
        }
    }
}

fn who(by: Unheeding) -> &'static str {
    match by {
        Unheeding::DenseStep => "`step_dense` and `step_until` do",
        Unheeding::Ensemble => "an ensemble does",
        Unheeding::Derivatives => "runs that carry derivatives do",
    }
}
