//! The motion of a mechanism whose drivers leave it no freedom: positions, velocities,
//! accelerations, and what it takes.

mod across;
mod motion;

use core::fmt::{self, Debug};
use core::ops::{ControlFlow, RangeInclusive};

use self::motion::Motion;
use crate::constraints::projection::Projection;
use crate::dynamics::{Bodies, Dynamics, Posed, Problem, Solvable, WithForces};
use crate::error::{AnalysisFault, Fault, LeavesOut, SimulationError};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::{ForceLaw, Loads, NoForces};
use crate::mechanism::kernels::{Mechanism, bodies_alone, configurations_alone};
use crate::mechanism::orientations::check_state;
use crate::monitor::Warnings;
use crate::nonsmooth::described::check_limits;
use crate::run::output::{IntoFlow, Reporting, Schedule, check_interval, outcome};
use crate::run::sample::Sample;
use crate::state::vector::{Array, StateParts};

/// Kinematics and inverse dynamics of a mechanism that is driven fully: as many independent
/// equations as velocities.
///
/// At every reporting time (Nikravesh 1988, chapter 3; Flores 2015, chapter 7):
///
/// 1. positions from `Phi(q, t) = 0` by Newton's method, from the pose before moved by its
///    velocities and accelerations;
/// 2. velocities from `Phi' = D u + Phi_t = 0`;
/// 3. accelerations and multipliers by one evaluation of the equations of motion:
///    [`Sample::accelerations`], [`Sample::reaction`], [`Sample::driving_effort`] show what the
///    prescribed motion takes.
///
/// Nothing is integrated, so no error accumulates.
///
/// **The analysis keeps its branch**, however far apart the reporting times are. Between them it
/// goes by steps, in each of which a body turns by 0.2 rad at most, or moves by as much of the
/// mechanism's size. A step is shortened where the pose that is found is far from the one that
/// positions, velocities and accelerations predict, or where its velocities are. The relative
/// pivots are followed along the way: a singular configuration, at which another branch begins, is
/// among [`KinematicReport::warnings`], with its joint. The motion goes straight on through it. A
/// report that falls on such a configuration, or nearer to it than the digits of a pose tell, has
/// position and velocity. Accelerations, reactions and efforts are refused there by the sample, by
/// [`StepFault::Singular`](crate::error::StepFault::Singular): what the motion takes has no limit.
///
/// The evaluation follows the formulation: [`StandardLagrange`](crate::StandardLagrange) where the
/// equations are independent; where some are redundant, [`Penalty`](crate::Penalty) or
/// [`AugmentedLagrangian`](crate::AugmentedLagrangian), with accelerations that are exact up to the
/// compliance and forces that are shared among redundant equations.
///
/// `P` is the [`Problem`]. Its coordinates do not matter: positions are those of the bodies.
pub struct KinematicAnalysis<'a, P: Posed> {
    mechanism: &'a P::Mechanism,
    formulation: P::Formulation,
    forces: P::Forces,
    initial: Option<Bodies<P>>,
    projection: Projection<P::Number>,
    heeds_limits: bool,
}

impl<P: Posed<Formulation: Clone, Forces: Clone>> Clone for KinematicAnalysis<'_, P> {
    fn clone(&self) -> Self {
        Self {
            formulation: self.formulation.clone(),
            forces: self.forces.clone(),
            ..*self
        }
    }
}

/// The name of the mechanism, and the formulation.
impl<P: Posed<Formulation: Debug>> Debug for KinematicAnalysis<'_, P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("KinematicAnalysis")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("formulation", &self.formulation)
            .finish_non_exhaustive()
    }
}

/// What a kinematic analysis came to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct KinematicReport<S, X> {
    /// Poses that were reported: at the start, at the reporting times and at the end.
    pub poses: usize,
    /// Steps between poses, reported or not.
    pub steps: usize,
    /// How often a step was tried that turned out too long.
    pub shortened: usize,
    /// Steps of Newton's method for all of them.
    pub iterations: usize,
    /// The largest `Phi^T Phi` at a reporting time.
    pub worst_violation: S,
    /// The time (s) of the last state: the end, or the reporting time at which the observer stopped
    /// the analysis.
    pub time: S,
    /// The last state.
    pub state: X,
    /// Whether the observer stopped the analysis.
    pub stopped: bool,
    warnings: Warnings,
}

impl<S, X> KinematicReport<S, X> {
    /// Warnings; empty where the motion was followed without a choice. A branch point
    /// ([`Warning::BranchPoint`](crate::Warning::BranchPoint)) is found by pivots: not where
    /// equations are kept that depend on others.
    #[must_use]
    pub fn warnings(&self) -> Warnings {
        self.warnings
    }
}

/// The report of a kinematic analysis, or why it could not go on; `E` is another error where the
/// observer may fail, see [`RunError`](crate::RunError).
pub type KinematicResult<S, M, E = SimulationError<<M as Mechanism>::State<S>>> =
    Result<KinematicReport<S, <M as Mechanism>::State<S>>, E>;

impl<'a, M: Mechanism, F: Formulation<S>, S: Real> KinematicAnalysis<'a, Problem<M, F, S>> {
    /// An analysis from the pose that the attributes describe, without further forces.
    #[must_use]
    pub fn new(mechanism: &'a M, formulation: F) -> Self {
        Self {
            mechanism,
            formulation,
            forces: NoForces,
            initial: None,
            projection: Projection::default(),
            heeds_limits: true,
        }
    }
}

impl<'a, P: Posed> KinematicAnalysis<'a, P> {
    /// Looks for the first pose near this state, instead of the described one.
    #[must_use]
    pub fn initial_state(mut self, state: Bodies<P>) -> Self {
        self.initial = Some(state);
        self
    }

    /// Tolerance and iterations of Newton's method.
    #[must_use]
    pub fn projection(mut self, projection: Projection<P::Number>) -> Self {
        self.projection = projection;
        self
    }

    /// Passes the limits of the description, which end an analysis otherwise.
    #[must_use]
    pub fn without_limits(mut self) -> Self {
        self.heeds_limits = false;
        self
    }

    /// Applies forces as a function of time and state,
    /// `|time, state, loads| loads.force(body, ...)`. The motion does not depend on them, reactions
    /// and driving efforts do.
    #[must_use]
    pub fn forces<G>(self, law: G) -> KinematicAnalysis<'a, WithForces<P, ForceLaw<G>>>
    where
        G: Fn(P::Number, &Bodies<P>, &mut Loads<'_, P::Number, P::Mechanism>),
    {
        KinematicAnalysis {
            mechanism: self.mechanism,
            formulation: self.formulation,
            forces: ForceLaw(law),
            initial: self.initial,
            projection: self.projection,
            heeds_limits: self.heeds_limits,
        }
    }
}

impl<P, S: Real, M: Mechanism> KinematicAnalysis<'_, P>
where
    P: Solvable<Number = S, Mechanism = M>,
{
    /// Follows the motion over an interval of time (s) and shows it to `observe` at the start, at
    /// the reporting times and at the end. An observer that returns `ControlFlow::Break(())` stops
    /// it; one that returns nothing never does. An error of the observer stops it and is handed on,
    /// see [`Simulation::run`](crate::Simulation::run). [`every_step`](crate::every_step) reports
    /// at start and end.
    ///
    /// # Errors
    /// Time, cause and last good state where the analysis cannot go on:
    /// [`AnalysisFault::VelocityEquations`] for a mechanism with equations of velocities,
    /// [`AnalysisFault::NotDriven`] for one with fewer equations than velocities,
    /// [`AnalysisFault::MotionLeftFree`] where they leave a motion free all the same,
    /// [`StepFault::NotConverged`](crate::error::StepFault::NotConverged) where no pose is found,
    /// [`AssemblyFault::BeyondLimit`](crate::error::AssemblyFault::BeyondLimit) of a pose beyond a
    /// limit of the description, and what an evaluation or a run may refuse. The state is of zeros
    /// where a parameter was refused and no initial state had been given.
    pub fn run<O, R>(
        &self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        mut observe: O,
    ) -> KinematicResult<S, M, R::Error<M::State<S>>>
    where
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let mut failure = None;
        let mut observe = |sample: &Sample<'_, S, M>| {
            observe(sample).into_flow().unwrap_or_else(|error| {
                failure = Some(error);
                ControlFlow::Break(())
            })
        };
        let (start, end) = interval.into_inner();
        let zeros = || M::State::from_parts(Array::zeros(), Array::zeros());
        let mut last_good = (start, self.initial.unwrap_or_else(zeros));
        let report = self.attempt(start, end, reporting, &mut observe, &mut last_good);
        outcome::<R, _, _, _>(report, failure, last_good)
    }

    fn attempt(
        &self,
        start: S,
        end: S,
        reporting: Reporting<S>,
        observe: &mut impl FnMut(&Sample<'_, S, M>) -> ControlFlow<()>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<KinematicReport<S, M::State<S>>, Fault> {
        let dynamics = Dynamics::new(self.mechanism, self.formulation)?
            .with_forces(&self.forces)
            .absolute_coordinates();
        let state = self
            .initial
            .unwrap_or_else(|| M::initial_state(dynamics.constants()));
        last_good.1 = state;
        check_interval(start, end)?;
        let mut schedule = Schedule::new(start, end, reporting)?;
        check_state::<S, M>(&state)?;
        bodies_alone::<M>(LeavesOut::Kinematics)?;
        configurations_alone::<M>()?;
        let degrees_of_freedom = M::REPORT.degrees_of_freedom;
        if degrees_of_freedom > 0 {
            return Err(Fault::Analysis(AnalysisFault::NotDriven {
                degrees_of_freedom,
            }));
        }
        let mut motion = Motion::new(dynamics, self.projection, start, &state);
        let mut found = motion.begin(start, state)?;
        let mut worst_violation = S::zero();
        let mut poses = 1;
        loop {
            *last_good = (found.time, found.state);
            if self.heeds_limits {
                let dynamics = &motion.dynamics;
                let (parameters, constants) = (dynamics.parameters(), dynamics.constants());
                check_limits::<S, M>(parameters, constants, (found.time, &found.state))?;
            }
            let view = motion.dynamics.view(found.time, &found.state);
            worst_violation = worst_violation.max(view.violation());
            let sample = Sample::evaluated(view, &motion.dynamics, found.evaluation);
            let stopped = observe(&sample).is_break();
            if stopped || found.time >= end {
                return Ok(KinematicReport {
                    poses,
                    steps: motion.steps,
                    shortened: motion.shortened,
                    iterations: motion.iterations,
                    worst_violation,
                    time: found.time,
                    state: found.state,
                    stopped,
                    warnings: motion.passage.warnings(),
                });
            }
            let time = schedule.following().unwrap_or(end);
            found = motion.follow(found, time, last_good)?;
            poses += 1;
        }
    }
}
