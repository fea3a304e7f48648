//! What happens in a run: conditions with their handlers, and controllers.

use core::ops::ControlFlow;

use crate::error::Fault;
use crate::error::setting::positive;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::run::events::changes::Changes;
use crate::run::events::context::Event;
use crate::run::events::watch::{Period, Watch, is_same};
use crate::run::output::IntoFlow;
use crate::run::sample::Sample;

/// Something that happens in a run.
#[doc(hidden)]
pub trait Happening<S: Real, M: Mechanism> {
    /// The condition of an event.
    fn watch(&mut self) -> Option<&mut Watch<S>> {
        None
    }

    /// The period of a controller.
    fn period(&mut self) -> Option<&mut Period<S>> {
        None
    }

    /// The reading of an event.
    fn read(&self, _sample: &Sample<'_, S, M>) -> S {
        S::zero()
    }

    /// Calls the handler or the controller.
    ///
    /// # Errors
    /// That of the closure.
    fn act(&mut self, event: &mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault>;
}

/// What is done with everything that happens.
#[doc(hidden)]
pub(crate) type Visit<'v, S, M> = dyn FnMut(&mut dyn Happening<S, M>) -> Result<(), Fault> + 'v;

/// What happens in a run of a [`HybridSimulation`](crate::run::HybridSimulation), in the order in
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
pub(crate) struct Hybrid<'h, S: Real, M: Mechanism> {
    pub(super) list: &'h mut (dyn Happenings<S, M> + 'h),
    /// Inputs that are held.
    pub(super) inputs: M::Inputs<S>,
    /// Whether states that handlers set may violate the constraints.
    pub(super) accepts_any_state: bool,
    /// The end of the run (s).
    pub(super) end: S,
    /// The longest step so far (s).
    pub(super) longest: S,
    /// Whether there are conditions.
    pub(super) watches: bool,
    /// Whether a segment begins where readings may be at zero.
    pub(super) is_fresh: bool,
    /// Whether the last step ended at an event.
    pub(super) is_found: bool,
    /// How often modes of interactions changed at once.
    pub(super) changes: Changes<S>,
}

impl<'h, S: Real, M: Mechanism> Hybrid<'h, S, M> {
    /// Begins a run over an interval (s) with the inputs of the mechanism.
    pub(crate) fn new(
        list: &'h mut (dyn Happenings<S, M> + 'h),
        inputs: M::Inputs<S>,
        accepts_any_state: bool,
        (start, end): (S, S),
    ) -> Result<Self, Fault> {
        let mut watches = false;
        list.each(&mut |happening| {
            watches |= happening.watch().is_some();
            let Some(period) = happening.period() else {
                return Ok(());
            };
            positive("period", period.period)?;
            let latest = start.abs().max(end.abs());
            if period.period < S::constant(64.0) * latest.ulp() {
                return Err(Fault::StepTooShort {
                    step: period.period.to_f64(),
                    time: latest.to_f64(),
                });
            }
            period.begin(start);
            Ok(())
        })?;
        Ok(Self {
            list,
            inputs,
            accepts_any_state,
            end,
            longest: S::zero(),
            watches,
            is_fresh: true,
            is_found: false,
            changes: Changes::none(),
        })
    }

    /// The next instant (s) of a controller up to a time.
    pub(crate) fn next_instant(&mut self, until: S) -> S {
        let mut next = until;
        let _ = self.list.each(&mut |happening| {
            if let Some(period) = happening.period()
                && period.next() < next
                && !is_same(period.next(), until)
            {
                next = period.next();
            }
            Ok(())
        });
        next
    }
}
