//! Steps of a fixed size that lead beyond where the friction of their modes has an effort.
//!
//! They are tried again, of half their length, up to the end of a mode or to where friction jams.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::jam::{begin_step, end_step, may_be_beyond};
use crate::nonsmooth::status::Tracked;
use crate::run::driver::Driver;
use crate::stepping::marching::Advanced;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Knows the efforts at the start of an integration, where capacities may have jumped.
    pub(super) fn know_factors(&mut self, at: &StateAt<S, M>) -> Result<(), Fault> {
        let equations = self.march.equations_mut();
        let slips = equations
            .interactions()
            .iter()
            .any(Tracked::slips_on_contact);
        if slips && equations.scales_capacities() {
            let seen = equations.seen();
            equations.keep_efforts(at.time, &at.bodies)?;
            equations.recall(seen);
        }
        Ok(())
    }

    /// Takes the next step of the integration under way.
    #[inline(always)]
    pub(super) fn advance(&mut self) -> Result<Advanced<S>, Fault> {
        if !self.course.settings.interacts {
            return self.march.advance();
        }
        begin_step(self.march.equations_mut().interactions_mut());
        let advanced = self.march.advance();
        end_step(self.march.equations_mut().interactions_mut());
        advanced
    }

    /// Whether the last step ends where friction of its modes has an effort, as its interpolant
    /// asks for.
    #[inline]
    pub(super) fn ends_within_modes(&mut self, end: S, near: &M::State<S>) -> Result<(), Fault> {
        let list = self.march.equations().interactions();
        if list.iter().any(Tracked::slips_on_contact) {
            self.march.at(end, near)?;
        }
        Ok(())
    }

    /// Whether a step that has failed, of so many seconds at the most, is tried again, of half its
    /// length. A method that controls its error has tried that.
    #[cold]
    pub(super) fn halves(&mut self, fault: &Fault, time: S, step: S) -> bool {
        let step = self.course.passing.limit.unwrap_or(step).min(step);
        let is_fixed = self.course.settings.fixed_step.is_some();
        is_fixed && may_be_beyond(fault) && self.course.passing.halve(time, step)
    }
}
