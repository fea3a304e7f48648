//! A checkpoint of a run under way.

use core::ops::ControlFlow;
use std::format;
use std::string::ToString as _;
use std::vec::Vec;

use super::{Checkpoint, Kept, Segment};
use crate::error::{CheckpointFault, Fault};
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::leg::Begun;
use crate::run::observed::Observed;
use crate::run::past::Progress;

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
    /// Whether checkpoints are kept.
    pub(crate) fn keeps(&self) -> bool {
        self.driver.course.hybrid.keeps.is_some()
    }

    /// Whether a checkpoint is to be kept after this step.
    pub(crate) fn keeps_now(&self) -> bool {
        let steps = self.driver.course.hybrid.keeps;
        steps.is_some_and(|steps| self.driver.course.steps.is_multiple_of(steps))
    }

    /// Hands a checkpoint to those whose turn it is; at the end of the run to all. `None` between
    /// two integrations.
    pub(crate) fn keep(
        &mut self,
        under_way: Option<&Begun<S>>,
        &At {
            time,
            bodies: ref state,
        }: &StateAt<S, M>,
    ) -> Result<(), Fault> {
        let checkpoint = self.checkpoint(under_way, (time, state))?;
        let (steps, mut stops) = (self.driver.course.steps, false);
        let is_end = time >= self.driver.course.hybrid.end;
        self.driver.list.each(&mut |happening| {
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
        Ok(())
    }

    fn checkpoint(
        &mut self,
        under_way: Option<&Begun<S>>,
        (time, state): (S, &M::State<S>),
    ) -> Result<Checkpoint<M, S>, Fault> {
        let (given, taken) = (
            self.driver.course.hybrid.given,
            self.driver.course.hybrid.taken,
        );
        let mut warnings = self.driver.course.hybrid.former.clone();
        let equations = self.driver.march.equations();
        let (seen, iterations) = (equations.seen(), equations.iterations());
        if let Some(mut monitor) = self.driver.course.monitor {
            equations.name_smallest_pivot(&mut monitor);
            monitor.end(equations.constants(), time, state);
            let found = monitor.warnings().into_iter();
            warnings.extend(found.map(|warning| warning.to_string()));
        }
        let mut rates = Vec::new();
        let between = under_way.is_none().then_some((time, state));
        self.driver
            .march
            .visit_rates(between, &mut |rate| rates.push(rate))?;
        let segment = under_way.map(|begun| self.segment_of(begun)).transpose()?;
        let (events, ()) = Kept::of(|memory| self.driver.remember_between(memory));
        let (interval, reporting, reports) = self.schedule.parts();
        let equations = self.driver.march.equations();
        Ok(Checkpoint {
            method: format!("{:?}", self.driver.march.method()),
            formulation: format!("{:?}", equations.formulation()),
            joints: equations.is_relative(),
            interval,
            reporting,
            time,
            state: *state,
            given,
            taken,
            present: *equations.parameters(),
            progress: Progress {
                steps: self.driver.course.steps,
                reports,
                unseen: self.driver.course.unseen,
                counts: self.driver.course.counts,
                iterations,
                worst_violation: self.log.worst_violation,
            },
            rates,
            segment,
            events,
            monitor: self.driver.course.monitor.map(|monitor| (monitor, seen)),
            warnings,
        })
    }

    /// The integration under way.
    fn segment_of(&mut self, begun: &Begun<S>) -> Result<Segment<S>, CheckpointFault> {
        let (memory, is_kept) = Kept::of(|memory| self.driver.march.remember(memory));
        if !is_kept {
            return Err(CheckpointFault::Forgetful);
        }
        let mut state = Vec::new();
        self.driver
            .march
            .visit_start(&mut |element| state.push(element));
        Ok(Segment {
            start: begun.start,
            state,
            of_monitor: begun.of_monitor,
            memory,
        })
    }
}
