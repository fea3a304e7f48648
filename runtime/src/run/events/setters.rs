//! Events, controllers, checkpoints and trajectories of a simulation.

use core::convert::Infallible;
use core::ops::{ControlFlow, RangeInclusive};

use crate::dynamics::{Posed, Solvable};
use crate::error::Fault;
use crate::integrate::Method;
use crate::math::scalar::Scalar as _;
use crate::mechanism::kernels::InputsOf;
#[cfg(feature = "std")]
use crate::run::checkpoint::{Checkpoint, keeper::Keeping};
use crate::run::events::context::Event;
use crate::run::events::list::{Controlled, Handled};
use crate::run::events::relay::Relay;
use crate::run::events::times::Timed;
use crate::run::output::{IntoFlow, Reporting};
use crate::run::report::RunResult;
use crate::run::runs::Runs;
use crate::run::sample::Sample;
use crate::run::simulation::Simulation;
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

/// A simulation in which something more happens.
type With<'a, P, I, H, X> = Simulation<'a, P, I, (H, X)>;

impl<'a, P: Posed, I, H> Simulation<'a, P, I, H> {
    fn and<X>(self, happening: X) -> With<'a, P, I, H, X> {
        Simulation {
            setup: self.setup,
            forces: self.forces,
            happenings: (self.happenings, happening),
        }
    }
}

impl<'a, P, I, H> Simulation<'a, P, I, H>
where
    P: Posed,
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
    /// [`StepFault::EventNotANumber`](crate::error::StepFault::EventNotANumber) of a reading,
    /// [`StepFault::Chattering`](crate::error::StepFault::Chattering) of a condition that fires
    /// without end, those of a start for a state that a handler sets, and the fault that a handler
    /// returns. [`StartFault::NotVerified`](crate::error::StartFault::NotVerified) of a run that is
    /// to be [`Simulation::verified`].
    #[must_use]
    pub fn on<G, K, R>(
        self,
        name: &'static str,
        crossing: Crossing,
        reading: G,
        handler: K,
    ) -> With<'a, P, I, H, Handled<P::Number, G, K>>
    where
        G: Fn(&Sample<'_, P::Number, P::Mechanism>) -> P::Number,
        K: FnMut(&mut Event<'_, P::Number, P::Mechanism>) -> R,
        R: Handling,
    {
        self.and(Handled {
            watch: Watch::new(name, crossing),
            reading,
            handler,
        })
    }

    /// Calls a handler at each of these times (s), which increase. A step ends there, and the
    /// integration begins anew.
    ///
    /// The handler may do what one of [`Simulation::on`] may, and comes behind those of events at
    /// the same time and before controllers. Times outside the interval of the run are left out,
    /// its start and its end are not. The observer is shown the state before the handler, but for
    /// the start, and the one that it sets. In a run that a caller leads, such a time is
    /// [`Reached::Event`](crate::run::Reached::Event) of its name. A run that goes on from a
    /// checkpoint needs the same times, and calls for each once.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A ball of 1 kg on a vertical rail.
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
    /// let mut kicks = Vec::new();
    /// ball.simulation(StandardLagrange, DormandPrince::default())
    ///     .at("kick", [0.5, 1.2], |event| {
    ///         kicks.push(event.time());
    ///         event.set_displacement_rate(h.rail, 1.0)
    ///     })
    ///     .run(0.0..=1.5, every(0.1), |_| ())?;
    /// assert_eq!(kicks, [0.5, 1.2]);
    /// # Ok::<(), SimulationError<StateOf<Ball>>>(())
    /// ```
    ///
    /// # Errors of the run
    /// [`StartFault::Times`](crate::error::StartFault::Times) of times that are not finite or do
    /// not increase, and those of [`Simulation::on`] for a handler.
    #[must_use]
    pub fn at<T, K, R>(
        self,
        name: &'static str,
        times: T,
        handler: K,
    ) -> With<'a, P, I, H, Timed<T, K>>
    where
        T: AsRef<[P::Number]>,
        K: FnMut(&mut Event<'_, P::Number, P::Mechanism>) -> R,
        R: Handling,
    {
        self.and(Timed::new(name, times, handler))
    }

    /// A relay with hysteresis, by two thresholds of a reading. It calls a handler with `true`
    /// where the reading rises to the upper one, and with `false` where it then falls to the lower
    /// one. Between them it stays as it is.
    ///
    /// The handler is called at the start as well, with `true` only for a reading at the upper
    /// threshold or above. So inputs that it sets are right from the start on. Where another
    /// handler takes the reading past the threshold that is next, it is called at the same instant.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A boiler of 4 kJ/K that loses 40 W/K to a room at 15 degrees, and its pump.
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints")]
    /// struct Boiler {
    ///     #[input]
    ///     heat: f64,
    ///     #[state(rate = (heat - 40.0 * (temperature - 15.0)) / 4000.0, start = 15.0)]
    ///     temperature: f64,
    ///     #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    ///     pump: Body,
    ///     #[joint(between = [ground, pump], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    ///     shaft: Revolute,
    /// }
    ///
    /// let (boiler, h) = (Boiler::default(), Boiler::HANDLES);
    /// boiler
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .relay("thermostat", [55.0, 60.0], |s| s.state_value(h.temperature), |event, is_hot| {
    ///         event.inputs_mut().heat = if is_hot { 0.0 } else { 4e3 };
    ///     })
    ///     .run(0.0..=600.0, every(1.0), |sample| {
    ///         let temperature = sample.state_value(h.temperature);
    ///         assert!(temperature < 60.0 + 1e-6);
    ///         assert!(temperature > 55.0 - 1e-6 || sample.time() < 60.0);
    ///     })?;
    /// # Ok::<(), SimulationError<StateOf<Boiler>>>(())
    /// ```
    ///
    /// # Errors of the run
    /// [`StartFault::Setting`](crate::error::StartFault::Setting) of thresholds that are not finite
    /// and in order, and those of [`Simulation::on`].
    #[must_use]
    pub fn relay<G, K, R>(
        self,
        name: &'static str,
        thresholds: [P::Number; 2],
        reading: G,
        handler: K,
    ) -> With<'a, P, I, H, Relay<P::Number, G, K>>
    where
        G: Fn(&Sample<'_, P::Number, P::Mechanism>) -> P::Number,
        K: FnMut(&mut Event<'_, P::Number, P::Mechanism>, bool) -> R,
        R: Handling,
    {
        self.and(Relay::new(name, thresholds, reading, handler))
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
    /// [`StartFault::Setting`](crate::error::StartFault::Setting) of a period that is not positive,
    /// [`StepFault::TooShort`](crate::error::StepFault::TooShort) of one that the time does not
    /// resolve, and the fault that the controller returns.
    /// [`StartFault::NotVerified`](crate::error::StartFault::NotVerified) of a run that is to be
    /// [`Simulation::verified`].
    #[must_use]
    pub fn every_period<K, R>(
        self,
        period: P::Number,
        controller: K,
    ) -> With<'a, P, I, H, Controlled<P::Number, K>>
    where
        K: FnMut(&Sample<'_, P::Number, P::Mechanism>, &mut InputsOf<P::Mechanism, P::Number>) -> R,
        R: Handling,
    {
        self.and(Controlled {
            period: Period::new(period),
            controller,
        })
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
    /// [`StartFault::Setting`](crate::error::StartFault::Setting) of zero steps.
    /// [`Fault::Checkpoint`] with a method of your own that does not hand over what it remembers.
    /// The fault that the closure returns.
    /// [`StartFault::NotVerified`](crate::error::StartFault::NotVerified) of a run that is to be
    /// [`Simulation::verified`].
    #[cfg(feature = "std")]
    #[must_use]
    pub fn checkpoints<K, R>(self, steps: usize, keep: K) -> With<'a, P, I, H, Keeping<K>>
    where
        K: FnMut(&Checkpoint<P::Mechanism, P::Number>) -> R,
        R: Handling,
    {
        self.and(Keeping { steps, keep })
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
        trajectory: &mut Trajectory<P::Mechanism, P::Number>,
    ) -> With<'a, P, I, H, Recorded<'_, P::Mechanism, P::Number>> {
        self.and(Recorded(trajectory))
    }
}

impl<P: Solvable, I: Method<P::Number>> Simulation<'_, P, I> {
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
        interval: RangeInclusive<P::Number>,
        crossing: Crossing,
        reading: G,
    ) -> RunResult<P::Number, P::Mechanism>
    where
        G: Fn(&Sample<'_, P::Number, P::Mechanism>) -> P::Number,
        I: Runs<P>,
        P::Forces: Clone,
    {
        let duration = *interval.end() - *interval.start();
        let reporting = if duration > P::Number::zero() {
            Reporting::Every(duration)
        } else {
            Reporting::EveryStep
        };
        let stop = |_: &mut Event<'_, P::Number, P::Mechanism>| ControlFlow::Break(());
        let mut run = self.clone().on("the end", crossing, reading, stop);
        run.run(interval, reporting, |_| ())
    }
}
