//! What happens in a run: conditions with their handlers, and controllers.

use core::ops::ControlFlow;

use crate::error::setting::positive;
use crate::error::{Fault, StepFault};
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
#[cfg(feature = "std")]
use crate::run::checkpoint::Checkpoint;
use crate::run::events::changes::Changes;
use crate::run::events::context::Event;
use crate::run::output::IntoFlow;
use crate::run::past::Past;
use crate::run::sample::Sample;
#[cfg(feature = "std")]
use crate::run::trajectory::Trajectory;
use crate::stepping::watch::{Period, Watch};

/// Of what an instant between two integrations calls.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub enum Phase<S> {
    /// Handlers of the events that pass their zeros at a time (s): at the instant, or by its
    /// round-off before it.
    Handlers(S),
    /// Handlers at given times, behind those of events.
    Times,
    /// Relays that begin, or that a handler has taken past their next threshold.
    Relays,
    /// Controllers, behind all handlers.
    Controllers,
}

/// Something that happens in a run.
#[doc(hidden)]
pub trait Happening<S: Real, M: Mechanism> {
    /// Checks its setting at the start (s) of a run, and forgets the run before.
    ///
    /// # Errors
    /// Of a setting that is not acceptable.
    fn begin(&mut self, _start: S) -> Result<(), Fault> {
        Ok(())
    }

    /// Whether it is called in a phase of an instant (s), and by what name. It counts the call.
    fn due(&mut self, _time: S, _phase: Phase<S>) -> Option<&'static str> {
        None
    }

    /// The condition of an event.
    fn watch(&mut self) -> Option<&mut Watch<S>> {
        None
    }

    /// The period of a controller.
    fn period(&mut self) -> Option<&mut Period<S>> {
        None
    }

    /// The next of the times (s) at which a handler is called, and its name.
    fn next_time(&self) -> Option<(S, &'static str)> {
        None
    }

    /// After how many steps a checkpoint is kept.
    fn steps_to_keep(&self) -> Option<usize> {
        None
    }

    /// Takes a checkpoint.
    ///
    /// # Errors
    /// That of the closure.
    #[cfg(feature = "std")]
    fn keep(&mut self, _checkpoint: &Checkpoint<M, S>) -> Result<ControlFlow<()>, Fault> {
        Ok(ControlFlow::Continue(()))
    }

    /// Whether it records the motion.
    fn records(&self) -> bool {
        false
    }

    /// Shows the trajectory that is recorded.
    #[cfg(feature = "std")]
    fn record(&mut self, _visit: &mut dyn FnMut(&mut Trajectory<M, S>)) {}

    /// The reading of an event.
    fn read(&self, _sample: &Sample<'_, S, M>) -> S {
        S::zero()
    }

    /// Hands over what it remembers between two steps, besides its watch and its period.
    fn remember(&mut self, _memory: &mut Memory<'_, S>) {}

    /// Calls the handler or the controller, where it is due.
    ///
    /// # Errors
    /// That of the closure.
    fn act(&mut self, _event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> {
        Ok(ControlFlow::Continue(()))
    }
}

/// What is done with everything that happens.
#[doc(hidden)]
pub(crate) type Visit<'v, S, M> = dyn FnMut(&mut dyn Happening<S, M>) -> Result<(), Fault> + 'v;

/// What happens in a run of a [`Simulation`](crate::Simulation), in the order in
/// which it was given.
pub trait Happenings<S: Real, M: Mechanism> {
    /// Goes through it.
    ///
    /// # Errors
    /// The first fault of the visit.
    #[doc(hidden)]
    fn each(&mut self, visit: &mut Visit<'_, S, M>) -> Result<(), Fault>;
}

/// No events and no controllers.
#[derive(Clone, Copy, Debug, Default)]
pub struct NothingHappens;

impl<S: Real, M: Mechanism> Happenings<S, M> for NothingHappens {
    fn each(&mut self, _visit: &mut Visit<'_, S, M>) -> Result<(), Fault> {
        Ok(())
    }
}

impl<S: Real, M: Mechanism, E: Happenings<S, M>, H: Happening<S, M>> Happenings<S, M> for (E, H) {
    fn each(&mut self, visit: &mut Visit<'_, S, M>) -> Result<(), Fault> {
        self.0.each(visit)?;
        visit(&mut self.1)
    }
}

/// A condition with its handler, see [`Simulation::on`](crate::Simulation::on).
#[derive(Clone, Debug)]
pub struct Handled<S, G, H> {
    pub(super) watch: Watch<S>,
    pub(super) reading: G,
    pub(super) handler: H,
}

impl<S, M, G, H, R> Happening<S, M> for Handled<S, G, H>
where
    S: Real,
    M: Mechanism,
    G: Fn(&Sample<'_, S, M>) -> S,
    H: FnMut(&mut Event<'_, S, M>) -> R,
    R: IntoFlow,
    R::Failure: Into<Fault>,
{
    fn due(&mut self, _time: S, phase: Phase<S>) -> Option<&'static str> {
        let root = self.watch.root()?;
        (phase == Phase::Handlers(root)).then(|| self.watch.name())
    }

    fn watch(&mut self) -> Option<&mut Watch<S>> {
        Some(&mut self.watch)
    }

    fn read(&self, sample: &Sample<'_, S, M>) -> S {
        (self.reading)(sample)
    }

    fn act(&mut self, event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> {
        (self.handler)(event).into_flow().map_err(Into::into)
    }
}

/// A controller with its period, see
/// [`Simulation::every_period`](crate::Simulation::every_period).
#[derive(Clone, Debug)]
pub struct Controlled<S, K> {
    pub(super) period: Period<S>,
    pub(super) controller: K,
}

impl<S, M, K, R> Happening<S, M> for Controlled<S, K>
where
    S: Real,
    M: Mechanism,
    K: FnMut(&Sample<'_, S, M>, &mut M::Inputs<S>) -> R,
    R: IntoFlow,
    R::Failure: Into<Fault>,
{
    fn due(&mut self, time: S, phase: Phase<S>) -> Option<&'static str> {
        let is_due = phase == Phase::Controllers && self.period.is_due(time);
        is_due.then_some("")
    }

    fn period(&mut self) -> Option<&mut Period<S>> {
        Some(&mut self.period)
    }

    fn act(&mut self, event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> {
        let (sample, inputs) = event.sample_and_inputs();
        let flow = (self.controller)(sample, inputs);
        flow.into_flow().map_err(Into::into)
    }
}

/// What happens in a run under way.
pub(crate) struct Hybrid<S: Real, M: Mechanism> {
    /// Whether nothing can happen.
    pub(crate) is_empty: bool,
    /// Inputs that are held.
    pub(crate) inputs: M::Inputs<S>,
    /// Parameters and inputs at the start of the run, and those that a handler has set last.
    #[cfg_attr(
        not(feature = "std"),
        expect(dead_code, reason = "checkpoints and trajectories need a heap")
    )]
    pub(crate) given: M::Parameters<S>,
    pub(crate) taken: Option<M::Parameters<S>>,
    /// After how many steps, at the most, a checkpoint may be due.
    pub(crate) keeps: Option<usize>,
    /// Whether the motion is recorded.
    pub(crate) records: bool,
    /// Warnings from before a restart from a file.
    #[cfg(feature = "std")]
    pub(crate) former: std::vec::Vec<std::string::String>,
    /// Whether states that handlers set may violate the constraints.
    pub(crate) accepts_any_state: bool,
    /// The end of the run (s).
    pub(crate) end: S,
    /// The longest step so far (s).
    pub(crate) longest: S,
    /// Whether there are conditions.
    pub(crate) watches: bool,
    /// Whether a segment begins where readings may be at zero.
    pub(crate) is_fresh: bool,
    /// Whether the last step ended at an event or at the end of a mode.
    pub(crate) is_found: bool,
    /// The first event in the list of those that were found.
    pub(crate) event: Option<&'static str>,
    /// Whether modes of interactions have changed at this instant.
    pub(crate) is_switched: bool,
    /// How often modes of interactions changed at once.
    pub(crate) changes: Changes<S>,
}

impl<S: Real, M: Mechanism> Hybrid<S, M> {
    /// Begins a run over an interval (s) with parameters and inputs.
    pub(crate) fn new(
        list: &mut dyn Happenings<S, M>,
        given: &M::Parameters<S>,
        accepts_any_state: bool,
        (start, end): (S, S),
    ) -> Result<Self, Fault> {
        let (mut watches, mut records, mut keeps) = (false, false, None);
        list.each(&mut |happening| {
            happening.begin(start)?;
            if let Some(steps) = happening.steps_to_keep() {
                positive("steps between checkpoints", steps as f64)?;
                keeps = Some(keeps.map_or(steps, |other| common(steps, other)));
            }
            watches |= happening.watch().is_some();
            records |= happening.records();
            let Some(period) = happening.period() else {
                return Ok(());
            };
            positive("period", period.period)?;
            let latest = start.abs().max(end.abs());
            if period.period < S::constant(64.0) * latest.ulp() {
                return Err(Fault::Step(StepFault::TooShort {
                    step: period.period.to_f64(),
                    time: latest.to_f64(),
                }));
            }
            period.begin(start);
            Ok(())
        })?;
        Ok(Self {
            is_empty: false,
            inputs: M::inputs_of(given),
            given: *given,
            taken: None,
            keeps,
            records,
            #[cfg(feature = "std")]
            former: std::vec::Vec::new(),
            accepts_any_state,
            end,
            longest: S::zero(),
            watches,
            is_fresh: true,
            is_found: false,
            event: None,
            is_switched: false,
            changes: Changes::none(),
        })
    }

    /// Whether somebody keeps checkpoints or records the motion.
    pub(crate) fn is_observed(&self) -> bool {
        self.keeps.is_some() || self.records
    }

    /// The same of a run that goes on.
    pub(crate) fn resumed(mut self, past: &Past<'_, S, M>) -> Self {
        self.inputs = M::inputs_of(past.present);
        self.taken = past.taken.copied();
        #[cfg(feature = "std")]
        if past.monitor.is_none() {
            self.former = past.warnings.to_vec();
        }
        self
    }
}

/// The largest number of which both are multiples.
fn common(mut a: usize, mut b: usize) -> usize {
    while b > 0 {
        (a, b) = (b, a % b);
    }
    a
}
