//! Why a configuration cannot be set, or is none of the mechanism.

use core::fmt;

use crate::error::readable::{Given, Measured};

/// Why a joint cannot be set as it was asked for, or why a configuration is none of the mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AssemblyFault {
    /// An angle, a displacement or an orientation was to be set of a joint that carries no body in
    /// the spanning tree, see [`Report::carriers`](crate::Report::carriers).
    CarriesNothing {
        /// The joint's field.
        joint: &'static str,
        /// The joint that carries the last of its bodies that one carries.
        instead: Option<&'static str>,
    },
    /// What was to be set of a joint is no motion that its equations leave free.
    NotFree {
        /// The joint's field.
        joint: &'static str,
    },
    /// Angles that count turns were set, and their number is not that of the joint or force.
    CountedAngles {
        /// The field of the joint or force.
        element: &'static str,
        /// How many angles it counts turns of.
        counted: usize,
        /// How many were given.
        given: usize,
    },
    /// Assembly found no way from the reference configuration, or from the state it was to start
    /// from, to what was set, along one branch.
    WayEnds {
        /// The joint whose pivot has nearly vanished where it ends, or that cannot be brought to
        /// where it was set; `None` where none of these is known.
        joint: Option<&'static str>,
        /// The share of the way that was gone.
        share: f64,
    },
    /// A joint is on a side that is not meant: its equations hold, but the other way round
    /// (`require .. > 0` in its definition).
    WrongSide {
        /// The joint's field.
        joint: &'static str,
    },
    /// An angle or a displacement was put beyond its limit.
    BeyondLimit {
        /// The field of the joint or the point.
        joint: &'static str,
        /// The value (rad, m).
        value: f64,
        /// The limit (rad, m).
        limit: f64,
    },
}

impl fmt::Display for AssemblyFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::CarriesNothing { joint, instead } => {
                write!(f, "joint `{joint}` carries no body in the spanning tree")?;
                match instead {
                    Some(instead) => write!(
                        f,
                        ": set `{instead}`, which carries one of its bodies, and let `assemble` close `{joint}`"
                    ),
                    None => Ok(()),
                }
            }
            Self::NotFree { joint } => write!(
                f,
                "what is to be set of joint `{joint}` is no motion that its equations leave free"
            ),
            Self::CountedAngles {
                element,
                counted,
                given,
            } => {
                match counted {
                    0 => write!(f, "`{element}` counts turns of no angle"),
                    1 => write!(f, "`{element}` counts turns of one angle"),
                    _ => write!(f, "`{element}` counts turns of {counted} angles"),
                }?;
                write!(f, ", not of {given}")
            }
            Self::WayEnds { joint, share } => {
                write!(
                    f,
                    "the branch of the start does not lead to what was set: it was followed to {} of the way",
                    Measured(share)
                )?;
                match joint {
                    Some(joint) => write!(
                        f,
                        " and ends at joint `{joint}`, in a singular configuration or at a limit of its motion"
                    ),
                    None => Ok(()),
                }
            }
            Self::WrongSide { joint } => write!(
                f,
                "joint `{joint}` is upside down: its equations hold, or nearly, on a side that its definition excludes; set its bodies on the right side, \
                 or describe its axes so that they point the same way"
            ),
            Self::BeyondLimit {
                joint,
                value,
                limit,
            } => write!(
                f,
                "`{joint}` is at {}, beyond its limit of {}: what starts, drives, sets or balances it must stay between its limits; `.without_limits()` passes those of the description",
                Given(value),
                Given(limit)
            ),
        }
    }
}

impl core::error::Error for AssemblyFault {}
