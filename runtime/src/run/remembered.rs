//! What a driver remembers between two steps, and how it goes on with it.

use crate::dynamics::equations::Equations;
use crate::error::{CheckpointFault, Fault};
use crate::integrate::{Memory, TimeSpan};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;
use crate::run::leg::Begun;
use crate::run::past::{Past, PastSegment};
use crate::run::worked::begin_to_watch;
use crate::state::vector::Array;

/// By how much rates may differ from those of the run, relative to their size: another processor
/// rounds in another way.
const SAME_RATES: f64 = 1e-6;

pub(super) fn refused(fault: CheckpointFault) -> Fault {
    Fault::Checkpoint(fault)
}

/// Puts the parameters and inputs of a run in place; refused where it had begun with others.
pub(crate) fn take_values<S: Real, M: Mechanism>(
    equations: &mut dyn Equations<S, M>,
    past: &Past<'_, S, M>,
) -> Result<(), Fault> {
    let values = equations.parameters().as_slice().iter();
    let both = values.zip(past.given.as_slice());
    for ((found, kept), value) in both.zip(M::REPORT.values) {
        if found != kept {
            return Err(refused(CheckpointFault::Value {
                name: value.name,
                found: found.to_f64(),
                kept: kept.to_f64(),
            }));
        }
    }
    // In two steps, as in the run: so equations come out as they were.
    if let Some(&taken) = past.taken {
        equations.take_parameters(taken)?;
    }
    if past.present != equations.parameters() {
        equations.set_inputs(&M::inputs_of(past.present))?;
    }
    equations.renew_limits()
}

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Makes an integration that is begun anew the one that was under way.
    pub(crate) fn go_on(
        &mut self,
        (span, whole): (TimeSpan<S>, S),
        segment: &PastSegment<'_, S>,
        past: &Past<'_, S, M>,
    ) -> Result<Begun<S>, Fault> {
        if !self.march.start_again(span, whole, segment.state)? {
            return Err(refused(CheckpointFault::Memory));
        }
        let mut is_kept = false;
        let is_whole = { segment.memory }.read(|memory| is_kept = self.march.remember(memory));
        if !is_kept {
            return Err(refused(CheckpointFault::Forgetful));
        }
        let (time, state) = past.at.borrowed();
        if !is_whole || self.march.time() != time {
            return Err(refused(CheckpointFault::Memory));
        }
        let seen = self.march.equations().seen();
        self.check_rates(None, past)?;
        if let Some(monitor) = &mut self.course.monitor {
            if past.monitor.is_none() {
                monitor.restart();
                begin_to_watch(monitor, self.march, state);
            } else {
                self.march.equations_mut().recall(seen);
            }
        }
        let iterations = past.progress.iterations;
        self.march.equations_mut().recall_iterations(iterations);
        Ok(Begun {
            start: segment.start,
            of_monitor: segment.of_monitor,
        })
    }

    /// Hands over what is remembered between two steps, besides the integration and the monitor.
    pub(crate) fn remember_between(&mut self, memory: &mut Memory<'_, S>) {
        if !self.course.hybrid.is_empty {
            self.remember_happenings(memory);
            if !M::SEPARATIONS.is_empty() {
                self.course.passing.remember(memory);
            }
        }
        self.march.remember_branches(memory);
    }

    /// Hands over what events, controllers, interactions and laws that switch remember.
    fn remember_happenings(&mut self, memory: &mut Memory<'_, S>) {
        let interactions = self.march.equations_mut().interactions_mut();
        let hybrid = &mut self.course.hybrid;
        if hybrid.watches || self.switching.is_some() || !interactions.is_empty() {
            memory.number(&mut hybrid.longest);
            memory.flag(&mut hybrid.is_fresh);
        }
        if !interactions.is_empty() {
            hybrid.changes.remember(memory);
        }
        for tracked in interactions {
            tracked.remember(memory);
        }
        if let Some(switching) = &mut self.switching {
            switching.remember(memory);
        }
        let _ = self.list.each(&mut |happening| {
            if let Some(watch) = happening.watch() {
                watch.remember(memory);
            }
            if let Some(period) = happening.period() {
                period.remember(memory);
            }
            happening.remember(memory);
            Ok(())
        });
    }

    /// Refuses a checkpoint of other rates than those at hand: at the end of the last step, or of
    /// bodies between two integrations.
    pub(super) fn check_rates(
        &mut self,
        between: Option<(S, &M::State<S>)>,
        past: &Past<'_, S, M>,
    ) -> Result<(), Fault> {
        let difference = self.march.differs(between, past.rates)?;
        let difference = difference.ok_or_else(|| refused(CheckpointFault::Memory))?;
        if difference <= S::constant(SAME_RATES) {
            return Ok(());
        }
        Err(refused(CheckpointFault::Rates {
            difference: difference.to_f64(),
        }))
    }
}
