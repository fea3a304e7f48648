//! A simulation with events and controllers.

use core::convert::Infallible;
use core::fmt::{self, Debug};
use core::ops::{ControlFlow, RangeInclusive};

use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{InputsOf, Mechanism};
#[cfg(feature = "std")]
use crate::run::checkpoint::{Checkpoint, keeper::Keeping};
use crate::run::events::context::Event;
use crate::run::events::list::{Controlled, Handled, Happenings, NothingHappens};
use crate::run::output::{IntoFlow, Reporting};
use crate::run::past::Planned;
use crate::run::report::RunResult;
use crate::run::sample::Sample;
use crate::run::simulation::{Runs, Simulation};
#[cfg(feature = "std")]
use crate::run::trajectory::{Recorded, Trajectory};
use crate::stepping::watch::{Crossing, Period, Watch};

/// What a handler or a controller may return: nothing, `ControlFlow<()>`, whose `Break(())` stops
/// the run, or a `Result` of either with a [`Fault`], which ends the run.
pub trait Handling: IntoFlow<Failure: Into<Fault>> {}

impl<R: IntoFlow<Failure: Into<Fault>>> Handling for R {}

impl From<Infallible> for Fault {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

/// A simulation with events and controllers, by [`Simulation::on`] and
/// [`Simulation::every_period`]. See [`guide::events`](mod@crate::guide::events).
pub struct HybridSimulation<T, E> {
    pub(super) simulation: T,
    pub(super) happenings: E,
}

/// As the simulation.
impl<T: Debug, E> Debug for HybridSimulation<T, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("HybridSimulation")
            .field("simulation", &self.simulation)
            .finish_non_exhaustive()
    }
}

/// A simulation in which something more happens.
pub type With<T, E, H> = HybridSimulation<T, (E, H)>;

/// What a simulation computes with, and what it simulates.
pub trait Simulated {
    /// Its numbers.
    type Number: Real;
    /// Its mechanism.
    type Mechanism: Mechanism;
}

impl<S: Real, M: Mechanism, F, I, A, C> Simulated for Simulation<'_, S, M, F, I, A, C> {
    type Number = S;
    type Mechanism = M;
}

impl<T, E> HybridSimulation<T, E> {
    fn and<H>(self, happening: H) -> With<T, E, H> {
        HybridSimulation {
            simulation: self.simulation,
            happenings: (self.happenings, happening),
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
    /// Calls a handler where a reading passes zero.
    ///
    /// The time is located to some units in its last place, on the dense output of the method.
    /// Events of one step are handled in their order, those at one time in the order in which they
    /// were given. The handler may change the state, the inputs and the parameters, and stop the
    /// run, see [`Event`]. The integration begins anew after every event.
    ///
    /// The observer is shown the state that was found. It is shown the one that a handler sets as
    /// well, at the same time.
    ///
    /// A condition does not fire at the zero at which a run starts, nor at the one at which a
    /// handler leaves a state that it has set. A reading that a handler takes past zero does not
    /// fire either. Two zeros of one reading within a sixth of a step may be missed.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A ball of 1 kg on a vertical rail, 1 m above the floor.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81])]
    /// struct Ball {
    ///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    ///     ball: Body,
    ///     #[joint(between = [ground, ball], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0])]
    ///     rail: Prismatic,
    /// }
    ///
    /// let (ball, h) = (Ball::default(), Ball::HANDLES);
    /// let mut bounces = 0;
    /// ball.simulation(StandardLagrange, DormandPrince::default())
    ///     .on("floor", Crossing::Falling, |sample| sample.pose(h.ball).position.z, |event| {
    ///         bounces += 1;
    ///         event.set_displacement_rate(h.rail, -0.8 * event.displacement_rate(h.rail))
    ///     })
    ///     .run(0.0..=2.0, every(0.1), |_| ())?;
    /// assert_eq!(bounces, 3);
    /// # Ok::<(), SimulationError<StateOf<Ball>>>(())
    /// ```
    ///
    /// # Errors of the run
    /// [`Fault::EventNotANumber`] of a reading, [`Fault::Chattering`] of a condition that fires
    /// without end, those of a start for a state that a handler sets, and the fault that a handler
    /// returns. [`Fault::NotVerified`] of a run that is to be [`Simulation::verified`].
    #[must_use]
    pub fn on<G, H, R>(
        self,
        name: &'static str,
        crossing: Crossing,
        reading: G,
        handler: H,
    ) -> HybridSimulation<Self, (NothingHappens, Handled<S, G, H>)>
    where
        G: Fn(&Sample<'_, S, M>) -> S,
        H: FnMut(&mut Event<'_, S, M>) -> R,
        R: Handling,
    {
        self.without_events().on(name, crossing, reading, handler)
    }

    /// Calls a controller at `t0 + k dt` (s), `t0` included and the end of the run not. The inputs
    /// that it sets are held until the next call, and the integration begins anew there. They begin
    /// as those of the mechanism.
    ///
    /// The controller is called once for each instant, in their order, and may remember what it
    /// wants. A report at an instant comes before the call, but for the start.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81])]
    /// # struct Arm {
    /// #     #[input]
    /// #     torque: f64,
    /// #     #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    /// #     link: Body,
    /// #     #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// #     #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
    /// #     motor: TorsionalActuator,
    /// # }
    /// let (arm, h) = (Arm::default(), Arm::HANDLES); // with `#[input] torque: f64`
    /// let mut integral = 0.0;
    /// arm.simulation(StandardLagrange, DormandPrince::default())
    ///     .every_period(1e-3, |sample, inputs| {
    ///         let error = 0.5 - sample.angle(h.hinge);
    ///         integral += error * 1e-3;
    ///         inputs.torque = 30.0 * error + 40.0 * integral - 6.0 * sample.angle_rate(h.hinge);
    ///     })
    ///     .run(0.0..=5.0, every(0.1), |_| ())?;
    /// # Ok::<(), SimulationError<StateOf<Arm>>>(())
    /// ```
    ///
    /// # Errors of the run
    /// [`Fault::Setting`] of a period that is not positive, [`Fault::StepTooShort`] of one that the
    /// time does not resolve, and the fault that the controller returns. [`Fault::NotVerified`] of
    /// a run that is to be [`Simulation::verified`].
    #[must_use]
    pub fn every_period<K, R>(
        self,
        period: S,
        controller: K,
    ) -> HybridSimulation<Self, (NothingHappens, Controlled<S, K>)>
    where
        K: FnMut(&Sample<'_, S, M>, &mut M::Inputs<S>) -> R,
        R: Handling,
    {
        self.without_events().every_period(period, controller)
    }

    /// Calls a closure with a [`Checkpoint`] after every so many steps, and at the end of the run,
    /// so that a run that is stopped can go on: see [`Simulation::resume`].
    ///
    /// A closure that returns `ControlFlow::Break(())` stops the run, and nothing is lost. Where
    /// something else stops it, what came after the last checkpoint is computed again.
    ///
    /// A checkpoint costs one evaluation, which is not counted, and as many numbers as the method
    /// remembers: some states, with implicit methods the Jacobian as well.
    ///
    /// # Errors of the run
    /// [`Fault::Setting`] of zero steps. [`Fault::Checkpoint`] with a method of your own that does
    /// not hand over what it remembers. The fault that the closure returns. [`Fault::NotVerified`]
    /// of a run that is to be [`Simulation::verified`].
    #[cfg(feature = "std")]
    #[must_use]
    pub fn checkpoints<K, R>(
        self,
        steps: usize,
        keep: K,
    ) -> HybridSimulation<Self, (NothingHappens, Keeping<K>)>
    where
        K: FnMut(&Checkpoint<M, S>) -> R,
        R: Handling,
    {
        self.without_events().checkpoints(steps, keep)
    }

    /// Records the motion, to be asked at any time when the run is over: see [`Trajectory`]. What
    /// the trajectory knew is forgotten, but for a run that goes on from a checkpoint.
    ///
    /// It takes 5 to 17 states a step, and 7 to 15 interpolations; with
    /// [`RadauIIA`](crate::RadauIIA) each of these is a step of its own.
    #[cfg(feature = "std")]
    #[must_use]
    pub fn trajectory(
        self,
        trajectory: &mut Trajectory<M, S>,
    ) -> HybridSimulation<Self, (NothingHappens, Recorded<'_, M, S>)> {
        self.without_events().trajectory(trajectory)
    }

    /// Runs until a reading first passes zero, or to the end:
    /// [`RunReport::stopped`](crate::RunReport::stopped) says which,
    /// [`RunReport::time`](crate::RunReport::time) when. For reports on the way use
    /// [`Simulation::on`].
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
    /// let report = rod
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .run_until(0.0..=2.0, Crossing::Falling, |sample| {
    ///         sample.angle(Rod::HANDLES.hinge) + 1.0
    ///     })?;
    /// assert!(report.stopped && report.time < 1.0); // 1 rad below the horizontal
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Simulation::run`] and [`Simulation::on`].
    pub fn run_until<G>(
        &self,
        interval: RangeInclusive<S>,
        crossing: Crossing,
        reading: G,
    ) -> RunResult<S, M>
    where
        G: Fn(&Sample<'_, S, M>) -> S,
        F: Clone,
        I: Runs<S, M, F, C, A>,
        A: AppliedForces<S, M> + Clone,
    {
        let duration = *interval.end() - *interval.start();
        let reporting = if duration > S::zero() {
            Reporting::Every(duration)
        } else {
            Reporting::EveryStep
        };
        let stop = |_: &mut Event<'_, S, M>| ControlFlow::Break(());
        let hybrid = self
            .clone()
            .without_events()
            .on("the end", crossing, reading, stop);
        { hybrid }.run(interval, reporting, |_| ())
    }

    fn without_events(self) -> HybridSimulation<Self, NothingHappens> {
        HybridSimulation {
            simulation: self,
            happenings: NothingHappens,
        }
    }
}

impl<T: Simulated, E> HybridSimulation<T, E> {
    /// See [`Simulation::on`].
    #[must_use]
    pub fn on<G, H, R>(
        self,
        name: &'static str,
        crossing: Crossing,
        reading: G,
        handler: H,
    ) -> With<T, E, Handled<T::Number, G, H>>
    where
        G: Fn(&Sample<'_, T::Number, T::Mechanism>) -> T::Number,
        H: FnMut(&mut Event<'_, T::Number, T::Mechanism>) -> R,
        R: Handling,
    {
        self.and(Handled {
            watch: Watch::new(name, crossing),
            reading,
            handler,
        })
    }

    /// See [`Simulation::every_period`].
    #[must_use]
    pub fn every_period<K, R>(
        self,
        period: T::Number,
        controller: K,
    ) -> With<T, E, Controlled<T::Number, K>>
    where
        K: FnMut(&Sample<'_, T::Number, T::Mechanism>, &mut InputsOf<T::Mechanism, T::Number>) -> R,
        R: Handling,
    {
        self.and(Controlled {
            period: Period::new(period),
            controller,
        })
    }

    /// See [`Simulation::checkpoints`].
    #[cfg(feature = "std")]
    #[must_use]
    pub fn checkpoints<K, R>(self, steps: usize, keep: K) -> With<T, E, Keeping<K>>
    where
        K: FnMut(&Checkpoint<T::Mechanism, T::Number>) -> R,
        R: Handling,
    {
        self.and(Keeping { steps, keep })
    }

    /// See [`Simulation::trajectory`].
    #[cfg(feature = "std")]
    #[must_use]
    pub fn trajectory(
        self,
        trajectory: &mut Trajectory<T::Mechanism, T::Number>,
    ) -> With<T, E, Recorded<'_, T::Mechanism, T::Number>> {
        self.and(Recorded(trajectory))
    }
}

impl<S, M, F, I, A, C, E> HybridSimulation<Simulation<'_, S, M, F, I, A, C>, E>
where
    S: Real,
    M: Mechanism,
{
    /// Runs over an interval of time (s) as [`Simulation::run`] does, with events and controllers.
    /// A further run begins with what their closures remember.
    ///
    /// # Errors
    /// Those of [`Simulation::run`], [`Simulation::on`] and [`Simulation::every_period`].
    pub fn run<O, R>(
        &mut self,
        interval: RangeInclusive<S>,
        reporting: Reporting<S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        F: Formulation<S>,
        I: Runs<S, M, F, C, A>,
        E: Happenings<S, M>,
        A: AppliedForces<S, M>,
        C: Coordinates<M>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let happenings = Some(&mut self.happenings as &mut dyn Happenings<S, M>);
        self.simulation
            .run_with(happenings, Planned(interval, reporting), observe)
    }

    /// Goes on from a [`Checkpoint`] as [`Simulation::resume`] does, with events and controllers:
    /// the same ones as in its run, in the same order. Closures begin with what they remember, so
    /// put it back first.
    ///
    /// # Errors
    /// Those of [`HybridSimulation::run`], and [`Fault::Checkpoint`] where the simulation is not
    /// that of the checkpoint.
    #[cfg(feature = "std")]
    pub fn resume<O, R>(
        &mut self,
        checkpoint: &Checkpoint<M, S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        F: Formulation<S>,
        I: Runs<S, M, F, C, A>,
        E: Happenings<S, M>,
        A: AppliedForces<S, M>,
        C: Coordinates<M>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let list: &mut dyn Happenings<S, M> = &mut self.happenings;
        self.simulation.run_with(Some(list), checkpoint, observe)
    }
}
