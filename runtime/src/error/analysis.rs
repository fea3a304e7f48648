//! Why coordinates cannot be chosen, or an analysis cannot be done.

use core::fmt;

use crate::error::quantity::{Open, Quantity};
use crate::error::readable::Measured;

/// Why coordinates cannot be chosen ([`crate::independent`]), or have no such equations,
/// equilibrium or branch of equilibria; why a [`KinematicAnalysis`](crate::KinematicAnalysis) does
/// not go on.
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
    /// A parameter or an input was given twice, where each may stand once.
    GivenTwice {
        /// Its field.
        value: &'static str,
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
    /// A state of joint coordinates does not satisfy the constraints: a loop is open, or its joints
    /// move against each other.
    NotAssembled {
        /// The joint's field.
        joint: &'static str,
        /// What is violated.
        quantity: Quantity,
        /// By how much, in the unit of the quantity.
        violation: f64,
    },
    /// A law switches in a state, and its sides differ there: it has no derivative, and where it
    /// jumps an equilibrium would be one of a range.
    OnSwitch {
        /// The field of the force or state.
        law: &'static str,
        /// The expression whose sign decides.
        expression: &'static str,
    },
    /// A joint has equations of velocities, such as rolling. They determine no positions: those of
    /// a configuration follow neither from chosen coordinates nor from the time.
    VelocityEquations {
        /// The joint's field.
        joint: &'static str,
    },
    /// A kinematic analysis of a mechanism that its equations do not determine: there are fewer
    /// than velocities.
    NotDriven {
        /// Velocities less equations.
        degrees_of_freedom: isize,
    },
    /// A kinematic analysis came to a configuration where the equations, although enough, leave a
    /// motion free.
    MotionLeftFree {
        /// The share of a trial motion's energy that stays free, from 0 to 1.
        share: f64,
    },
    /// A kinematic analysis found no pose that goes on with the motion, however short its step: a
    /// law that jumps, or a branch that ends.
    Jump {
        /// The body that the nearest pose would let jump most.
        body: &'static str,
        /// By how much (rad, or lengths of the mechanism).
        size: f64,
        /// The joint whose pivot has nearly vanished, where a singular configuration is the cause,
        /// see [`crate::mechanism::Pivot`].
        joint: Option<&'static str>,
    },
}

impl fmt::Display for AnalysisFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::ChosenCount {
                chosen,
                degrees_of_freedom,
            } => write!(
                f,
                "the mechanism has {degrees_of_freedom} degree{} of freedom: choose as many coordinates, not {chosen}",
                plural(degrees_of_freedom)
            ),
            Self::GivenTwice { value } => write!(f, "`{value}` is given twice"),
            Self::ChosenTwice { joint } => {
                write!(f, "the motion of joint `{joint}` was chosen twice")
            }
            Self::SeveralMotions { joint, motions } => several_motions(f, joint, motions),
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
            Self::NotAssembled {
                joint,
                quantity,
                violation,
            } => {
                let finds = if quantity.is_rate() {
                    "with_rates"
                } else {
                    "state_near"
                };
                let open = Open {
                    joint,
                    quantity,
                    violation,
                };
                write!(
                    f,
                    "{open}: the state does not satisfy the constraints, `{finds}` finds one that does"
                )
            }
            Self::OnSwitch { law, expression } => write!(
                f,
                "`{expression}` in the law of `{law}` is zero in this state, and the law is another one on each side: there is no derivative, and what sticks has \
                 a range of equilibria; take a state beside it (a rate that is not zero), or a law by `smooth_step`"
            ),
            Self::VelocityEquations { joint } => write!(
                f,
                "joint `{joint}` has equations of velocities, which determine no positions: neither chosen coordinates nor a kinematic analysis have them; take \
                 a run"
            ),
            Self::NotDriven { degrees_of_freedom } => not_driven(f, degrees_of_freedom),
            Self::MotionLeftFree { share } => write!(
                f,
                "the equations leave a motion free here ({} of a trial motion): they depend on each other, or a driver is missing",
                Measured(share)
            ),
            Self::Jump { body, size, joint } => jump(f, body, size, joint),
        }
    }
}

impl core::error::Error for AnalysisFault {}

fn plural(number: usize) -> &'static str {
    if number == 1 { "" } else { "s" }
}

fn several_motions(f: &mut fmt::Formatter<'_>, joint: &str, motions: usize) -> fmt::Result {
    write!(
        f,
        "`{joint}` has {motions} motion{}: choose one of them by `Motion::of({joint}, 0)`",
        plural(motions)
    )?;
    match motions {
        0 | 1 => Ok(()),
        _ => write!(f, " to `Motion::of({joint}, {})`", motions - 1),
    }
}

fn not_driven(f: &mut fmt::Formatter<'_>, degrees_of_freedom: isize) -> fmt::Result {
    let (velocities, each) = match degrees_of_freedom {
        1 => ("velocity", "it"),
        _ => ("velocities", "each"),
    };
    write!(
        f,
        "the mechanism has {degrees_of_freedom} more {velocities} than equations; a kinematic analysis needs a driver for {each}"
    )
}

fn jump(f: &mut fmt::Formatter<'_>, body: &str, size: f64, joint: Option<&str>) -> fmt::Result {
    write!(
        f,
        "no pose goes on with the motion: body `{body}` would jump by {} rad, or so many lengths of the mechanism; ",
        Measured(size)
    )?;
    match joint {
        Some(joint) => write!(
            f,
            "its branch ends in a singular configuration at joint `{joint}`"
        ),
        None => f.write_str("a law that jumps is the usual cause"),
    }
}
