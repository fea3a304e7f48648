//! The warnings of a run.

use core::array::IntoIter;
use core::fmt;
use core::iter::Flatten;

use crate::error::readable::Measured;

/// A reason not to trust the result of a run as it is. `Display` says it in a sentence, with what
/// to do.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Warning {
    /// The run was not monitored.
    Unmonitored,
    /// A joint was on a side of its equations that is not meant: as after a start that was accepted
    /// as it is.
    WrongSide {
        /// The joint's field.
        joint: &'static str,
        /// When (s).
        time: f64,
    },
    /// A joint was open.
    Open {
        /// The joint's field.
        joint: &'static str,
        /// By so much (m), or so much (rad) where the first is zero.
        length: f64,
        /// See `length`.
        angle: f64,
        /// When it was widest open (s).
        time: f64,
    },
    /// The bodies of a joint moved against it.
    Slipping {
        /// The joint's field.
        joint: &'static str,
        /// So fast (m/s), or so fast (rad/s) where the first is zero.
        length: f64,
        /// See `length`.
        angle: f64,
        /// When it was fastest (s).
        time: f64,
    },
    /// A singular configuration was passed, or nearly.
    NearlySingular {
        /// The joint whose pivot all but vanished.
        joint: &'static str,
        /// The smallest relative pivot over the largest of the run.
        fall: f64,
        /// When (s).
        time: f64,
    },
    /// An equation all but vanished with its gradient.
    Vanishing {
        /// The joint whose equation it is.
        joint: &'static str,
        /// What was left of its gradient, over the largest of the run.
        length: f64,
        /// When (s).
        time: f64,
    },
    /// A kinematic analysis passed a singular configuration, or nearly: another branch of the
    /// motion begins there.
    BranchPoint {
        /// The joint whose pivot, or whose gradient, all but vanished.
        joint: &'static str,
        /// The smallest relative pivot, or square of a gradient, over the largest on the way.
        fall: f64,
        /// When (s).
        time: f64,
    },
    /// Energy came or went that no force and no driver accounts for.
    Energy {
        /// The change over the energy that the mechanism exchanges, where it was largest.
        change: f64,
        /// When (s).
        time: f64,
    },
    /// A small change of energy has shifted the phase of a long motion.
    Phase {
        /// The change of energy over the energy that the mechanism exchanges, at the end.
        change: f64,
        /// Radians of motion.
        travel: f64,
        /// The shift (rad), estimated.
        shift: f64,
    },
    /// The round-off of many steps may have shifted the phase of a long motion, whatever the
    /// balance of energy shows at its end.
    LongRun {
        /// Steps that were accepted.
        steps: usize,
        /// Radians of motion.
        travel: f64,
        /// The shift (rad), estimated as that of a random walk.
        shift: f64,
    },
    /// The errors that the control of the steps estimated add up, and there is no balance of energy
    /// to tell how far.
    ManySteps {
        /// Steps that were accepted.
        steps: usize,
        /// The sum of their errors, relative to the state.
        error: f64,
    },
    /// Forces, drivers or potentials change faster than fixed steps follow.
    CoarseSteps {
        /// How much of their work is not known.
        share: f64,
    },
    /// Steps are long for the motion, of a method of low order, whose energy does not tell.
    LongSteps {
        /// What a body may be off by at the worst (rad, or over what it has moved by where that is
        /// less): of all steps, estimated.
        shift: f64,
    },
    /// The absolute tolerance is coarse for a mechanism of this size.
    CoarseTolerance {
        /// The absolute tolerance.
        absolute: f64,
        /// The size of the mechanism (m).
        size: f64,
    },
    /// The steps, or the absolute tolerance, are coarse for a state of the user's own.
    CoarseState {
        /// The state's field.
        state: &'static str,
        /// What it may be off by, over its largest value.
        error: f64,
    },
    /// Steps are long for the angular velocity: Euler parameters leave length 1 within a step.
    Orientation {
        /// The largest `| |p| - 1 |` at the end of a step.
        drift: f64,
        /// What angles may be off by at the end (rad): of all steps, estimated.
        shift: f64,
    },
    /// The mechanism is so small, or so far from the origin, that the digits of its positions are
    /// few.
    CoarseNumbers {
        /// What they resolve (m).
        resolution: f64,
        /// The size of the mechanism (m).
        size: f64,
    },
    /// A penalty yields so much that the motion is another.
    Compliance {
        /// What it leaves of the accelerations, over them.
        bias: f64,
        /// Radians of motion over which it adds up.
        travel: f64,
    },
    /// Corrections or evaluations were accepted that did not converge.
    Unconverged {
        /// Corrections of a projection, or of a stabilisation of one's own.
        corrections: usize,
        /// Evaluations of the augmented Lagrangian.
        evaluations: usize,
        /// The time (s) of the first.
        time: f64,
    },
    /// The derivatives that a run carries have grown as the errors of an unstable motion do, or of
    /// steps that are too long for what oscillates.
    GrowingDerivatives {
        /// The number of the direction.
        direction: usize,
        /// The largest derivative of a coordinate or a velocity of a body.
        size: f64,
    },
}

impl Warning {
    /// When (s) the run met what it warns of; `None` of what is true of the whole run.
    #[must_use]
    pub const fn time(&self) -> Option<f64> {
        match *self {
            Self::WrongSide { time, .. }
            | Self::Open { time, .. }
            | Self::Slipping { time, .. }
            | Self::NearlySingular { time, .. }
            | Self::Vanishing { time, .. }
            | Self::BranchPoint { time, .. }
            | Self::Energy { time, .. }
            | Self::Unconverged { time, .. } => Some(time),
            _ => None,
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Unmonitored => write!(f, "the run was not monitored"),
            Self::WrongSide { joint, time } => write!(
                f,
                "joint `{joint}` is upside down at {} s: its equations hold on a side that its definition excludes; start with `.assembled()`, or set its \
                 bodies on the right side",
                Measured(time)
            ),
            Self::Open {
                joint,
                length,
                angle,
                time,
            } => {
                write!(f, "joint `{joint}` was open by ")?;
                amount(f, (length, "m"), (angle, "rad"))?;
                write!(
                    f,
                    " at {} s: use a projection, Baumgarte's terms, or a smaller tolerance or step",
                    Measured(time)
                )
            }
            Self::Slipping {
                joint,
                length,
                angle,
                time,
            } => {
                write!(f, "the bodies of joint `{joint}` moved against it at ")?;
                amount(f, (length, "m/s"), (angle, "rad/s"))?;
                write!(
                    f,
                    " at {} s: use a projection, Baumgarte's terms, or a smaller tolerance or step",
                    Measured(time)
                )
            }
            Self::NearlySingular { joint, fall, time } => write!(
                f,
                "passed a singular configuration, or nearly, at {} s, joint `{joint}` (its pivot fell to {} of the largest): another branch \
                 begins there, and a run goes straight on where it can; compare two tolerances",
                Measured(time),
                Measured(fall)
            ),
            Self::Vanishing {
                joint,
                length,
                time,
            } => write!(
                f,
                "an equation of joint `{joint}` all but vanished with its gradient at {} s ({} of its largest was left): which way the motion went on is not \
                 certain; use a projection and compare two tolerances, or keep the joint from there",
                Measured(time),
                Measured(length)
            ),
            Self::BranchPoint { joint, fall, time } => write!(
                f,
                "passed a branch point, or nearly, at {} s, joint `{joint}` (its pivot fell to {} of the largest): the motion went straight on; \
                 the equations allow another branch from there",
                Measured(time),
                Measured(fall)
            ),
            Self::Energy { change, time } if !change.is_finite() => write!(
                f,
                "the energy is beyond all numbers at {} s",
                Measured(time)
            ),
            Self::Energy { change, time } => write!(
                f,
                "the energy changed by {} of what the mechanism exchanges, without a force, at {} s: use a smaller tolerance or step, or a \
                 projection",
                Measured(change),
                Measured(time)
            ),
            Self::Phase {
                change,
                travel,
                shift,
            } => write!(
                f,
                "the energy changed by {} of what the mechanism exchanges, without a force: over {} rad of motion that shifts its phase by \
                 about {} rad; use a smaller tolerance or step",
                Measured(change),
                Measured(travel),
                Measured(shift)
            ),
            Self::LongRun {
                steps,
                travel,
                shift,
            } => write!(
                f,
                "the round-off of {steps} steps adds up: over {} rad of motion it may shift the phase by about {} rad, and nothing else tells; compute in \
                 `f64`, take longer steps of a method of higher order, or care for amplitudes only",
                Measured(travel),
                Measured(shift)
            ),
            Self::ManySteps { steps, error } => write!(
                f,
                "the errors that were estimated of {steps} steps may add up to {} of the state, and the balance of energy does not tell: \
                 compare with a smaller tolerance",
                Measured(error)
            ),
            Self::CoarseSteps { share } => write!(
                f,
                "forces change faster than the steps follow: {} of their work is not known; use a smaller step, or a method that controls its steps",
                Measured(share)
            ),
            Self::LongSteps { shift } => write!(
                f,
                "steps are long for the motion, which may be off by about {} rad, or so much of its way where that is less than a radian: with this method the energy does not tell; use a smaller step, \
                 or a method of higher order",
                Measured(shift)
            ),
            Self::CoarseTolerance { absolute, size } => write!(
                f,
                "the absolute tolerance {} is coarse for a mechanism of {} m: give one in proportion to its size",
                Measured(absolute),
                Measured(size)
            ),
            Self::CoarseState { state, error } => write!(
                f,
                "the state `{state}` may be off by {} of its largest value: use a smaller step, a method of higher order, or an absolute tolerance in \
                 proportion to it",
                Measured(error)
            ),
            Self::Orientation { drift, shift } => write!(
                f,
                "Euler parameters left length 1 by up to {} in a step, and angles may be off by about {} rad: steps are too long for the angular \
                 velocities",
                Measured(drift),
                Measured(shift)
            ),
            Self::CoarseNumbers { resolution, size } => write!(
                f,
                "positions are known to {} m here, which is coarse for a mechanism of {} m: put the origin near to it, or compute in `f64`",
                Measured(resolution),
                Measured(size)
            ),
            Self::Compliance { bias, travel } => write!(
                f,
                "the penalty leaves {} of the accelerations, over {} rad of motion: give a larger `alpha` for these masses, or use the \
                 augmented Lagrangian",
                Measured(bias),
                Measured(travel)
            ),
            Self::GrowingDerivatives { direction, size } => write!(
                f,
                "the derivatives along direction {direction} have grown to {}, and what the motion is off by grows as they do: compare with a smaller \
                 tolerance or step, or with a shorter run",
                Measured(size)
            ),
            Self::Unconverged {
                corrections,
                evaluations,
                time,
            } => {
                let (what, count, or) = if corrections > 0 {
                    let or = " or a stabilisation leaves more than its tolerance";
                    ("corrections after steps", corrections, or)
                } else {
                    ("evaluations of the augmented Lagrangian", evaluations, "")
                };
                write!(
                    f,
                    "{count} {what} were accepted without convergence from {} s on, where equations are nearly dependent{or}: compare two tolerances",
                    Measured(time)
                )
            }
        }
    }
}

/// The first amount, or the second where the first is zero.
fn amount(
    f: &mut fmt::Formatter<'_>,
    (length, metres): (f64, &str),
    (angle, radians): (f64, &str),
) -> fmt::Result {
    if length == 0.0 {
        write!(f, "{} {radians}", Measured(angle))
    } else {
        write!(f, "{} {metres}", Measured(length))
    }
}

/// The kinds of warning that one run may raise.
const KINDS: usize = 18;

/// The warnings of a run, the gravest first; empty where nothing is.
///
/// `Display` writes a line for each, and "no warnings" where there are none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warnings {
    warnings: [Option<Warning>; KINDS],
}

impl Warnings {
    pub(super) fn new(warnings: [Option<Warning>; KINDS]) -> Self {
        Self { warnings }
    }

    /// Of some that were found.
    pub(crate) fn of<const N: usize>(found: [Option<Warning>; N]) -> Self {
        let mut warnings = [None; KINDS];
        warnings
            .iter_mut()
            .zip(found)
            .for_each(|(place, warning)| *place = warning);
        Self { warnings }
    }

    /// Of a run that was not monitored.
    pub(crate) fn unmonitored() -> Self {
        let mut warnings = [None; KINDS];
        if let Some(first) = warnings.first_mut() {
            *first = Some(Warning::Unmonitored);
        }
        Self { warnings }
    }

    /// Whether the run can be trusted as far as the monitor can tell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.warnings.iter().all(Option::is_none)
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.warnings.iter().flatten().count()
    }
}

impl IntoIterator for Warnings {
    type Item = Warning;
    type IntoIter = Flatten<IntoIter<Option<Warning>, KINDS>>;

    fn into_iter(self) -> Self::IntoIter {
        self.warnings.into_iter().flatten()
    }
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return f.write_str("no warnings");
        }
        for (place, warning) in self.into_iter().enumerate() {
            let separator = if place > 0 { "\n" } else { "" };
            write!(f, "{separator}{warning}")?;
        }
        Ok(())
    }
}
