//! A step of a run: taken, its turns counted, and looked into for events and for the monitor.

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::Advance;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::run::followed::bodies_within;
use crate::run::segments::{Run, Taken};
use crate::run::within::{better_end, look_within};
use crate::state::vector::Vector as _;

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Takes a step, and looks into it for events and for the monitor. It is no longer than some
    /// seconds. False of one that must be shorter.
    #[inline]
    pub(super) fn take<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        last_good: &mut (S, M::State<S>),
        longest: S,
        taken: &mut Taken<S, M>,
    ) -> Result<bool, Fault> {
        if let Err(fault) = integration.advance(&mut self.dynamics) {
            let is_shortened = self.tries_again((last_good.0, &last_good.1), longest);
            return if is_shortened { Ok(false) } else { Err(fault) };
        }
        if !self.is_taken(integration, (last_good.0, &last_good.1))? {
            return Ok(false);
        }
        if !self.dynamics.knows_turns(integration.state()) {
            self.recount(integration, last_good)?;
        }
        if self.stabilisation.is_none() {
            let (time, state) = (integration.time(), integration.state());
            self.branching.step(&mut self.dynamics, time, state);
        }
        let &mut (start, ref near) = last_good;
        (taken.event, taken.better) = (None, None);
        if self.looks_for_events() {
            taken.event = self.event_within(integration, (start, near))?;
        }
        let before = integration.counts().evaluations;
        if let Some(monitor) = &mut self.monitor {
            if taken.event.is_none() && monitor.judges() {
                taken.better = better_end(&mut self.dynamics, integration, near);
            }
            let (dynamics, event) = (&mut self.dynamics, taken.event.as_ref());
            look_within(monitor, dynamics, integration, near, event);
        }
        taken.evaluations = integration.counts().evaluations;
        taken.looks = taken.evaluations.saturating_sub(before);
        Ok(true)
    }

    /// Counts the turns of a step that the integration has not counted, or of which it does not
    /// know them.
    #[cold]
    #[inline(never)]
    fn recount<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        self.convert(last_good);
        let (near, end) = ((last_good.0, &last_good.1), integration.time());
        let bodies = bodies_within(&mut self.dynamics, integration, near, end)?;
        integration.recount(bodies.turns());
        Ok(())
    }
}
