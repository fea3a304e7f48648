//! A run of a mechanism over an interval of time.

use core::fmt::{self, Debug};
use core::marker::PhantomData;
use core::ops::{ControlFlow, RangeInclusive};

use crate::assembly::assembled;
use crate::assembly::consistent_start::check_start;
use crate::constraints::projection::Projection;
use crate::constraints::row_units::characteristic_length;
use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{Counts, Integrator, Method};
use crate::math::scalar::Real;
use crate::measure::interacting::Heeding;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{Mechanism, Orientation};
use crate::mechanism::limits::Several as _;
use crate::mechanism::orientations::check_state;
use crate::monitor::Monitor;
use crate::run::companion::Companion;
use crate::run::events::list::{Happenings, Hybrid, NothingHappens};
use crate::run::events::switching::Switching;
use crate::run::output::{IntoFlow, Reporting, Schedule, check_interval, outcome};
use crate::run::passing::Passing;
use crate::run::past::{Past, Plan, Planned};
use crate::run::post_step::PostStabilisation;
use crate::run::report::{RunReport, RunResult};
use crate::run::resumed::take_values;
use crate::run::sample::Sample;
use crate::run::segments::{Log, Observer, Run};
use crate::state::vector::{Array, StateParts};
use crate::stepping::march::March;
use crate::stepping::marching::Marching as _;

/// A mechanism, a formulation and an integrator, ready to run.
///
/// `A` says which forces come on top of those of the description, `C` in which coordinates the
/// equations of motion are solved: those that the attribute of the mechanism names, or others that
/// are asked for.
pub struct Simulation<
    'a,
    S: Real,
    M: Mechanism,
    F,
    I,
    A = NoForces,
    C = <M as Mechanism>::Coordinates,
> {
    mechanism: Source<'a, S, M>,
    formulation: F,
    integrator: I,
    forces: A,
    initial: Option<M::State<S>>,
    assemble: Option<Projection<S>>,
    projection: Option<Projection<S>>,
    stabilisation: Option<&'a dyn PostStabilisation<S, M>>,
    breaks: &'a [S],
    accepts_any_start: bool,
    is_monitored: bool,
    is_verified: bool,
    coordinates: PhantomData<C>,
}

/// The interval (s) of a run, when it reports, and where it goes on.
type ToDo<'p, S, M> = ((S, S), Reporting<S>, Option<&'p Past<'p, S, M>>);

/// Where the numbers of a mechanism come from.
enum Source<'a, S: Real, M: Mechanism> {
    Mechanism(&'a M),
    /// They were accepted before.
    Parameters(M::Parameters<S>),
}

impl<S: Real, M: Mechanism> Clone for Source<'_, S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: Mechanism> Copy for Source<'_, S, M> {}

impl<S: Real, M: Mechanism, F: Clone, I: Clone, A: Clone, C> Clone
    for Simulation<'_, S, M, F, I, A, C>
{
    fn clone(&self) -> Self {
        Self {
            formulation: self.formulation.clone(),
            integrator: self.integrator.clone(),
            forces: self.forces.clone(),
            ..*self
        }
    }
}

/// The name of the mechanism, the formulation and the integrator.
impl<S: Real, M: Mechanism, F: Debug, I: Debug, A, C> Debug for Simulation<'_, S, M, F, I, A, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("mechanism", &M::REPORT.name)
            .field("formulation", &self.formulation)
            .field("integrator", &self.integrator)
            .finish_non_exhaustive()
    }
}

impl<'a, S, M, F, I> Simulation<'a, S, M, F, I, NoForces, M::Coordinates>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
{
    /// A simulation from the state that the attributes describe, in the coordinates that the
    /// attribute of the mechanism names, without further forces and without corrections.
    #[must_use]
    pub fn new(mechanism: &'a M, formulation: F, integrator: I) -> Self {
        Self::of(Source::Mechanism(mechanism), formulation, integrator)
    }

    /// A simulation with parameters that were accepted before.
    pub(crate) fn of_parameters(
        parameters: M::Parameters<S>,
        formulation: F,
        integrator: I,
    ) -> Self {
        Self::of(Source::Parameters(parameters), formulation, integrator)
    }

    fn of(mechanism: Source<'a, S, M>, formulation: F, integrator: I) -> Self {
        Self {
            mechanism,
            formulation,
            integrator,
            forces: NoForces,
            initial: None,
            assemble: None,
            projection: None,
            stabilisation: None,
            breaks: &[],
            accepts_any_start: false,
            is_monitored: true,
            is_verified: false,
            coordinates: PhantomData,
        }
    }
}

impl<'a, S, M, F, I, A, C> Simulation<'a, S, M, F, I, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
    C: Coordinates<M>,
{
    /// Starts from this state.
    #[must_use]
    pub fn initial_state(mut self, state: M::State<S>) -> Self {
        self.initial = Some(state);
        self
    }

    /// Corrects the initial state onto the constraints, see [`Projection`].
    #[must_use]
    pub fn assembled(mut self) -> Self {
        self.assemble = Some(Projection::default());
        self
    }

    /// Corrects the state onto the constraints after every step, and every state that is reported.
    /// Without it a run does so on its way through a singular configuration alone.
    #[must_use]
    pub fn projection(mut self, projection: Projection<S>) -> Self {
        self.projection = Some(projection);
        self.stabilisation = None;
        self
    }

    /// Treats the state after every step, and every state that is reported, in another way than by
    /// a [`Simulation::projection`], see [`PostStabilisation`].
    #[must_use]
    pub fn post_stabilisation(mut self, stabilisation: &'a dyn PostStabilisation<S, M>) -> Self {
        self.stabilisation = Some(stabilisation);
        self.projection = None;
        self
    }

    /// Accepts a start that violates the constraints by more than four digits, in positions or
    /// velocities, which is refused with [`Fault::InconsistentStart`] otherwise.
    #[must_use]
    pub fn inconsistent_start(mut self) -> Self {
        self.accepts_any_start = true;
        self
    }

    /// Begins the integration anew at these instants (s), in any order: where a law or a closure
    /// jumps or has a short pulse, which a step would pass over otherwise. Those of a `smooth_step`
    /// of the time with literal numbers are known without
    /// ([`ExplicitTime::breaks`](crate::mechanism::ExplicitTime::breaks)).
    #[must_use]
    pub fn breaks(mut self, instants: &'a [S]) -> Self {
        self.breaks = instants;
        self
    }

    /// Runs without the monitor behind [`RunReport::warnings`]: that saves a tenth to a third of
    /// the time, and more for runs of some ten steps.
    #[must_use]
    pub fn unmonitored(mut self) -> Self {
        self.is_monitored = false;
        self
    }

    /// Runs a companion beside the run, with half the step or another tolerance, and compares both
    /// at the reporting times: [`RunReport::verification`] estimates by how much every body is off,
    /// in m and rad, and from when on; [`Sample::error_of`] estimates the error of whatever an
    /// observer reads. It finds what single steps do not tell: how errors grow in orbits, falls
    /// from the upright and chaos, closures that jump, pulses that steps pass over.
    ///
    /// It costs two to three times what the run does by itself, and at least 256 steps with a
    /// tolerance. With half the step of a method of order 1 the estimate is half of the error.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let report = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01))
    ///     .verified()
    ///     .run(0.0..=10.0, every(0.1), |sample| {
    ///         let error = sample.error_of(|view| view.angle(Rod::HANDLES.hinge));
    ///         assert!(error.expect("it is verified") < 1e-4);
    ///     })?;
    /// let worst = report.verification.and_then(|found| found.worst()).expect("one body");
    /// println!("{} is off by {:e} rad", worst.body, worst.rotation);
    /// # Ok::<(), SimulationError<_>>(())
    /// ```
    #[must_use]
    pub fn verified(mut self) -> Self {
        self.is_verified = true;
        self
    }

    pub(super) fn exchange<A2, C2>(
        self,
        forces: impl FnOnce(A) -> A2,
    ) -> Simulation<'a, S, M, F, I, A2, C2> {
        Simulation {
            mechanism: self.mechanism,
            formulation: self.formulation,
            integrator: self.integrator,
            forces: forces(self.forces),
            initial: self.initial,
            assemble: self.assemble,
            projection: self.projection,
            stabilisation: self.stabilisation,
            breaks: self.breaks,
            accepts_any_start: self.accepts_any_start,
            is_monitored: self.is_monitored,
            is_verified: self.is_verified,
            coordinates: PhantomData,
        }
    }

    /// Applies forces as a function of time and state,
    /// `|time, state, loads| loads.force(body, ...)`.
    ///
    /// It is called at trial states, for times that go back and forth, and may remember nothing:
    /// what gives two answers for one time and state ends a run with [`Fault::TwoAnswers`]. A
    /// controller with memory is called by [`Simulation::every_period`].
    ///
    /// The evaluation is then done in its parts instead of fused, at a higher cost.
    #[must_use]
    pub fn forces<G>(self, law: G) -> Simulation<'a, S, M, F, I, A::With<ForceLaw<G>>, C>
    where
        A: AppliedForces<S, M>,
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        self.exchange(|forces| forces.with(ForceLaw(law)))
    }

    /// Solves the equations of motion in other coordinates: `.coordinates::<Relative>()`.
    #[must_use]
    pub fn coordinates<C2: Coordinates<M>>(self) -> Simulation<'a, S, M, F, I, A, C2> {
        self.exchange(|forces| forces)
    }

    /// Solves the equations of motion in relative (joint) coordinates, see [`JointCoordinates`]:
    /// bodies stand as the joints of a spanning tree let them at every step, to round-off, and an
    /// evaluation costs what the mechanism's freedom asks for.
    ///
    /// A start that opens a joint is refused, whatever [`Simulation::inconsistent_start`] says:
    /// those of the tree cannot open.
    ///
    /// States go in and come out as those of the bodies; reports, reactions, projection (of the
    /// joints that close loops) and monitor are the same. The monitor looks at the joints that
    /// close loops alone.
    #[must_use]
    pub fn joint_coordinates(self) -> Simulation<'a, S, M, F, I, A, Relative>
    where
        M: JointCoordinates,
    {
        self.coordinates()
    }

    /// Solves the equations of motion in absolute coordinates: of every body position, Euler
    /// parameters and velocities.
    #[must_use]
    pub fn absolute_coordinates(self) -> Simulation<'a, S, M, F, I, A, Absolute> {
        self.coordinates()
    }

    /// Absolute coordinates with other rates of Euler parameters.
    #[doc(hidden)]
    #[must_use]
    pub fn orientation<P: Orientation>(self) -> Simulation<'a, S, M, F, I, A, Absolute<P>> {
        self.coordinates()
    }
}

impl<S, M, F, I, A, C> Simulation<'_, S, M, F, I, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Runs over an interval of time (s) and shows the state to `observe` at the start, at the
    /// reporting times and at the end. An observer that returns `ControlFlow::Break(())` stops the
    /// run; one that returns nothing never does.
    ///
    /// An observer may return a `Result` of either, such as that of [`Sample::reaction`] or of
    /// `Recorder::record`. Its error stops the run, which returns it as
    /// [`RunError::Observer`](crate::RunError::Observer).
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let (rod, handles) = (Rod::default(), Rod::HANDLES);
    /// let mut largest = 0.0_f64;
    /// Simulation::new(&rod, StandardLagrange, Rk4::every(0.01)).run(
    ///     0.0..=1.0,
    ///     every(0.1),
    ///     |sample| {
    ///         let reaction = sample.reaction(handles.hinge, handles.rod)?;
    ///         largest = largest.max(reaction.force.norm());
    ///         Ok::<(), Fault>(())
    ///     },
    /// )?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// That of the observer. Else, where the run cannot go on, a
    /// [`SimulationError`](crate::SimulationError) with time, cause and last good state. Causes are
    /// a parameter, a coefficient or a setting that is not acceptable, a singular configuration,
    /// no convergence, a step too small, numbers out of range. The state is of zeros where a
    /// parameter was refused and no initial state had been given.
    pub fn run<O, R>(
        &self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<S, M, F, C, A>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        self.run_with(None, Planned(interval, reporting), observe)
    }

    /// The same with events and controllers.
    pub(crate) fn run_with<O, R>(
        &self,
        happenings: Option<&mut dyn Happenings<S, M>>,
        plan: impl Plan<S, M>,
        mut observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<S, M, F, C, A>,
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
        let (interval, reporting) = plan.interval();
        let zeros = || M::State::from_parts(Array::zeros(), Array::zeros());
        let mut last_good = (interval.0, self.initial.unwrap_or_else(zeros));
        let past = plan.past(&self.integrator, &self.formulation, C::IS_RELATIVE);
        let report = past.and_then(|past| {
            let plan = (interval, reporting, past.as_ref());
            self.attempt(happenings, plan, &mut observe, &mut last_good)
        });
        outcome::<R, _, _, _>(report, failure, last_good)
    }

    fn attempt(
        &self,
        happenings: Option<&mut dyn Happenings<S, M>>,
        ((start, end), reporting, past): ToDo<'_, S, M>,
        observe: &mut Observer<'_, S, M>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<RunReport<S, M>, Fault>
    where
        I: Runs<S, M, F, C, A>,
    {
        let dynamics = match self.mechanism {
            Source::Mechanism(mechanism) => Dynamics::new(mechanism, self.formulation),
            Source::Parameters(given) => Dynamics::of_parameters(given, self.formulation),
        }?;
        let given = *dynamics.parameters();
        let forces = Heeding::new(&self.forces, &given);
        let mut dynamics = dynamics.with_forces(forces).coordinates::<C>();
        let described = M::initial_state(dynamics.constants());
        let length = characteristic_length::<S, M>(dynamics.constants(), &described);
        let integrator = &self.integrator.for_length(length);
        if let Some(past) = past {
            take_values(&mut dynamics, past)?;
        }
        let constants = *dynamics.constants();
        let described = || M::initial_state(&constants);
        *last_good = past.map_or_else(
            || (start, self.initial.unwrap_or_else(described)),
            |past| past.at,
        );
        check_interval(start, end)?;
        check_interval(last_good.0, end)?;
        if let Some(instant) = self.breaks.iter().find(|instant| !instant.is_finite()) {
            return Err(Fault::BreakNotFinite {
                instant: instant.to_f64(),
            });
        }
        let schedule = Schedule::new(start, end, reporting)?;
        let schedule = schedule.after(past.map_or(0, |past| past.progress.reports));
        // Laws that switch and interactions make events of their own.
        let has_events = !M::SWITCHES.is_empty() || A::Tracked::COUNT > 0;
        let mut nothing = NothingHappens;
        let happenings = match happenings {
            None if has_events => Some(&mut nothing as &mut dyn Happenings<S, M>),
            other => other,
        };
        let hybrid = happenings.map(|list| self.hybrid(list, (start, end), &given, past));
        let mut hybrid = hybrid.transpose()?;
        let mut switching = (!M::SWITCHES.is_empty()).then(Switching::new);
        if let Some(hybrid) = &mut hybrid {
            hybrid.switching = switching.as_mut();
        }
        check_state::<S, M>(&last_good.1)?;
        if past.is_none() {
            last_good.1 = self.start(&constants, (start, end), last_good.1, described)?;
        } else if self.is_verified {
            return Err(Fault::NotVerified);
        }
        let state = last_good.1;
        let monitor = self.is_monitored.then(|| {
            Monitor::new(&constants, last_good.0, &state)
                .of_joints(C::keeps_equations)
                .over(integrator)
                .decaying(self.formulation.decay_rate())
        });
        let beside = integrator.companion(end - start);
        let mut beside = match beside.filter(|_| self.is_verified) {
            Some(integrator) => {
                let formulation = self.formulation.companion();
                let dynamics = Dynamics::of_parameters(given, formulation)?;
                let forces = Heeding::new(&self.forces, &given);
                let dynamics = dynamics.with_forces(forces).coordinates::<C>();
                Some(March::new(dynamics, integrator))
            }
            None => None,
        };
        let mut march = March::new(dynamics, *integrator);
        let projection = self.projection.as_ref();
        let projection = projection.map(|projection| projection as &dyn PostStabilisation<S, M>);
        let run = Run {
            settings: march.settings(),
            march: &mut march,
            companion: beside
                .as_mut()
                .map(|march| Companion::new(march, (start, &state))),
            stabilisation: self.stabilisation.or(projection),
            schedule,
            breaks: self.breaks,
            monitor,
            log: Log::new(observe),
            hybrid,
            passing: Passing::by(integrator),
            steps: 0,
            counts: Counts::default(),
            gone: None,
        };
        run.go((start, end), last_good, past)
    }

    /// The start of a run over an interval (s) from a state, assembled where that is asked.
    fn start(
        &self,
        constants: &M::Constants<S>,
        (start, end): (S, S),
        mut state: M::State<S>,
        described: impl Fn() -> M::State<S>,
    ) -> Result<M::State<S>, Fault> {
        M::rewrap(constants, &mut state);
        if let Some(projection) = self.assemble {
            assembled::<S, M>(&projection, constants, start, &mut state, &described())?;
        }
        if !self.accepts_any_start || C::IS_RELATIVE {
            let interval = (start, end - start);
            check_start::<S, M>(constants, interval, &state, C::IS_RELATIVE)?;
        }
        Ok(state)
    }

    /// What happens in a run over an interval (s).
    fn hybrid<'h>(
        &self,
        list: &'h mut (dyn Happenings<S, M> + 'h),
        interval: (S, S),
        given: &M::Parameters<S>,
        past: Option<&Past<'_, S, M>>,
    ) -> Result<Hybrid<'h, S, M>, Fault> {
        if self.is_verified {
            return Err(Fault::NotVerified);
        }
        let hybrid = Hybrid::new(list, given, self.accepts_any_start, interval)?;
        Ok(match past {
            Some(past) => hybrid.resumed(past),
            None => hybrid,
        })
    }
}

/// Methods that run a mechanism `M` by a formulation `F`, with forces `A` of a closure and in the
/// coordinates `C`. It is implemented by every [`Integrator`] of such a system; a function that is
/// generic over methods asks for it.
///
/// ```
/// use holonom::{Runs, prelude::*};
///
/// fn evaluations<M, I>(mechanism: &M, method: I) -> usize
/// where
///     M: Mechanism,
///     I: Runs<f64, M, StandardLagrange>,
/// {
///     let simulation = Simulation::new(mechanism, StandardLagrange, method);
///     let run = simulation.run(0.0..=1.0, every(0.1), |_| ());
///     run.map_or(0, |report| report.evaluations)
/// }
/// ```
pub trait Runs<S, M, F, C = <M as Mechanism>::Coordinates, A = NoForces>:
    for<'f> Integrator<S, Dynamics<S, M, F, Heeding<S, M, &'f A>, C>>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
    A: AppliedForces<S, M>,
{
}

impl<I, S, M, F, A, C> Runs<S, M, F, C, A> for I
where
    I: for<'f> Integrator<S, Dynamics<S, M, F, Heeding<S, M, &'f A>, C>>,
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
    A: AppliedForces<S, M>,
{
}
