//! Why an evaluation, a correction or a step does not lead on.

use core::fmt;

use crate::error::quantity::{Open, Quantity};
use crate::error::readable::{Given, Measured};

/// Why an evaluation, a correction or a step could not be done: numbers that are not finite, a
/// singular configuration, an iteration or a step control that does not lead on, an event.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepFault {
    /// The state holds NaN or infinity.
    StateNotFinite,
    /// The Euler parameters of a body in the state have the length zero: no orientation.
    ZeroOrientation {
        /// The body's field.
        body: &'static str,
    },
    /// A body is `as_given` with a mass or a moment of inertia that is not positive. So bodies have
    /// no equations of motion: accelerations and reactions are not known, nor impulses of events.
    WithoutInertia {
        /// The body's field.
        body: &'static str,
    },
    /// The rates came out as NaN or infinity: forces beyond the range of numbers, or a singular
    /// system.
    RatesNotFinite {
        /// Where that began.
        origin: NotFinite,
    },
    /// The constraints depend on each other here: at this joint the pivot vanishes.
    Singular {
        /// The index of the joint in [`crate::Report::joints`].
        joint: usize,
        /// The joint's field.
        name: &'static str,
        /// The relative pivot, see [`crate::mechanism::Pivot`].
        relative_pivot: f64,
    },
    /// The iteration of the augmented Lagrangian, or of a correction, did not converge.
    NotConverged {
        /// The iterations done.
        iterations: u32,
        /// The last change (augmented Lagrangian) or the violation left (correction).
        residual: f64,
        /// The joint whose equations are violated most, by accelerations in the augmented
        /// Lagrangian, where it is known.
        joint: Option<&'static str>,
        /// The penalty factor of the augmented Lagrangian; `None` for a correction.
        alpha: Option<f64>,
    },
    /// The closure of [`Simulation::forces`](crate::Simulation::forces) gives two answers for one
    /// time and state: it remembers something.
    TwoAnswers {
        /// The body's field on which its forces differ.
        body: &'static str,
        /// The time (s) at which it was asked twice.
        time: f64,
    },
    /// The step control found no step with an error within the tolerance, down to what the time's
    /// own digits resolve, or to [`StepLimits::least`](crate::integrate::StepLimits::least).
    SizeUnderflow {
        /// The last step that was tried (s).
        step: f64,
        /// Whether it was the least one that the run may take, and not what the time resolves.
        is_least: bool,
        /// The joint whose pivot has nearly vanished, where that is the cause, see
        /// [`crate::mechanism::Pivot`].
        joint: Option<&'static str>,
        /// What the digits of the number type resolve of the largest position (m), where that is
        /// coarser than the absolute tolerance.
        resolution: Option<f64>,
    },
    /// A step that was asked for is below what the time's own digits resolve.
    TooShort {
        /// The step (s).
        step: f64,
        /// The time (s).
        time: f64,
    },
    /// A fixed step that is too long for the rate at which the formulation makes violations decay:
    /// the motion grew beyond all numbers.
    TooLong {
        /// The step (s).
        step: f64,
        /// The rate (1/s).
        rate: f64,
    },
    /// A fixed step that is too long for what moves or acts: a spin, a spring, a damper. The motion
    /// grew beyond all numbers.
    Unstable {
        /// The step (s).
        step: f64,
    },
    /// The equation of an implicit step was not solved: the step is too long for an iteration by
    /// fixed points, see [`ImplicitMidpoint`](crate::ImplicitMidpoint).
    NoFixedPoint {
        /// The step (s).
        step: f64,
        /// The iterations done.
        iterations: u32,
    },
    /// The iteration of a step on the constraints does not converge, see
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    NotSolved {
        /// The step (s).
        step: f64,
        /// The iterations done.
        iterations: u32,
        /// The joint whose pivot has nearly vanished, where the configuration is the cause, see
        /// [`crate::mechanism::Pivot`].
        joint: Option<&'static str>,
    },
    /// A run has taken as many evaluations as it may, see
    /// [`StepLimits::evaluations`](crate::integrate::StepLimits::evaluations).
    Budget {
        /// How many it has taken.
        evaluations: usize,
        /// The joint whose pivot has nearly vanished, where the configuration is the cause, see
        /// [`crate::mechanism::Pivot`].
        joint: Option<&'static str>,
    },
    /// The reading of an event is not a number, see [`Simulation::on`](crate::Simulation::on).
    EventNotANumber {
        /// The name of the event.
        event: &'static str,
        /// The time (s).
        time: f64,
    },
    /// An event fires again and again at once, see [`Simulation::on`](crate::Simulation::on).
    Chattering {
        /// The name of the event.
        event: &'static str,
        /// How often at once.
        events: usize,
        /// The time (s).
        time: f64,
    },
    /// A handler has set a state in which a joint is open, or its bodies move against it.
    HandlerOpens {
        /// The name of the event.
        event: &'static str,
        /// The joint's field.
        joint: &'static str,
        /// What is violated.
        quantity: Quantity,
        /// By how much, in the unit of the quantity.
        violation: f64,
    },
}

/// Where rates that are not finite began.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NotFinite {
    /// The system is no mechanism, or nothing in it is to be blamed.
    Unknown,
    /// A force of the description.
    Force(&'static str),
    /// The forces that a closure exerts on a body.
    Closure(&'static str),
    /// The equations of a joint: its law, or a length in it.
    Joint(&'static str),
    /// The acceleration of a body, while forces and equations are finite.
    Body(&'static str),
    /// The rate of a state of the user's own.
    Rate(&'static str),
}

/// A number of iterations as a fault has it. By 32 bits a fault has the size of its texts.
pub(crate) fn counted(iterations: usize) -> u32 {
    u32::try_from(iterations).unwrap_or(u32::MAX)
}

impl fmt::Display for StepFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::StateNotFinite => write!(f, "the state holds a number that is not finite"),
            Self::ZeroOrientation { body } => {
                write!(f, "the Euler parameters of body `{body}` have no length")
            }
            Self::WithoutInertia { body } => without_inertia(f, body),
            Self::RatesNotFinite { origin } => not_finite(f, origin),
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
            } => not_converged(f, (iterations, residual), joint, alpha),
            Self::TwoAnswers { body, time } => write!(
                f,
                "the closure's forces on body `{body}` differ between two calls with the same time, {} s, and the same state: it is called at trial states, \
                 for times that go back and forth, and may depend on time and state alone; a controller with memory is called once a period, \
                 by `every_period` of the simulation, and its output held as an input",
                Given(time)
            ),
            Self::SizeUnderflow {
                step,
                is_least,
                joint,
                resolution,
            } => underflow(f, (step, is_least), joint, resolution),
            Self::TooShort { step, time } => write!(
                f,
                "a step of {} s is below the resolution of the time {} s",
                Given(step),
                Given(time)
            ),
            Self::TooLong { step, rate } => write!(
                f,
                "the numbers grew without bound: a step of {} s is too long for violations that decay at {} 1/s, explicit steps must stay below \
                 about {} s",
                Given(step),
                Given(rate),
                Measured(2.0 / rate)
            ),
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
            Self::NotSolved {
                step,
                iterations,
                joint,
            } => not_solved(f, (step, iterations), joint),
            Self::Budget { evaluations, joint } => used_up(f, evaluations, joint),
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
            Self::HandlerOpens {
                event,
                joint,
                quantity,
                violation,
            } => {
                let open = Open {
                    joint,
                    quantity,
                    violation,
                };
                handler_opens(f, event, &open)
            }
        }
    }
}

impl core::error::Error for StepFault {}

fn without_inertia(f: &mut fmt::Formatter<'_>, body: &str) -> fmt::Result {
    write!(
        f,
        "the mass or inertia of `{body}`, as given, is not positive: the mechanism moves by its joints, and bodies have no equations \
         for accelerations, reactions and impulses of events"
    )
}

fn not_finite(f: &mut fmt::Formatter<'_>, origin: NotFinite) -> fmt::Result {
    f.write_str("the rates of the state are not finite")?;
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

fn not_converged(
    f: &mut fmt::Formatter<'_>,
    (iterations, residual): (u32, f64),
    joint: Option<&str>,
    alpha: Option<f64>,
) -> fmt::Result {
    let plural = if iterations == 1 { "" } else { "s" };
    write!(f, "no convergence after {iterations} iteration{plural}")?;
    if let Some(alpha) = alpha {
        let alpha = Given(alpha);
        write!(f, " of the augmented Lagrangian with `alpha = {alpha}`")?;
    }
    if let Some(joint) = joint {
        write!(f, ": joint `{joint}` is violated most")?;
    }
    write!(f, " (residual {})", Measured(residual))?;
    match alpha {
        Some(_) => f.write_str("; a larger `alpha` for these masses needs fewer iterations"),
        None => Ok(()),
    }
}

fn underflow(
    f: &mut fmt::Formatter<'_>,
    (step, is_least): (f64, bool),
    joint: Option<&str>,
    resolution: Option<f64>,
) -> fmt::Result {
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
            "the constraints all but depend on each other at joint `{joint}`: {AT_PIVOT}"
        ),
        (None, Some(resolution)) => write!(
            f,
            "positions of this size are known to {} m, which is coarser than the absolute tolerance: give a larger one, a number type of \
             more digits, or an origin that is nearer; if that does not help, the cause is a singular configuration, constraints that cannot be \
             met, or forces that jump",
            Measured(resolution)
        ),
        (None, None) => f.write_str(
            "constraints that cannot be met, a singular configuration, and forces that jump or grow without bound are the usual causes",
        ),
    }
}

/// What lies at a pivot that has nearly vanished.
const AT_PIVOT: &str = "a singular configuration, or constraints that cannot be met beyond it";

fn not_solved(
    f: &mut fmt::Formatter<'_>,
    (step, iterations): (f64, u32),
    joint: Option<&str>,
) -> fmt::Result {
    let step = Given(step);
    write!(
        f,
        "a step of {step} s was not solved in {iterations} iterations: "
    )?;
    match joint {
        Some(joint) => write!(
            f,
            "the constraints of joint `{joint}` nearly depend on others here"
        ),
        None => f.write_str(
            "it is too long for the motion, or for springs and dampers that are stiff; take a shorter one",
        ),
    }
}

fn used_up(f: &mut fmt::Formatter<'_>, evaluations: usize, joint: Option<&str>) -> fmt::Result {
    write!(f, "{evaluations} evaluations are used up")?;
    match joint {
        Some(joint) => write!(
            f,
            " where the constraints all but depend on each other at joint `{joint}`: {AT_PIVOT}"
        ),
        None => f.write_str(
            ": a singular configuration or a stiff formulation are the usual causes; `DormandPrince::budget` allows more",
        ),
    }
}

fn handler_opens(f: &mut fmt::Formatter<'_>, event: &str, open: &Open) -> fmt::Result {
    let help = if open.quantity.is_rate() {
        "`event.impact` gives a blow that the whole loop takes; what sets a rate sets that of one joint"
    } else {
        "set all joints of a loop, or put the state onto the constraints by `assemble`"
    };
    write!(f, "after the handler of `{event}` {open}: {help}")
}
