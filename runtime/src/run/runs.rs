//! Runs of a simulation over an interval of time.

use core::ops::{ControlFlow, RangeInclusive};

use crate::dynamics::{Carrying, Dynamics, Posed, Solvable};
use crate::error::{Fault, StartFault};
use crate::formulation::Formulation;
use crate::integrate::{Integrator, Method};
use crate::math::scalar::Real;
use crate::measure::interacting::Heeding;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
#[cfg(feature = "std")]
use crate::run::checkpoint::Checkpoint;
use crate::run::companion::Companion;
use crate::run::driver::{Course, Driver};
use crate::run::events::list::{Happenings, Hybrid, NothingHappens};
use crate::run::events::switching::Switching;
use crate::run::observed::{Log, Observed, Observer};
use crate::run::output::{IntoFlow, Reporting, Schedule, outcome};
use crate::run::past::{Past, Plan, Planned};
use crate::run::prepared::Prepared;
use crate::run::report::{RunReport, RunResult};
use crate::run::sample::Sample;
use crate::run::simulation::{Setup, Simulation};
use crate::state::vector::{Array, StateParts};
use crate::stepping::march::March;
use crate::stepping::marching::Marching as _;

/// The interval (s) of a run, when it reports, and where it goes on.
type ToDo<'p, S, M> = ((S, S), Reporting<S>, Option<&'p Past<'p, S, M>>);

/// What a run moves, by forces that it is lent.
type Lent<'f, P> = Carrying<P, &'f <P as Posed>::Forces>;

impl<P, S: Real, M: Mechanism, I> Simulation<'_, P, I, NothingHappens>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Method<S>,
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
        I: Runs<P>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        self.setup
            .run_with(&self.forces, None, Planned(interval, reporting), observe)
    }

    /// Goes on from a [`Checkpoint`] to the end of its interval: what is
    /// shown and reported from there on is what the whole run would have shown and reported.
    ///
    /// Build the simulation as that of the run: the same mechanism with the values of its start,
    /// the same formulation, method, coordinates, corrections, breaks, forces, interactions, events
    /// and controllers. The initial state is of no account.
    ///
    /// ```
    /// use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let simulation = || rod.simulation(StandardLagrange, DormandPrince::default());
    /// let mut kept = Vec::new();
    /// let whole = simulation()
    ///     .checkpoints(10, |checkpoint| kept.push(checkpoint.clone()))
    ///     .run(0.0..=5.0, every(0.1), |_| ())?;
    /// let half = &kept[kept.len() / 2];
    /// assert_eq!(simulation().resume(half, |_| ())?, whole); // to the last bit
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Simulation::run`], and [`Fault::Checkpoint`](crate::Fault::Checkpoint) where the
    /// simulation is not that of the checkpoint.
    #[cfg(feature = "std")]
    pub fn resume<O, R>(
        &self,
        checkpoint: &Checkpoint<M, S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<P>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        self.setup.run_with(&self.forces, None, checkpoint, observe)
    }
}

impl<P, S: Real, M: Mechanism, I, E, X> Simulation<'_, P, I, (E, X)>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Method<S>,
    (E, X): Happenings<S, M>,
{
    /// Runs over an interval of time (s) as a simulation does in which nothing happens, with events
    /// and controllers. A further run begins with what their closures remember.
    ///
    /// # Errors
    /// Those of a run, of [`Simulation::on`] and [`Simulation::every_period`].
    pub fn run<O, R>(
        &mut self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<P>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let happenings = Some(&mut self.happenings as &mut dyn Happenings<S, M>);
        self.setup.run_with(
            &self.forces,
            happenings,
            Planned(interval, reporting),
            observe,
        )
    }

    /// Goes on from a [`Checkpoint`] with events and controllers: the same ones as in its run, in
    /// the same order. Closures begin with what they remember, so put it back first.
    ///
    /// # Errors
    /// Those of a run, and [`Fault::Checkpoint`](crate::Fault::Checkpoint) where the simulation is
    /// not that of the checkpoint.
    #[cfg(feature = "std")]
    pub fn resume<O, R>(
        &mut self,
        checkpoint: &Checkpoint<M, S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<P>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let list: &mut dyn Happenings<S, M> = &mut self.happenings;
        self.setup
            .run_with(&self.forces, Some(list), checkpoint, observe)
    }
}

impl<P, S: Real, M: Mechanism, I> Setup<'_, P, I>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Runs<P>,
{
    /// Runs with what happens, as it is planned.
    pub(super) fn run_with<O, R>(
        &self,
        forces: &P::Forces,
        happenings: Option<&mut dyn Happenings<S, M>>,
        plan: impl Plan<S, M>,
        mut observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
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
        let (interval, reporting) = plan.interval();
        let zeros = || M::State::from_parts(Array::zeros(), Array::zeros());
        let mut last_good = At {
            time: interval.0,
            bodies: self.initial.unwrap_or_else(zeros),
        };
        let past = plan.past(
            &self.integrator,
            &self.formulation,
            P::Coordinates::IS_RELATIVE,
        );
        let report = past.map_err(Fault::from).and_then(|past| {
            let plan = (interval, reporting, past.as_ref());
            self.attempt(forces, happenings, plan, &mut observe, &mut last_good)
        });
        outcome::<R, _, _, _>(report, failure, (last_good.time, last_good.bodies))
    }

    fn attempt(
        &self,
        forces: &P::Forces,
        happenings: Option<&mut dyn Happenings<S, M>>,
        (interval, reporting, past): ToDo<'_, S, M>,
        observe: &mut Observer<'_, S, M>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<RunReport<S, M>, Fault> {
        let (start, end) = interval;
        let is_unverifiable = self.is_verified && (happenings.is_some() || past.is_some());
        let mut nothing = NothingHappens;
        let is_bare = happenings.is_none();
        let list = happenings.unwrap_or(&mut nothing);
        let plan = (interval, past);
        let mut prepared = self.prepared(forces, (&mut *list, is_bare), plan, last_good)?;
        let Prepared {
            integrator, given, ..
        } = prepared;
        if is_unverifiable {
            return Err(Fault::Start(StartFault::NotVerified));
        }
        let schedule = Schedule::new(start, end, reporting)?;
        let schedule = schedule.after(past.map_or(0, |past| past.progress.reports));
        let beside = integrator.companion(end - start);
        let beside = beside.filter(|_| self.is_verified);
        let mut beside = beside
            .map(|method| self.beside(forces, method, given))
            .transpose()?;
        let has_sides = self.is_verified && !M::SWITCHES.is_empty();
        let (mut none, mut sides) = (NothingHappens, has_sides.then(Switching::new));
        let mut of_companion = None;
        let companion = match &mut beside {
            Some(march) => {
                let mut hybrid = Hybrid::new(&mut none, &given, true, interval)?;
                hybrid.is_empty = prepared.course.hybrid.is_empty;
                let beside = Course::new(march.settings(), &integrator, hybrid, None);
                let driver = Driver {
                    march,
                    list: &mut none,
                    switching: sides.as_mut(),
                    stabilisation: self.stabilisation(),
                    breaks: self.breaks,
                    course: of_companion.insert(beside),
                };
                Some(Companion::new(driver, schedule, *last_good))
            }
            None => None,
        };
        let mut march = March::new(prepared.equations, integrator);
        let run = Observed {
            companion,
            schedule,
            log: Log::new(observe),
            driver: Driver {
                march: &mut march,
                list,
                switching: prepared.switching.as_mut(),
                stabilisation: self.stabilisation(),
                breaks: self.breaks,
                course: &mut prepared.course,
            },
        };
        run.go(interval, last_good, past)
    }

    /// What a companion integrates, by its own method, from the same parameters on.
    fn beside<'f>(
        &self,
        forces: &'f P::Forces,
        integrator: I,
        given: M::Parameters<S>,
    ) -> Result<March<Lent<'f, P>, I>, Fault> {
        let dynamics = Dynamics::of_parameters(given, self.formulation.companion())?;
        let dynamics = dynamics.with_forces(Heeding::new(forces, &given));
        Ok(March::new(
            dynamics.coordinates::<P::Coordinates>(),
            integrator,
        ))
    }
}

/// Methods that run a problem `P`. It is implemented by every [`Integrator`] of its equations; a
/// function that is generic over methods asks for it.
///
/// ```
/// use holonom::{Runs, prelude::*};
///
/// fn evaluations<M, I>(mechanism: &M, method: I) -> usize
/// where
///     M: Mechanism,
///     I: Runs<Problem<M, StandardLagrange>>,
/// {
///     let simulation = Simulation::new(mechanism, StandardLagrange, method);
///     let run = simulation.run(0.0..=1.0, every(0.1), |_| ());
///     run.map_or(0, |report| report.evaluations)
/// }
/// ```
pub trait Runs<P: Solvable>: for<'f> Integrator<P::Number, Dynamics<Lent<'f, P>>> {}

impl<P: Solvable, I: for<'f> Integrator<P::Number, Dynamics<Lent<'f, P>>>> Runs<P> for I {}
