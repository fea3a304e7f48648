//! What can go wrong at run time. Small enums, no strings; the last good state travels with them.

use core::fmt;

use crate::readable::{Given, Measured};

/// A number of the description that the macro could not see is not acceptable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParameterError {
    /// The field of the mechanism.
    pub field: &'static str,
    /// The attribute.
    pub attribute: &'static str,
    /// What is wrong with it.
    pub fault: ParameterFault,
}

/// What is wrong with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParameterFault {
    /// NaN or infinite.
    NotFinite,
    /// Zero or negative where a positive number is needed.
    NotPositive,
    /// Principal moments of inertia of which one exceeds the sum of the others.
    TriangleInequality,
    /// A vector of length zero where a direction is needed.
    ZeroLength,
}

impl fmt::Display for ParameterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fault = match self.fault {
            ParameterFault::NotFinite => "must be finite",
            ParameterFault::NotPositive => "must be positive",
            ParameterFault::TriangleInequality => {
                "must satisfy the triangle inequality: no principal moment exceeds the sum of the others"
            }
            ParameterFault::ZeroLength => "must not be the zero vector",
        };
        write!(f, "`{}` of `{}` {fault}", self.attribute, self.field)
    }
}

impl core::error::Error for ParameterError {}

/// Why an evaluation, a step or a correction could not be done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The state holds NaN or infinity.
    StateNotFinite,
    /// The Euler parameters of a body in the state have the length zero: no orientation.
    ZeroOrientation {
        /// The body's field.
        body: &'static str,
    },
    /// The rates came out as NaN or infinity: forces beyond the range of numbers, or a singular system.
    RatesNotFinite,
    /// The constraints depend on each other here: at this joint the pivot vanishes.
    Singular {
        /// The index of the joint in [`crate::Report::joints`].
        joint: usize,
        /// The joint's field.
        name: &'static str,
        /// The relative pivot, see [`crate::Pivot`].
        relative_pivot: f64,
    },
    /// The iteration of the augmented Lagrangian, or of a correction, did not converge.
    NotConverged {
        /// The iterations done.
        iterations: usize,
        /// The last change (augmented Lagrangian) or the violation left (correction).
        residual: f64,
        /// The joint whose equations are violated most, by accelerations in the augmented Lagrangian, where it is known.
        joint: Option<&'static str>,
    },
    /// The step control found no step with an error within the tolerance, down to what the time's own digits resolve.
    StepSizeUnderflow {
        /// The last step that was tried (s).
        step: f64,
        /// The joint whose pivot has nearly vanished, where that is the cause, see [`crate::Pivot`].
        joint: Option<&'static str>,
    },
    /// A step that was asked for is below what the time's own digits resolve.
    StepTooShort {
        /// The step (s).
        step: f64,
        /// The time (s).
        time: f64,
    },
    /// A fixed step that is too long for the rate at which the formulation makes violations decay: the motion grew beyond all numbers.
    StepTooLong {
        /// The step (s).
        step: f64,
        /// The rate (1/s).
        rate: f64,
    },
    /// A run has taken as many evaluations as it may, see [`StepLimits::evaluations`](crate::StepLimits::evaluations).
    Budget {
        /// How many it has taken.
        evaluations: usize,
    },
    /// A run was to begin where a joint is open, or where its bodies move against it.
    InconsistentStart {
        /// The joint's field.
        joint: &'static str,
        /// What is violated.
        quantity: Quantity,
        /// By how much, in the unit of the quantity.
        violation: f64,
    },
    /// A kinematic analysis of a mechanism that its equations do not determine: there are fewer than velocities.
    NotDriven {
        /// Velocities less equations.
        degrees_of_freedom: isize,
    },
    /// A kinematic analysis came to a configuration where the equations, although enough, leave a motion free.
    Undetermined {
        /// The share of a trial motion's energy that stays free, from 0 to 1.
        share: f64,
    },
    /// A tolerance, a step, an interval or a coefficient that is not finite and positive.
    Setting {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A parameter of the mechanism is not acceptable.
    Parameter(ParameterError),
}

/// What a joint's equations are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length (m).
    Length,
    /// An angle (rad).
    Angle,
    /// A speed (m/s).
    Speed,
    /// An angular velocity (rad/s).
    AngularVelocity,
}

impl Quantity {
    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Angle => "rad",
            Self::Speed => "m/s",
            Self::AngularVelocity => "rad/s",
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::StateNotFinite => write!(f, "the state holds a number that is not finite"),
            Self::ZeroOrientation { body } => {
                write!(f, "the Euler parameters of body `{body}` have no length")
            }
            Self::RatesNotFinite => write!(f, "the rates of the state are not finite"),
            Self::Singular {
                name,
                relative_pivot,
                ..
            } => write!(
                f,
                "the constraints depend on each other at joint `{name}` (relative pivot {relative_pivot:e})"
            ),
            Self::NotConverged {
                iterations,
                residual,
                joint,
            } => {
                let plural = if iterations == 1 { "" } else { "s" };
                write!(f, "no convergence after {iterations} iteration{plural}")?;
                if let Some(joint) = joint {
                    write!(f, ": joint `{joint}` is violated most")?;
                }
                write!(f, " (residual {residual:e})")
            }
            Self::StepSizeUnderflow { step, joint } => {
                write!(
                    f,
                    "the step size {step:e} s is below the resolution of the time; "
                )?;
                match joint {
                    Some(joint) => write!(
                        f,
                        "the constraints all but depend on each other at joint `{joint}`: a singular configuration, or constraints that cannot be met beyond it"
                    ),
                    None => write!(
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
            Self::Budget { evaluations } => write!(
                f,
                "{evaluations} evaluations are used up: a singular configuration or a stiff formulation are the usual causes; \
                 `DormandPrince::budget` allows more"
            ),
            Self::InconsistentStart {
                joint,
                quantity,
                violation,
            } => {
                let (violation, unit) = (Measured(violation), quantity.unit());
                match quantity {
                    Quantity::Length | Quantity::Angle => {
                        write!(
                            f,
                            "joint `{joint}` is open by {violation} {unit} at the start"
                        )?;
                    }
                    Quantity::Speed | Quantity::AngularVelocity => write!(
                        f,
                        "the bodies of joint `{joint}` move against it at {violation} {unit} at the start"
                    )?,
                }
                write!(
                    f,
                    ": `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
                )
            }
            Self::StepTooShort { step, time } => write!(
                f,
                "a step of {step:e} s is below the resolution of the time {time} s"
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
                "the equations leave a motion free here ({share:e} of a trial motion): they depend on each other, or a driver is missing"
            ),
            Self::Setting { name, value } => {
                write!(f, "`{name}` must be finite and positive, not {value:e}")
            }
            Self::Parameter(error) => error.fmt(f),
        }
    }
}

impl From<ParameterError> for Fault {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}

impl core::error::Error for Fault {}

/// A run or a step that could not go on: when, why, and the last good state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulationError<X> {
    /// The time of the last good state (s).
    pub time: f64,
    /// Why it stopped.
    pub fault: Fault,
    /// The last good state.
    pub state: X,
}

impl<X> fmt::Display for SimulationError<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} s: {}", self.time, self.fault)
    }
}

impl<X: fmt::Debug> core::error::Error for SimulationError<X> {}
