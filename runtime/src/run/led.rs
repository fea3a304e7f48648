//! A run that its caller leads.

use core::fmt::{self, Debug};
use core::ops::RangeInclusive;

use crate::dynamics::{Bodies, Carrying, Dynamics, Posed, Solvable};
use crate::error::setting::interval;
use crate::error::{Fault, SimulationError, StartFault};
use crate::integrate::{Integrator, Method};
use crate::math::scalar::{Real, Scalar as _};
use crate::measure::load::Led;
use crate::measure::view::View;
use crate::mechanism::at::At;
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::{Course, Driver};
use crate::run::events::context::Event;
use crate::run::events::list::{Happenings, NothingHappens};
use crate::run::events::switching::Switching;
use crate::run::handled::Handled;
use crate::run::output::IntoFlow;
use crate::run::pulled::{Pulled, Way};
use crate::run::report::RunReport;
use crate::run::sample::Sample;
use crate::run::simulation::{Setup, Simulation};
use crate::state::vector::{Array, StateParts as _};
use crate::stepping::march::March;
use crate::stepping::marching::Marching as _;

/// What a [`Run`] has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reached {
    /// The end of a step.
    Step,
    /// The time that was asked for.
    Time,
    /// An event, by its name: its handlers were called. Of several at once it is the first that the
    /// simulation was given.
    Event(&'static str),
    /// Another instant from which the motion goes on in a new way. The mode of an interaction or
    /// the side of a law has changed, or a handler has set the state.
    Change,
    /// The end of the interval, or a handler has stopped the run. It goes no farther.
    End,
}

type Failed<P> = SimulationError<Bodies<P>>;
type OnTheWay<'r, P> = (
    Driver<'r, <P as Posed>::Number, <P as Posed>::Mechanism>,
    &'r mut Way<<P as Posed>::Number, <P as Posed>::Mechanism>,
);
/// A run that is led, or why it does not begin.
type BeginResult<'a, P, I, H> = Result<Run<'a, P, I, H>, Failed<P>>;
/// What a run moves that owns its forces.
type Owned<P> = Carrying<P, Led<<P as Posed>::Forces>>;

/// Methods that move a [`Run`] of a problem `P`: all [`Integrator`]s do.
pub trait Leads<P: Solvable>: Integrator<P::Number, Dynamics<Owned<P>>> {}

impl<P: Solvable, I: Integrator<P::Number, Dynamics<Owned<P>>>> Leads<P> for I {}

/// A run that its caller leads: from step to step, or from time to time. It is begun by
/// [`Simulation::begin`](crate::Simulation::begin).
///
/// [`Simulation::run`](crate::Simulation::run) is the same loop with an observer. Events,
/// controllers, interactions, laws that switch, corrections and the monitor are the same. Steps are
/// the same to the last bit where both ask for output alike. Between two calls the state may be
/// read and changed. A run is a value, which a struct may hold.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::run::Reached;
///
/// /// A rod of 1 m, released from the horizontal.
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
/// let mut run = rod
///     .simulation(StandardLagrange, DormandPrince::default())
///     .on("stop", Crossing::Falling, move |sample| sample.angle(hinge) + 1.0, |_| ())
///     .begin(0.0..=1.2)?;
/// let mut bounces = 0;
/// loop {
///     match run.advance()? {
///         Reached::Event("stop") => {
///             bounces += 1;
///             run.change(|event| event.set_angle_rate(hinge, -0.5 * event.angle_rate(hinge)))?;
///         }
///         Reached::End => break,
///         _ => {}
///     }
/// }
/// assert!(bounces > 1 && run.sample().angle(hinge) > -1.0);
/// assert!(run.report().warnings().is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run<'a, P: Solvable, I: Leads<P>, H = NothingHappens> {
    march: March<Owned<P>, I>,
    happenings: H,
    switching: Option<Switching<P::Number, P::Mechanism>>,
    course: Course<P::Number, P::Mechanism>,
    way: Way<P::Number, P::Mechanism>,
    setup: Setup<'a, P, I>,
    /// Nothing moves any more.
    is_over: bool,
}

/// The name of the mechanism, the time that was reached, and the method.
impl<P: Solvable, I: Leads<P>, H> Debug for Run<'_, P, I, H> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Run")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("time", &self.way.at.time)
            .field("integrator", &self.setup.integrator)
            .finish_non_exhaustive()
    }
}

impl<'a, P, I, H> Simulation<'a, P, I, H>
where
    P: Solvable,
    I: Method<P::Number>,
    H: Happenings<P::Number, P::Mechanism>,
{
    /// Begins a run over an interval of time (s) that the caller leads, see [`Run`]. Controllers
    /// have been called at its start.
    ///
    /// # Errors
    /// Those of [`Simulation::run`](crate::Simulation::run) at a start. [`StartFault::NotLed`] of a
    /// simulation that is [`verified`](crate::Simulation::verified), keeps checkpoints or records a
    /// trajectory.
    pub fn begin(self, interval: RangeInclusive<P::Number>) -> BeginResult<'a, P, I, H>
    where
        I: Leads<P>,
    {
        let interval = (*interval.start(), *interval.end());
        let (setup, mut happenings) = (self.setup, self.happenings);
        let zeros = || Bodies::<P>::from_parts(Array::zeros(), Array::zeros());
        let mut at = At {
            time: interval.0,
            bodies: setup.initial.unwrap_or_else(zeros),
        };
        let list: &mut dyn Happenings<P::Number, P::Mechanism> = &mut happenings;
        let mut is_bare = true;
        let asked = list.each(&mut |_| {
            is_bare = false;
            Ok(())
        });
        let plan = (interval, None);
        let prepared =
            asked.and_then(|()| setup.prepared(Led(self.forces), (list, is_bare), plan, &mut at));
        let prepared = prepared.map_err(|fault| failed(fault, &at))?;
        if setup.is_verified || prepared.course.hybrid.is_observed() {
            return Err(failed(Fault::Start(StartFault::NotLed), &at));
        }
        let mut run = Run {
            march: March::new(prepared.equations, prepared.integrator),
            happenings,
            switching: prepared.switching,
            course: prepared.course,
            way: Way::from(at),
            setup,
            is_over: false,
        };
        let begun = run.with_driver(|driver, way| {
            let stops = driver.begin(interval, &mut way.at)?;
            driver.begin_to_watch(interval, &way.at)?;
            Ok(stops)
        });
        run.is_over = begun?;
        Ok(run)
    }
}

/// Why a run does not go on from a state.
fn failed<S: Real, X: Copy>(fault: Fault, at: &At<S, X>) -> SimulationError<X> {
    SimulationError {
        time: at.time.to_f64(),
        fault,
        state: at.bodies,
    }
}

impl<P, I, H> Run<'_, P, I, H>
where
    P: Solvable,
    I: Leads<P>,
    H: Happenings<P::Number, P::Mechanism>,
{
    /// The time that was reached (s).
    #[must_use]
    pub fn time(&self) -> P::Number {
        self.way.at.time
    }

    /// The state of the bodies at that time.
    #[must_use]
    pub fn state(&self) -> &Bodies<P> {
        &self.way.at.bodies
    }

    /// Readings of that state, as an observer has them: reactions, accelerations and modes of
    /// interactions among them.
    #[must_use]
    pub fn sample(&self) -> Sample<'_, P::Number, P::Mechanism> {
        let equations = self.march.equations();
        let (time, bodies) = self.way.at.borrowed();
        Sample::new(View::new(equations.constants(), time, bodies), equations)
    }

    /// Goes on to the end of the next step, or of the last one if [`Run::advance_to`] has stopped
    /// within it.
    ///
    /// # Errors
    /// Why the run cannot go on, with the last good state, which [`Run::state`] is as well.
    pub fn advance(&mut self) -> Result<Reached, Failed<P>> {
        let end = self.course.hybrid.end;
        self.pull(end, end)
    }

    /// Goes on to a time (s), or to an event or another change before it. Steps do not end at that
    /// time: the state there is that of the interpolant, corrected as a report is. A time behind
    /// the end of the interval is its end.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # use holonom::run::Reached;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let mut run = rod.simulation(StandardLagrange, DormandPrince::default()).begin(0.0..=1.0)?;
    /// for frame in 1..=60 {
    ///     let time = f64::from(frame) / 60.0;
    ///     while !matches!(run.advance_to(time)?, Reached::Time | Reached::End) {}
    ///     println!("{time} s: {} rad", run.sample().angle(Rod::HANDLES.hinge));
    /// }
    /// assert_eq!(run.time(), 1.0);
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::advance`]; [`StartFault::Interval`] of a time before that which was reached.
    pub fn advance_to(&mut self, time: P::Number) -> Result<Reached, Failed<P>> {
        let at = self.way.at.time;
        // One that is no number is not after it either.
        if time.partial_cmp(&at).is_none_or(core::cmp::Ordering::is_lt) {
            return Err(failed(interval(at, time).into(), &self.way.at));
        }
        let time = time.min(self.course.hybrid.end);
        loop {
            let reached = self.pull(time, time)?;
            if reached != Reached::Step {
                return Ok(reached);
            }
        }
    }

    fn pull(&mut self, time: P::Number, output: P::Number) -> Result<Reached, Failed<P>> {
        if self.is_over {
            return Ok(Reached::End);
        }
        let end = self.course.hybrid.end;
        let first_output = |from: P::Number| output - from;
        let pulled = self.with_driver(|driver, way| driver.pull(way, time, &first_output))?;
        let is_end = self.way.at.time >= end;
        let handled = match pulled {
            Pulled::Time if !is_end => return Ok(Reached::Time),
            Pulled::Instant(handled) => handled,
            _ => Handled::default(),
        };
        self.is_over = is_end || handled.stops;
        Ok(match handled.event {
            Some(event) => Reached::Event(event),
            None if handled.is_new => Reached::Change,
            None if self.is_over => Reached::End,
            None => Reached::Step,
        })
    }

    /// Changes the state, inputs, parameters or interactions at the time that was reached, by what
    /// a handler of an event has. The state is checked as a start is, sides of laws and modes of
    /// interactions are found anew, and the integration begins anew. It forgets the rest of a step
    /// within which [`Run::advance_to`] has stopped. The name of the event is `change`.
    ///
    /// # Errors
    /// That of the handler, or of a state, an input or a parameter that is not acceptable. The
    /// state is then as before.
    pub fn change<R>(
        &mut self,
        handler: impl FnOnce(&mut Event<'_, P::Number, P::Mechanism>) -> R,
    ) -> Result<(), Failed<P>>
    where
        R: IntoFlow,
        R::Failure: Into<Fault>,
    {
        let mut handler = Some(handler);
        let mut handler = |event: &mut Event<'_, P::Number, P::Mechanism>| {
            let flow = handler.take().map(|handler| handler(event).into_flow());
            let flow = flow.unwrap_or(Ok(core::ops::ControlFlow::Continue(())));
            flow.map_err(Into::into)
        };
        let stops = self.with_driver(|driver, way| {
            driver.leave_step(way)?;
            driver.change(&mut handler, &mut way.at)
        })?;
        self.is_over |= stops;
        Ok(())
    }

    /// What the run has come to so far, with its warnings. `worst_violation` is that of the state
    /// that was reached.
    #[must_use]
    pub fn report(&mut self) -> RunReport<P::Number, P::Mechanism> {
        let violation = self.sample().violation();
        let stopped = self.is_over && self.way.at.time < self.course.hybrid.end;
        let (driver, way) = self.driver();
        RunReport {
            worst_violation: violation,
            stopped,
            ..driver.report(way.leg.under_way.as_ref(), way.at)
        }
    }

    fn driver(&mut self) -> OnTheWay<'_, P> {
        let driver = Driver {
            march: &mut self.march,
            list: &mut self.happenings,
            switching: self.switching.as_mut(),
            stabilisation: self.setup.stabilisation(),
            breaks: self.setup.breaks,
            course: &mut self.course,
        };
        (driver, &mut self.way)
    }

    /// Does something with the driver, and says what it knows of the cause of a fault.
    fn with_driver<T>(
        &mut self,
        task: impl FnOnce(
            &mut Driver<'_, P::Number, P::Mechanism>,
            &mut Way<P::Number, P::Mechanism>,
        ) -> Result<T, Fault>,
    ) -> Result<T, Failed<P>> {
        let (mut driver, way) = self.driver();
        task(&mut driver, way).map_err(|fault| {
            driver.convert(&mut way.at);
            failed(driver.explained(fault, way.at), &way.at)
        })
    }
}
