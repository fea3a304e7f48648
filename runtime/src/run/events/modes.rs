//! The modes of interactions, between two segments of a run.

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::quantity::Scene;
use crate::nonsmooth::status::Tracked;
use crate::run::events::list::Hybrid;
use crate::run::segments::Run;

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

    /// Counts the end of a mode.
    fn count<M: Mechanism>(
        &mut self,
        time: S,
        longest: S,
        list: &[Tracked<S, M>],
    ) -> Result<(), Fault> {
        let Some(found) = list.iter().find(|tracked| tracked.status.get().is_found) else {
            return Ok(());
        };
        let moment = (S::constant(MOMENT) * longest).max(S::constant(SAME) * time.ulp());
        let at_once = self.last.is_some_and(|last| time - last <= moment);
        self.at_once = if at_once { self.at_once + 1 } else { 0 };
        self.last = Some(time);
        if self.at_once > AT_ONCE + OF_EACH * list.len() {
            return Err(Fault::EndlessModes {
                joint: found.interaction.name(),
                changes: self.at_once,
                time: time.to_f64(),
            });
        }
        Ok(())
    }
}

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Begins all interactions anew, once their settings are accepted.
    pub(crate) fn begin_interactions(&self, time: S, bodies: &M::State<S>) -> Result<(), Fault> {
        let dynamics: &Dynamics<S, M, F, A, C> = &self.dynamics;
        let scene = Scene::<S, M> {
            constants: dynamics.constants(),
            time,
            bodies,
        };
        for tracked in dynamics.tracked() {
            let interaction = &tracked.interaction;
            interaction.check(interaction.quantity.wraps(&scene))?;
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
        let now = |tracked: &Tracked<S, M>| {
            let impact = tracked.status.get().impact;
            impact.is_some_and(|impact| impact.time == time)
        };
        Ok(dynamics.tracked().iter().any(now))
    }
}
