//! The modes of interactions, between two segments of a run.

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::status::Tracked;
use crate::run::events::list::Hybrid;
use crate::run::segments::Run;

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Begins all interactions anew, once their settings are accepted.
    pub(crate) fn begin_interactions(&self) -> Result<(), Fault> {
        let dynamics: &Dynamics<S, M, F, A, C> = &self.dynamics;
        for tracked in dynamics.tracked() {
            tracked.interaction.check()?;
            tracked.begin();
        }
        Ok(())
    }

    /// Finds impulses and modes at an instant; whether the state was changed by impulses. `moved`
    /// where a handler may have.
    #[inline(always)]
    pub(crate) fn switch(
        &self,
        hybrid: &mut Hybrid<'_, S, M>,
        time: S,
        bodies: &mut M::State<S>,
        moved: bool,
    ) -> Result<bool, Fault> {
        if A::INTERACTS {
            self.switch_modes(hybrid, time, bodies, moved)
        } else {
            Ok(false)
        }
    }

    #[inline(never)]
    fn switch_modes(
        &self,
        hybrid: &mut Hybrid<'_, S, M>,
        time: S,
        bodies: &mut M::State<S>,
        moved: bool,
    ) -> Result<bool, Fault> {
        let dynamics = &self.dynamics;
        hybrid
            .changes
            .count(time, hybrid.longest, dynamics.tracked())?;
        let mut state = dynamics.nearest(bodies);
        if !moved && let Some(held) = dynamics.held(time, &state)? {
            state = held;
        }
        let next = dynamics.switched(time, &state, moved)?;
        *bodies = dynamics.bodies_near(&next, bodies);
        hybrid.is_fresh = true;
        hybrid.is_switched |= dynamics.tracked().iter().any(|tracked| {
            let status = tracked.status.get();
            status.mode != status.before
        });
        let now = |tracked: &Tracked<S, M>| {
            let impact = tracked.status.get().impact;
            impact.is_some_and(|impact| impact.time == time)
        };
        Ok(dynamics.tracked().iter().any(now))
    }
}
