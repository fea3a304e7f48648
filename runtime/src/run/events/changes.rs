//! How often modes of interactions change at once.

use crate::error::{Fault, ModeFault};
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::status::Tracked;

/// At once: within this part of the longest step of the run, or so many units in the last place.
const MOMENT: f64 = 1e-9;
const SAME: f64 = 64.0;

/// How often modes may change at once, besides what each interaction may.
const AT_ONCE: usize = 16;
const OF_EACH: usize = 8;

/// How often they did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Changes<S> {
    last: Option<S>,
    at_once: usize,
}

impl<S: Real> Changes<S> {
    pub(crate) fn none() -> Self {
        Self {
            last: None,
            at_once: 0,
        }
    }

    /// Hands over what it has counted.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        memory.optional(&mut self.last);
        memory.count(&mut self.at_once);
    }

    /// Counts the end of a mode.
    pub(super) fn count<M: Mechanism>(
        &mut self,
        time: S,
        longest: S,
        list: &[Tracked<S, M>],
    ) -> Result<(), Fault> {
        let Some(found) = list.iter().find(|tracked| tracked.status.is_found) else {
            return Ok(());
        };
        let moment = (S::constant(MOMENT) * longest).max(S::constant(SAME) * time.ulp());
        let at_once = self.last.is_some_and(|last| time - last <= moment);
        self.at_once = if at_once { self.at_once + 1 } else { 0 };
        self.last = Some(time);
        if self.at_once > AT_ONCE + OF_EACH * list.len() {
            return Err(Fault::Mode(ModeFault::Endless {
                joint: found.interaction.name(),
                changes: self.at_once,
                time: time.to_f64(),
            }));
        }
        Ok(())
    }
}
