//! The modes of interactions, between two segments of a run.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::checked::check_all;
use crate::nonsmooth::status::Tracked;
use crate::run::driver::Driver;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Begins all interactions anew, once their settings are accepted.
    pub(crate) fn begin_interactions(&mut self) -> Result<(), Fault> {
        let list = self.march.equations_mut().interactions_mut();
        check_all(list)?;
        list.iter_mut().for_each(Tracked::begin);
        Ok(())
    }

    /// Finds impulses and modes at an instant; whether the state was changed by impulses. `moved`
    /// where a handler may have.
    #[inline(always)]
    pub(crate) fn switch(
        &mut self,
        time: S,
        bodies: &mut M::State<S>,
        moved: bool,
    ) -> Result<bool, Fault> {
        if self.course.settings.interacts {
            self.switch_modes(time, bodies, moved)
        } else {
            Ok(false)
        }
    }

    #[inline(never)]
    fn switch_modes(
        &mut self,
        time: S,
        bodies: &mut M::State<S>,
        moved: bool,
    ) -> Result<bool, Fault> {
        let (equations, hybrid) = (self.march.equations_mut(), &mut self.course.hybrid);
        let list = equations.interactions();
        hybrid.changes.count(time, hybrid.longest, list)?;
        *bodies = equations.strike(time, bodies, moved)?;
        hybrid.is_fresh = true;
        let list = equations.interactions();
        let switches = |tracked: &Tracked<S, M>| tracked.mode() != tracked.status.before;
        hybrid.is_switched |= list.iter().any(switches);
        let now = |tracked: &Tracked<S, M>| {
            let impact = tracked.status.impact;
            impact.is_some_and(|impact| impact.time == time)
        };
        Ok(list.iter().any(now))
    }
}
