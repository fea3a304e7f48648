//! Why there is nothing to read.

use core::fmt;

use crate::error::readable::Given;

/// Why a reading has no value: what was asked for is not there, or has no value here.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReadingFault {
    /// A reaction or a load was asked for on a body that the joint or force is not about.
    NotBetween {
        /// The field of the joint or force.
        element: &'static str,
        /// The body's field.
        body: &'static str,
    },
    /// A reaction was asked for at a place that the joint's `between` does not have.
    NoSuchPlace {
        /// The joint's field.
        joint: &'static str,
        /// The place, from 0.
        place: usize,
        /// How many there are.
        places: usize,
    },
    /// The effort of a driver whose equation was left out as redundant: other joints carry it.
    NoEffort {
        /// The driver's field.
        joint: &'static str,
    },
    /// Angles of an orientation were asked for where they are singular (gimbal lock): the first and
    /// the third turn about one axis, and only their sum or difference is known.
    SingularAngles {
        /// The body's field.
        body: &'static str,
        /// Which angles.
        angles: AngleSet,
    },
    /// The centre of mass of bodies was asked for whose masses add up to zero, or of none.
    NoMass {
        /// How many bodies there are.
        bodies: u32,
    },
    /// The handle of an [`Interaction`](crate::run::Interaction) of another list: the run's own has
    /// none at this place, or another one.
    NoSuchInteraction {
        /// The place, from 0.
        number: usize,
        /// How many the run was given.
        interactions: usize,
    },
    /// The run has no limits of a joint, see
    /// [`JointQuantity::limits`](crate::run::JointQuantity::limits).
    NoSuchLimits {
        /// The field of the joint.
        joint: &'static str,
    },
    /// The point of contact of an interaction that is no contact.
    NoContact {
        /// What it is called.
        interaction: &'static str,
    },
    /// A trajectory does not know the time that it is asked for.
    OutsideTrajectory {
        /// The time (s).
        time: f64,
        /// Where it begins (s); NaN where it knows no motion.
        start: f64,
        /// Where it ends (s).
        end: f64,
    },
}

/// Three angles that describe an orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AngleSet {
    /// Euler angles, z-x-z.
    EulerZxz,
    /// Bryant angles, x-y-z.
    BryantXyz,
    /// Roll, pitch and yaw.
    RollPitchYaw,
}

impl fmt::Display for ReadingFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotBetween { element, body } => {
                write!(f, "`{body}` is not among the bodies of `{element}`")
            }
            Self::NoSuchPlace {
                joint,
                place,
                places,
            } => write!(
                f,
                "joint `{joint}` has {places} bodies, counted from 0: there is none at {place}"
            ),
            Self::NoEffort { joint } => write!(
                f,
                "the equation of driver `{joint}` was left out as redundant: other joints carry its effort"
            ),
            Self::SingularAngles { body, angles } => {
                let (names, first, last, regular) = match angles {
                    AngleSet::EulerZxz => ("Euler", "precession", "spin", "Bryant angles"),
                    AngleSet::BryantXyz => ("Bryant", "the first", "the third", "Euler angles"),
                    AngleSet::RollPitchYaw => ("roll-pitch-yaw", "roll", "yaw", "Euler angles"),
                };
                write!(
                    f,
                    "the {names} angles of body `{body}` are singular here: {first} and {last} turn about one axis, and only their sum or difference is \
                     known; {regular} are regular there"
                )
            }
            Self::NoMass { bodies: 0 } => {
                write!(f, "no body was named: there is no centre of mass")
            }
            Self::NoMass { bodies: 1 } => {
                write!(f, "the body has no mass, and so no centre of mass")
            }
            Self::NoMass { bodies } => write!(
                f,
                "the masses of the {bodies} bodies add up to zero: they have no common centre of mass"
            ),
            Self::NoSuchInteraction {
                number,
                interactions,
            } => write!(
                f,
                "the handle is of interaction {number} of another list than the run was given, which has {interactions}: they count from 0"
            ),
            Self::NoSuchLimits { joint } => write!(
                f,
                "the run has no limits of `{joint}`: neither its description nor its interactions do, or `.without_limits()` leaves them out"
            ),
            Self::NoContact { interaction } => write!(
                f,
                "interaction `{interaction}` is no contact of a shape with a surface: it has no point of contact"
            ),
            Self::OutsideTrajectory { time, start, end } => {
                let [time, from, to] = [time, start, end].map(Given);
                if start.is_nan() {
                    return write!(
                        f,
                        "the trajectory knows no motion, and so not that at {time} s; record one by `trajectory(..)` of a run"
                    );
                }
                write!(
                    f,
                    "the trajectory goes from {from} s to {to} s, and was asked for {time} s"
                )
            }
        }
    }
}

impl core::error::Error for ReadingFault {}
