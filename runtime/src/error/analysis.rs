//! Why coordinates cannot be chosen, or an analysis in them cannot be done.

use core::fmt;

use crate::error::readable::Measured;

/// Why coordinates cannot be chosen ([`crate::independent`]), or have no such equations,
/// equilibrium or branch of equilibria.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum AnalysisFault {
    /// More or fewer coordinates were chosen than there are degrees of freedom.
    ChosenCount {
        /// How many were chosen.
        chosen: usize,
        /// How many there are.
        degrees_of_freedom: usize,
    },
    /// A coordinate was chosen twice.
    ChosenTwice {
        /// The joint's field.
        joint: &'static str,
    },
    /// A joint was chosen as a coordinate that has several motions, or fewer than the one that was
    /// asked for.
    SeveralMotions {
        /// The joint's field.
        joint: &'static str,
        /// How many rates it has.
        motions: usize,
    },
    /// The free motion of a body was chosen that a joint carries in the spanning tree.
    Carried {
        /// The body's field.
        body: &'static str,
        /// The joint's field.
        joint: &'static str,
    },
    /// The chosen coordinates do not determine the motion here: something can move while they stand
    /// still. So near to such a configuration that the digits of a state do not tell how the others
    /// move, it is the same.
    NotDetermined {
        /// The field of a joint, or of a free body, that can move.
        joint: &'static str,
    },
    /// The chosen coordinates are not independent here: the equations that close loops restrict
    /// them.
    NotIndependent {
        /// The field of a chosen joint.
        joint: &'static str,
    },
    /// A position was asked for of a rate that belongs to no coordinate: an angular velocity of a
    /// rotation in all directions.
    NoPosition {
        /// The field of the joint, or of the free body.
        joint: &'static str,
    },
    /// An equilibrium was asked for while a coordinate moves on whose position something depends:
    /// the motion is not steady.
    NotSteady {
        /// The joint's field.
        joint: &'static str,
    },
    /// A joint was named whose motion is none of the chosen coordinates.
    NotChosen {
        /// The joint's field.
        joint: &'static str,
    },
    /// A quantity was sought on which no acceleration depends, or none that the other unknowns do
    /// not change in the same way.
    NoEffect {
        /// The field of the parameter, the input or the joint.
        unknown: &'static str,
    },
    /// Equilibria were followed to where they end, or bend too sharply.
    BranchEnds {
        /// The field of the parameter, the input or the joint.
        along: &'static str,
        /// The last value at which there is one.
        value: f64,
    },
}

impl fmt::Display for AnalysisFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ChosenCount {
                chosen,
                degrees_of_freedom,
            } => {
                let plural = if degrees_of_freedom == 1 { "" } else { "s" };
                write!(
                    f,
                    "the mechanism has {degrees_of_freedom} degree{plural} of freedom: choose as many coordinates, not {chosen}"
                )
            }
            Self::ChosenTwice { joint } => {
                write!(f, "the motion of joint `{joint}` was chosen twice")
            }
            Self::SeveralMotions { joint, motions } => {
                let plural = if motions == 1 { "" } else { "s" };
                write!(
                    f,
                    "`{joint}` has {motions} motion{plural}: choose one of them by `Motion::of({joint}, 0)`"
                )?;
                match motions {
                    0 | 1 => Ok(()),
                    _ => write!(f, " to `Motion::of({joint}, {})`", motions - 1),
                }
            }
            Self::Carried { body, joint } => write!(
                f,
                "`{body}` does not move freely: joint `{joint}` carries it in the spanning tree, and its motion can be chosen"
            ),
            Self::NotDetermined { joint } => write!(
                f,
                "the chosen coordinates do not determine the motion here: `{joint}` can move while they stand still"
            ),
            Self::NotIndependent { joint } => write!(
                f,
                "the chosen coordinates are not independent here: closed loops restrict the motion of `{joint}`"
            ),
            Self::NoPosition { joint } => write!(
                f,
                "the angular velocities of `{joint}` are rates of no coordinates: an orientation is set and read by its body"
            ),
            Self::NotSteady { joint } => write!(
                f,
                "no steady motion: `{joint}` moves, and accelerations depend on where it is"
            ),
            Self::NotChosen { joint } => {
                write!(
                    f,
                    "the motion of `{joint}` is none of the chosen coordinates"
                )
            }
            Self::NoEffect { unknown } => write!(
                f,
                "`{unknown}` balances nothing here: no acceleration depends on it at its present value, or only as on the other unknowns"
            ),
            Self::BranchEnds { along, value } => write!(
                f,
                "no equilibrium leads on from `{along} = {}`: the branch ends there, or bends more sharply than steps can follow",
                Measured(value)
            ),
        }
    }
}

impl core::error::Error for AnalysisFault {}
