//! A checkpoint of a run under way.

use core::ops::ControlFlow;
use std::format;
use std::string::ToString as _;
use std::vec::Vec;

use super::{Checkpoint, Kept, Segment};
use crate::dynamics::Dynamics;
use crate::error::{CheckpointFault, Fault};
use crate::formulation::Formulation;
use crate::integrate::{Integration, Integrator, System as _};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::run::events::list::Hybrid;
use crate::run::past::Progress;
use crate::run::segments::{Begun, Run};
use crate::state::vector::Vector;

/// An integration under way, with its start; `None` between two of them.
type UnderWay<'u, K, S, X> = Option<(&'u mut K, &'u Begun<S, X>)>;

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Whether checkpoints are kept.
    pub(crate) fn keeps(&self) -> bool {
        self.hybrid
            .as_ref()
            .is_some_and(|hybrid| hybrid.keeps.is_some())
    }

    /// Whether a checkpoint is to be kept after this step.
    pub(crate) fn keeps_now(&self) -> bool {
        let steps = self.hybrid.as_ref().and_then(|hybrid| hybrid.keeps);
        steps.is_some_and(|steps| self.steps.is_multiple_of(steps))
    }

    /// Hands a checkpoint to those whose turn it is; at the end of the run to all.
    pub(crate) fn keep<I, K>(
        &mut self,
        integrator: &I,
        under_way: UnderWay<'_, K, S, C::State<S>>,
        &(time, ref state): &(S, M::State<S>),
    ) -> Result<(), Fault>
    where
        I: Integrator<S, Dynamics<S, M, F, A, C>>,
        K: Integration<S, C::State<S>>,
    {
        let Some(mut hybrid) = self.hybrid.take() else {
            return Ok(());
        };
        let checkpoint = self.checkpoint(integrator, under_way, (time, state), &mut hybrid)?;
        let (steps, is_end) = (self.steps, time >= hybrid.end);
        let mut stops = false;
        hybrid.list.each(&mut |happening| {
            let is_due = |every: usize| is_end || steps.is_multiple_of(every);
            if happening.steps_to_keep().is_some_and(is_due) {
                let flow = happening.keep(&checkpoint)?;
                stops |= matches!(flow, ControlFlow::Break(()));
            }
            Ok(())
        })?;
        if stops && !is_end {
            self.log.stop();
        }
        self.hybrid = Some(hybrid);
        Ok(())
    }

    fn checkpoint<I, K>(
        &mut self,
        integrator: &I,
        under_way: UnderWay<'_, K, S, C::State<S>>,
        (time, state): (S, &M::State<S>),
        hybrid: &mut Hybrid<'_, S, M>,
    ) -> Result<Checkpoint<M, S>, Fault>
    where
        I: Integrator<S, Dynamics<S, M, F, A, C>>,
        K: Integration<S, C::State<S>>,
    {
        let (seen, iterations) = (self.dynamics.seen(), self.dynamics.iterations());
        let of_integration = match &under_way {
            Some((integration, _)) => *integration.state(),
            None => self.dynamics.nearest(state),
        };
        let rates = self.dynamics.rates(time, &of_integration)?;
        self.dynamics.recall(seen);
        self.dynamics.iterations = iterations;
        let segment = under_way.map(|(integration, begun)| {
            let (memory, is_kept) = Kept::of(|memory| integration.remember(memory));
            is_kept.then(|| Segment {
                start: begun.start,
                state: elements(&begun.state),
                of_monitor: begun.of_monitor,
                memory,
            })
        });
        let Some(segment) = segment.map_or(Some(None), |kept| kept.map(Some)) else {
            return Err(Fault::Checkpoint(CheckpointFault::Forgetful));
        };
        let (interval, reporting, reports) = self.schedule.parts();
        let (events, ()) = Kept::of(|memory| {
            hybrid.remember(self.dynamics.tracked(), memory);
            if !M::SEPARATIONS.is_empty() {
                self.passing.remember(memory);
            }
            if Dynamics::<S, M, F, A, C>::CLOSES {
                self.branching.remember(memory, &mut self.dynamics.near);
            }
        });
        let mut warnings = hybrid.former.clone();
        if let Some(mut monitor) = self.monitor {
            self.dynamics.name_smallest_pivot(&mut monitor);
            monitor.end(self.dynamics.constants(), time, state);
            let found = monitor.warnings().into_iter();
            warnings.extend(found.map(|warning| warning.to_string()));
        }
        Ok(Checkpoint {
            method: format!("{integrator:?}"),
            formulation: format!("{:?}", self.dynamics.formulation()),
            joints: C::IS_RELATIVE,
            interval,
            reporting,
            time,
            state: *state,
            given: hybrid.given,
            taken: hybrid.taken,
            present: *self.dynamics.parameters(),
            progress: Progress {
                steps: self.steps,
                reports,
                unseen: self.log.unseen,
                counts: self.counts,
                iterations,
                worst_violation: self.log.worst_violation,
            },
            rates: elements(&rates),
            segment,
            events,
            monitor: self.monitor.map(|monitor| (monitor, seen)),
            warnings,
        })
    }
}

fn elements<S: Real, X: Vector<S>>(vector: &X) -> Vec<S> {
    let mut elements = Vec::with_capacity(vector.length());
    vector.for_each(|element| elements.push(element));
    elements.extend_from_slice(vector.turns());
    elements
}
