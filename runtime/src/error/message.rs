//! What faults say. `Debug` says the same, because that is what a `main` that returns an error
//! prints.

use core::fmt;

use crate::error::interactions;
use crate::error::readable::{Given, Measured};
use crate::error::switches;
use crate::error::{AngleSet, Fault, LeavesOut, NotFinite, Quantity};

const NOT_VERIFIED: &str = "a run with handlers, controllers, checkpoints or a trajectory has no companion that `verified()` could compare it with, for closures cannot be called twice; \
     compare with a second run of another tolerance or step";

const NOT_LED: &str = "a run that is led by `begin()` is not verified, keeps no checkpoints and records no trajectory; `run(..)` does so, with an observer";

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::SpectralRadius { value } => write!(
                f,
                "the spectral radius of the generalized-alpha method is from 0 to 1, not {}",
                Given(value)
            ),
            Self::StateNotFinite => write!(f, "the state holds a number that is not finite"),
            Self::ZeroOrientation { body } => {
                write!(f, "the Euler parameters of body `{body}` have no length")
            }
            Self::WithoutInertia { body } => write!(
                f,
                "the mass or inertia of `{body}`, as given, is not positive: the mechanism moves by its joints, and bodies have no equations \
                 for accelerations, reactions and impulses of events"
            ),
            Self::StateLeftOut { state, by } => {
                let why = match by {
                    LeavesOut::StepMethod => {
                        "the generalized-alpha method moves bodies alone; take another method"
                    }
                    LeavesOut::Kinematics => {
                        "a kinematic analysis integrates nothing; take a simulation"
                    }
                    LeavesOut::Linearisation => {
                        "linearisations and equilibria know the chosen coordinates alone"
                    }
                };
                write!(
                    f,
                    "the state `{state}` of the mechanism has a rate of its own: {why}"
                )
            }
            Self::RatesNotFinite { origin } => {
                write!(f, "the rates of the state are not finite")?;
                match origin {
                    NotFinite::Unknown => Ok(()),
                    NotFinite::Force(name) => write!(
                        f,
                        ": force `{name}` is not finite (a length of zero, or numbers beyond all bounds)"
                    ),
                    NotFinite::Closure(body) => {
                        write!(f, ": the closure's forces on body `{body}` are not finite")
                    }
                    NotFinite::Joint(name) => write!(
                        f,
                        ": the equations of joint `{name}` are not finite (a length of zero, or a law or velocities beyond all bounds)"
                    ),
                    NotFinite::Body(name) => {
                        write!(f, ": the acceleration of body `{name}` is not finite")
                    }
                    NotFinite::Rate(name) => {
                        write!(f, ": the rate of state `{name}` is not finite")
                    }
                }
            }
            Self::Singular {
                name,
                relative_pivot,
                ..
            } => write!(
                f,
                "the constraints depend on each other at joint `{name}` (relative pivot {})",
                Measured(relative_pivot)
            ),
            Self::NotConverged {
                iterations,
                residual,
                joint,
                alpha,
            } => {
                let plural = if iterations == 1 { "" } else { "s" };
                write!(f, "no convergence after {iterations} iteration{plural}")?;
                if let Some(alpha) = alpha {
                    write!(
                        f,
                        " of the augmented Lagrangian with `alpha = {}`",
                        Given(alpha)
                    )?;
                }
                if let Some(joint) = joint {
                    write!(f, ": joint `{joint}` is violated most")?;
                }
                write!(f, " (residual {})", Measured(residual))?;
                if alpha.is_some() {
                    write!(
                        f,
                        "; a larger `alpha` for these masses needs fewer iterations"
                    )?;
                }
                Ok(())
            }
            Self::StepSizeUnderflow {
                step,
                is_least,
                joint,
                resolution,
            } => {
                let step = Measured(step);
                if is_least {
                    write!(
                        f,
                        "the error of a step of {step} s, the least that may be taken, is beyond the tolerance; "
                    )?;
                } else {
                    write!(
                        f,
                        "the step size {step} s is below the resolution of the time; "
                    )?;
                }
                match (joint, resolution) {
                    (Some(joint), _) => write!(
                        f,
                        "the constraints all but depend on each other at joint `{joint}`: a singular configuration, or constraints that cannot be met beyond it"
                    ),
                    (None, Some(resolution)) => write!(
                        f,
                        "positions of this size are known to {} m, which is coarser than the absolute tolerance: give a larger one, a number type of \
                         more digits, or an origin that is nearer; if that does not help, the cause is a singular configuration, constraints that cannot be \
                         met, or forces that jump",
                        Measured(resolution)
                    ),
                    (None, None) => write!(
                        f,
                        "constraints that cannot be met, a singular configuration, and forces that jump or grow without bound are the usual causes"
                    ),
                }
            }
            Self::StepTooLong { step, rate } => write!(
                f,
                "the numbers grew without bound: a step of {} s is too long for violations that decay at {} 1/s, explicit steps must stay below \
                 about {} s",
                Given(step),
                Given(rate),
                Measured(2.0 / rate)
            ),
            Self::TwoAnswers { body, time } => write!(
                f,
                "the closure's forces on body `{body}` differ between two calls with the same time, {} s, and the same state: it is called at trial states, \
                 for times that go back and forth, and may depend on time and state alone; a controller with memory is called once a period, \
                 by `every_period` of the simulation, and its output held as an input",
                Given(time)
            ),
            Self::EventNotANumber { event, time } => write!(
                f,
                "the reading of event `{event}` is not a number at {} s",
                Given(time)
            ),
            Self::Chattering {
                event,
                events,
                time,
            } => write!(
                f,
                "event `{event}` fires {events} times within a moment at {} s: its handler leads back to where it fires; let it bring the mechanism to \
                 rest, take a smoothed law, or stop the run",
                Given(time)
            ),
            Self::Checkpoint(fault) => fault.fmt(f),
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
            Self::InteractionSetting { .. }
            | Self::MisplacedSetting { .. }
            | Self::NoSuchInteraction { .. }
            | Self::NoSuchLimits { .. }
            | Self::BeyondLimit { .. }
            | Self::DrivenAgainst { .. }
            | Self::LimitsLeftOut { .. }
            | Self::NoMode { .. }
            | Self::NoUniqueFriction { .. }
            | Self::LoadNotUnique { .. }
            | Self::EndlessModes { .. }
            | Self::NoInteractions => interactions::say(self, f),
            Self::NotVerified => f.write_str(NOT_VERIFIED),
            Self::NotLed => f.write_str(NOT_LED),
            Self::SlidingLaw { .. }
            | Self::OnSwitch { .. }
            | Self::SwitchUndecided { .. }
            | Self::SwitchLeftOut { .. } => switches::say(self, f),
            Self::Unstable { step } => write!(
                f,
                "the numbers grew without bound: a step of {} s is too long for the spin, the springs or the dampers here, unless a force grows \
                 by itself; take a shorter step, or a method for stiff systems such as `RadauIIA`",
                Given(step)
            ),
            Self::NoFixedPoint { step, iterations } => write!(
                f,
                "the equation of a step of {} s was not solved in {iterations} iterations: the step is too long for an iteration by fixed points, \
                 which converges up to about one over the largest rate of the motion and of its stabilisation",
                Given(step)
            ),
            Self::StepNotSolved {
                step,
                iterations,
                joint,
            } => {
                write!(
                    f,
                    "a step of {} s was not solved in {iterations} iterations: ",
                    Given(step)
                )?;
                match joint {
                    Some(joint) => write!(
                        f,
                        "the constraints of joint `{joint}` nearly depend on others here"
                    ),
                    None => write!(
                        f,
                        "it is too long for the motion, or for springs and dampers that are stiff; take a shorter one"
                    ),
                }
            }
            Self::PenaltyFactor { alpha, largest } => write!(
                f,
                "`alpha = {}` is lost in round-off for these masses, and equations that depend on others have nothing else to go by: give \
                 {} at most",
                Given(alpha),
                Measured(largest)
            ),
            Self::Budget {
                evaluations,
                joint: Some(joint),
            } => write!(
                f,
                "{evaluations} evaluations are used up where the constraints all but depend on each other at joint `{joint}`: a singular configuration, \
                 or constraints that cannot be met beyond it"
            ),
            Self::Budget {
                evaluations,
                joint: None,
            } => write!(
                f,
                "{evaluations} evaluations are used up: a singular configuration or a stiff formulation are the usual causes; \
                 `DormandPrince::budget` allows more"
            ),
            Self::StartOpens {
                joint,
                direction,
                violation,
            } => write!(
                f,
                "along direction {direction} joint `{joint}` opens at the start, at {}: the derivatives of the state are not those of states that satisfy the constraints; \
                 `IndependentCoordinates::sensitivities` finds them",
                Measured(violation)
            ),
            Self::InconsistentStart {
                joint,
                quantity,
                violation,
                is_final,
            } => {
                opens(f, (joint, quantity, violation))?;
                f.write_str(if is_final {
                    " at the start, and joint coordinates describe no such state: `.assembled()` or `assemble` corrects it"
                } else {
                    " at the start: `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
                })
            }
            Self::HandlerOpens {
                event,
                joint,
                quantity,
                violation,
            } => {
                write!(f, "after the handler of `{event}` ")?;
                opens(f, (joint, quantity, violation))?;
                f.write_str(match quantity {
                    Quantity::Length | Quantity::Angle => {
                        ": set all joints of a loop, or put the state onto the constraints by `assemble`"
                    }
                    Quantity::Speed | Quantity::AngularVelocity => {
                        ": `event.impact` gives a blow that the whole loop takes; what sets a rate sets that of one joint"
                    }
                })
            }
            Self::StepTooShort { step, time } => write!(
                f,
                "a step of {} s is below the resolution of the time {} s",
                Given(step),
                Given(time)
            ),
            Self::NotDriven { degrees_of_freedom } => {
                let (velocities, each) = match degrees_of_freedom {
                    1 => ("velocity", "it"),
                    _ => ("velocities", "each"),
                };
                write!(
                    f,
                    "the mechanism has {degrees_of_freedom} more {velocities} than equations; a kinematic analysis needs a driver for {each}"
                )
            }
            Self::Undetermined { share } => write!(
                f,
                "the equations leave a motion free here ({} of a trial motion): they depend on each other, or a driver is missing",
                Measured(share)
            ),
            Self::WrongSide { joint } => write!(
                f,
                "joint `{joint}` is upside down: its equations hold, or nearly, on a side that its definition excludes; set its bodies on the right side, \
                 or describe its axes so that they point the same way"
            ),
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
            Self::Jump { body, size, joint } => {
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
                    None => write!(f, "a law that jumps is the usual cause"),
                }
            }
            Self::Setting { name, value } => {
                write!(
                    f,
                    "`{name}` must be finite and positive, not {}",
                    Given(value)
                )
            }
            Self::BreakNotFinite { instant } => {
                write!(
                    f,
                    "an instant of `breaks` is {}: it must be finite",
                    Given(instant)
                )
            }
            Self::Interval { start, end } => {
                let (from, to) = (Given(start), Given(end));
                write!(f, "the interval from {from} s to {to} s ")?;
                if !start.is_finite() {
                    write!(f, "must begin at a finite time")
                } else if !end.is_finite() {
                    write!(f, "must end at a finite time")
                } else if end < start {
                    write!(f, "must not end before it begins")
                } else {
                    write!(f, "must have a length")
                }
            }
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
            Self::CarriesNothing { joint, instead } => {
                write!(f, "joint `{joint}` carries no body in the spanning tree")?;
                if let Some(instead) = instead {
                    write!(
                        f,
                        ": set `{instead}`, which carries one of its bodies, and let `assemble` close `{joint}`"
                    )?;
                }
                Ok(())
            }
            Self::NotFree { joint } => write!(
                f,
                "what is to be set of joint `{joint}` is no motion that its equations leave free"
            ),
            Self::NotAssembled {
                joint,
                quantity,
                violation,
            } => {
                let (violation, unit) = (Measured(violation), quantity.unit());
                match quantity {
                    Quantity::Length | Quantity::Angle => write!(
                        f,
                        "joint `{joint}` is open by {violation} {unit}: the state does not satisfy the constraints, `state_near` finds one that does"
                    ),
                    Quantity::Speed | Quantity::AngularVelocity => write!(
                        f,
                        "the bodies of joint `{joint}` move against it at {violation} {unit}: the state does not satisfy the constraints, `with_rates` finds one that does"
                    ),
                }
            }
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
            Self::Analysis(fault) => fault.fmt(f),
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

/// A joint that is open, or whose bodies move against it.
fn opens(
    f: &mut fmt::Formatter<'_>,
    (joint, quantity, violation): (&str, Quantity, f64),
) -> fmt::Result {
    let (violation, unit) = (Measured(violation), quantity.unit());
    match quantity {
        Quantity::Length | Quantity::Angle => {
            write!(f, "joint `{joint}` is open by {violation} {unit}")
        }
        Quantity::Speed | Quantity::AngularVelocity => write!(
            f,
            "the bodies of joint `{joint}` move against it at {violation} {unit}"
        ),
    }
}

impl fmt::Debug for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
