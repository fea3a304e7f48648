//! A run that goes on from a checkpoint.

use crate::dynamics::Dynamics;
use crate::error::{CheckpointFault, Fault};
use crate::formulation::Formulation;
use crate::integrate::{Advance, Memory, System as _};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::run::past::{Numbers, Past, PastSegment, vector};
use crate::run::segments::{Begun, Run};
use crate::run::worked::begin_to_watch;
use crate::state::vector::{Array, Vector};

/// By how much rates may differ from those of the run, relative to their size: another processor
/// rounds in another way.
const SAME_RATES: f64 = 1e-6;

/// Elements smaller than this part of the largest one are as large as this.
const LITTLE: f64 = 1e-6;

fn refused(fault: CheckpointFault) -> Fault {
    Fault::Checkpoint(fault)
}

/// Puts the parameters and inputs of a run in place; refused where it had begun with others.
pub(crate) fn take_values<S, M, F, A, C>(
    dynamics: &mut Dynamics<S, M, F, A, C>,
    past: &Past<'_, S, M>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let values = dynamics.parameters().as_slice().iter();
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
        dynamics.take_parameters(taken)?;
    }
    if past.present != dynamics.parameters() {
        dynamics.set_inputs(&M::inputs_of(past.present))?;
    }
    Ok(())
}

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Takes over what was counted, and what events, interactions and the monitor remember.
    pub(crate) fn take_past(&mut self, past: &Past<'_, S, M>) -> Result<(), Fault> {
        self.begin_interactions()?;
        let (list, mut near) = (self.dynamics.tracked(), self.dynamics.near);
        let branching = &mut self.branching;
        let mut remember_branches = |memory: &mut Memory<'_, S>| {
            if Dynamics::<S, M, F, A, C>::CLOSES {
                branching.remember(memory, &mut near);
            }
        };
        let is_whole = match &mut self.hybrid {
            Some(hybrid) => past.events.read(|memory| {
                hybrid.remember(list, memory);
                if !M::SEPARATIONS.is_empty() {
                    self.passing.remember(memory);
                }
                remember_branches(memory);
            }),
            None => past.events.read(remember_branches),
        };
        self.dynamics.near = near;
        if !is_whole {
            return Err(refused(CheckpointFault::Happenings));
        }
        if let Some(hybrid) = self.hybrid.take() {
            self.hold(&hybrid);
            self.hybrid = Some(hybrid);
        }
        let progress = &past.progress;
        self.steps = progress.steps;
        self.counts = progress.counts;
        self.log.unseen = progress.unseen;
        self.log.worst_violation = progress.worst_violation;
        let (time, state) = &past.at;
        #[cfg(feature = "std")]
        self.begin_records(*time, false);
        if past.segment.is_none() {
            let of_integration = self.dynamics.nearest(state);
            self.check_rates(*time, &of_integration, past)?;
        }
        if let Some(monitor) = &mut self.monitor {
            match past.monitor {
                Some((kept, seen)) => {
                    *monitor = *kept;
                    self.dynamics.recall(seen);
                }
                None => self.dynamics.begin(monitor, *time, state),
            }
        }
        self.dynamics.iterations = progress.iterations;
        Ok(())
    }

    /// The start of the integration that was under way.
    pub(crate) fn begun(past: &PastSegment<'_, S>) -> Result<Begun<S, C::State<S>>, Fault> {
        let state = vector(past.state).ok_or_else(|| refused(CheckpointFault::Memory))?;
        Ok(Begun {
            start: past.start,
            state,
            of_monitor: past.of_monitor,
        })
    }

    /// Makes an integration that was begun anew the one that was under way.
    pub(crate) fn go_on<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        memory: Numbers<'_, S>,
        past: &Past<'_, S, M>,
    ) -> Result<(), Fault> {
        let mut is_kept = false;
        let is_whole = memory.read(|memory| is_kept = integration.remember(memory));
        if !is_kept {
            return Err(refused(CheckpointFault::Forgetful));
        }
        let (time, state) = &past.at;
        if !is_whole || integration.time() != *time {
            return Err(refused(CheckpointFault::Memory));
        }
        let seen = self.dynamics.seen();
        self.check_rates(*time, integration.state(), past)?;
        if let Some(monitor) = &mut self.monitor {
            if past.monitor.is_none() {
                monitor.restart();
                let of_integration = integration.state();
                begin_to_watch(monitor, &mut self.dynamics, (*time, of_integration), state);
            } else {
                self.dynamics.recall(seen);
            }
        }
        self.dynamics.iterations = past.progress.iterations;
        Ok(())
    }

    /// Refuses a checkpoint of other rates than those at hand.
    fn check_rates(
        &mut self,
        time: S,
        state: &C::State<S>,
        past: &Past<'_, S, M>,
    ) -> Result<(), Fault> {
        let kept: C::State<S> =
            vector(past.rates).ok_or_else(|| refused(CheckpointFault::Memory))?;
        let rates = self.dynamics.rates(time, state)?;
        let mut largest = S::zero();
        rates.for_each(|rate| largest = largest.max(rate.abs()));
        let (mut difference, floor) = (S::zero(), S::constant(LITTLE) * largest);
        let apart = rates.zip(&kept, |found, kept| {
            let size = found.abs().max(kept.abs()).max(floor);
            if found == kept {
                S::zero()
            } else {
                (found - kept).abs().quotient(size)
            }
        });
        apart.for_each(|apart| difference = difference.max(apart));
        if difference <= S::constant(SAME_RATES) {
            return Ok(());
        }
        Err(refused(CheckpointFault::Rates {
            difference: difference.to_f64(),
        }))
    }
}
