//! What can go wrong at run time. Small enums, no strings; the last good state travels with them.
//! What they say is in [`crate::message`].

use crate::error::analysis::AnalysisFault;
use crate::error::checkpoint::CheckpointFault;
use crate::error::left_out::{LeavesOut, Unheeding};
use crate::error::parameter::ParameterError;

/// Why an evaluation, a step, a correction or a reading could not be done.
///
/// `Debug` prints the sentence of `Display`, for a `main` that returns the error.
#[derive(Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The state holds NaN or infinity.
    StateNotFinite,
    /// A spectral radius that is not from 0 to 1.
    SpectralRadius {
        /// Its value.
        value: f64,
    },
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
    /// The mechanism has a state of the user's own, with a rate, which was asked to be left out.
    StateLeftOut {
        /// The state's field.
        state: &'static str,
        /// Who leaves it out.
        by: LeavesOut,
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
        iterations: usize,
        /// The last change (augmented Lagrangian) or the violation left (correction).
        residual: f64,
        /// The joint whose equations are violated most, by accelerations in the augmented
        /// Lagrangian, where it is known.
        joint: Option<&'static str>,
        /// The penalty factor of the augmented Lagrangian; `None` for a correction.
        alpha: Option<f64>,
    },
    /// The step control found no step with an error within the tolerance, down to what the time's
    /// own digits resolve, or to [`StepLimits::least`](crate::integrate::StepLimits::least).
    StepSizeUnderflow {
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
    StepTooShort {
        /// The step (s).
        step: f64,
        /// The time (s).
        time: f64,
    },
    /// A fixed step that is too long for the rate at which the formulation makes violations decay:
    /// the motion grew beyond all numbers.
    StepTooLong {
        /// The step (s).
        step: f64,
        /// The rate (1/s).
        rate: f64,
    },
    /// The closure of [`Simulation::forces`](crate::Simulation::forces) gives two answers for one
    /// time and state: it remembers something.
    TwoAnswers {
        /// The body's field on which its forces differ.
        body: &'static str,
        /// The time (s) at which it was asked twice.
        time: f64,
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
    /// An angle or a displacement was put beyond its limit.
    BeyondLimit {
        /// The field of the joint or the point.
        joint: &'static str,
        /// The value (rad, m).
        value: f64,
        /// The limit (rad, m).
        limit: f64,
    },
    /// A driver moves a joint against its limit.
    DrivenAgainst {
        /// The field of the joint or the point with the limit.
        joint: &'static str,
        /// The field of the driver that moves now.
        driver: &'static str,
        /// The limit (rad, m).
        limit: f64,
        /// The time (s).
        time: f64,
    },
    /// Limits and other interactions were to be left out, without
    /// [`without_limits`](crate::Simulation::without_limits).
    LimitsLeftOut {
        /// The field of the first joint or point with one.
        joint: &'static str,
        /// What does not heed them.
        by: Unheeding,
    },
    /// No modes of interactions fit together at an instant.
    NoMode {
        /// The field of the joint or the point of one of them.
        joint: &'static str,
        /// The time (s).
        time: f64,
    },
    /// Friction by the load of its joint has no effort while it slides, or several: what it adds to
    /// its own load, times its coefficient, reaches 1 (Painleve's paradox).
    NoUniqueFriction {
        /// The field of the joint.
        joint: &'static str,
        /// The time (s).
        time: f64,
    },
    /// The load of a joint with friction by it is not determined. Equations of the joint depend on
    /// others, or what is held shares its efforts in a way that nothing decides.
    LoadNotUnique {
        /// The field of the joint.
        joint: &'static str,
    },
    /// The modes of interactions change again and again at once.
    EndlessModes {
        /// The field of the joint or the point of the last one.
        joint: &'static str,
        /// How often at once.
        changes: usize,
        /// The time (s).
        time: f64,
    },
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha) does not move a mechanism with
    /// [`Interaction`](crate::run::Interaction)s.
    NoInteractions,
    /// A run with handlers, controllers, checkpoints or a trajectory was to be
    /// [`verified`](crate::Simulation::verified): what closures do cannot be done twice.
    NotVerified,
    /// A run that its caller leads ([`Simulation::begin`](crate::Simulation::begin)) was to be
    /// [`verified`](crate::Simulation::verified), to keep checkpoints or to record a trajectory.
    NotLed,
    /// A trajectory does not know the time that it is asked for.
    OutsideTrajectory {
        /// The time (s).
        time: f64,
        /// Where it begins (s); NaN where it knows no motion.
        start: f64,
        /// Where it ends (s).
        end: f64,
    },
    /// A checkpoint cannot be made, or a run cannot go on from it.
    Checkpoint(CheckpointFault),
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
        iterations: usize,
    },
    /// The iteration of a step on the constraints does not converge, see
    /// [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    StepNotSolved {
        /// The step (s).
        step: f64,
        /// The iterations done.
        iterations: usize,
        /// The joint whose pivot has nearly vanished, where the configuration is the cause, see
        /// [`crate::mechanism::Pivot`].
        joint: Option<&'static str>,
    },
    /// The factor of a penalty is so large that its compliance is lost in round-off, while
    /// equations are kept that depend on others and have nothing else to go by.
    PenaltyFactor {
        /// The factor `alpha`.
        alpha: f64,
        /// The largest that the masses of the mechanism and the digits of the numbers allow.
        largest: f64,
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
    /// An instant of [`Simulation::breaks`](crate::Simulation::breaks) is not finite.
    BreakNotFinite {
        /// The instant (s).
        instant: f64,
    },
    /// A run was to begin where a joint is open, or where its bodies move against it.
    InconsistentStart {
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
    /// The derivatives of a start violate those of the constraints: along a direction a parameter
    /// moves a joint, and the bodies do not go with it.
    StartOpens {
        /// The joint's field.
        joint: &'static str,
        /// The number of the direction.
        direction: usize,
        /// The derivative of its equation.
        violation: f64,
    },
    /// A kinematic analysis of a mechanism that its equations do not determine: there are fewer
    /// than velocities.
    NotDriven {
        /// Velocities less equations.
        degrees_of_freedom: isize,
    },
    /// A kinematic analysis came to a configuration where the equations, although enough, leave a
    /// motion free.
    Undetermined {
        /// The share of a trial motion's energy that stays free, from 0 to 1.
        share: f64,
    },
    /// A joint is on a side that is not meant: its equations hold, but the other way round
    /// (`require .. > 0` in its definition).
    WrongSide {
        /// The joint's field.
        joint: &'static str,
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
    /// A tolerance, a step or a coefficient that is not finite and positive.
    Setting {
        /// Which one.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// An interval of time whose ends are not finite or not in order.
    Interval {
        /// Where it begins (s).
        start: f64,
        /// Where it ends (s).
        end: f64,
    },
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
    /// Angles that count turns were set, and their number is not that of the joint or force.
    CountedAngles {
        /// The field of the joint or force.
        element: &'static str,
        /// How many angles it counts turns of.
        counted: usize,
        /// How many were given.
        given: usize,
    },
    /// Angles of an orientation were asked for where they are singular (gimbal lock): the first and
    /// the third turn about one axis, and only their sum or difference is known.
    SingularAngles {
        /// The body's field.
        body: &'static str,
        /// Which angles.
        angles: AngleSet,
    },
    /// A law slides along its switch: on both sides the motion leads back to it.
    SlidingLaw {
        /// The field of the force or state.
        law: &'static str,
        /// The expression whose sign decides.
        expression: &'static str,
        /// When (s).
        time: f64,
    },
    /// The expression whose sign decides in a law is not a number, or changes its sign too often to
    /// be followed.
    SwitchUndecided {
        /// The field of the force or state.
        law: &'static str,
        /// The expression.
        expression: &'static str,
        /// When (s).
        time: f64,
    },
    /// A law switches in a state, and its sides differ there: it has no derivative, and where it
    /// jumps an equilibrium would be one of a range.
    OnSwitch {
        /// The field of the force or state.
        law: &'static str,
        /// The expression whose sign decides.
        expression: &'static str,
    },
    /// Derivatives of a run were asked for, and a law switches: they jump where it does, which no
    /// run of derivatives takes into account.
    SwitchLeftOut {
        /// The field of the force or state.
        law: &'static str,
    },
    /// Coordinates cannot be chosen, or have no such equations or equilibrium.
    Analysis(AnalysisFault),
    /// A parameter of the mechanism is not acceptable.
    Parameter(ParameterError),
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

/// What a joint's equations are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
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

impl From<AnalysisFault> for Fault {
    fn from(fault: AnalysisFault) -> Self {
        Self::Analysis(fault)
    }
}

impl From<ParameterError> for Fault {
    fn from(error: ParameterError) -> Self {
        Self::Parameter(error)
    }
}

impl core::error::Error for Fault {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Parameter(error) => Some(error),
            _ => None,
        }
    }
}
