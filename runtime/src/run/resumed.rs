//! A run that goes on from a checkpoint.

use crate::error::{CheckpointFault, Fault};
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::run::observed::Observed;
use crate::run::past::Past;
use crate::run::remembered::refused;

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
    /// Takes over what was counted, and what events, interactions and the monitor remember; where
    /// (s) the integration goes on.
    pub(crate) fn take_past(
        &mut self,
        past: &Past<'_, S, M>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<S, Fault> {
        let remembered = self.remember(past);
        remembered.map_err(|fault| self.driver.explained(fault, *last_good))?;
        if let Some(segment) = &past.segment {
            return Ok(segment.start);
        }
        if self.driver.go_on_with_events(last_good)? {
            self.log.stop();
        }
        Ok(last_good.time)
    }

    fn remember(&mut self, past: &Past<'_, S, M>) -> Result<(), Fault> {
        self.driver.begin_interactions()?;
        if !past
            .events
            .read(|memory| self.driver.remember_between(memory))
        {
            return Err(refused(CheckpointFault::Happenings));
        }
        self.driver.hold();
        let progress = &past.progress;
        self.driver.course.steps = progress.steps;
        self.driver.course.counts = progress.counts;
        self.driver.course.unseen = progress.unseen;
        self.log.worst_violation = progress.worst_violation;
        let (time, state) = past.at.borrowed();
        #[cfg(feature = "std")]
        self.begin_records(time, false);
        if past.segment.is_none() {
            self.driver.check_rates(Some((time, state)), past)?;
        }
        let equations = self.driver.march.equations_mut();
        if let Some(monitor) = &mut self.driver.course.monitor {
            match past.monitor {
                Some((kept, seen)) => {
                    *monitor = *kept;
                    equations.recall(seen);
                }
                None => equations.begin(monitor, time, state),
            }
        }
        equations.recall_iterations(progress.iterations);
        Ok(())
    }
}
