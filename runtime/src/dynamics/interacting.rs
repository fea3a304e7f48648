//! Efforts, impulses and modes of interactions.

use super::Dynamics;
use crate::error::{Fault, StepFault};
use crate::formulation::{Formulation, add};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Tracked;
use crate::nonsmooth::task::Task;
use crate::state::vector::{Array, MovingState, Vector as _};

impl<S, M, F, A, C> Dynamics<S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// The interactions, with their statuses.
    pub(crate) fn tracked(&self) -> &[Tracked<S, M>] {
        self.forces.interactions()
    }

    /// Takes the limits of the description by the parameters that it has now.
    ///
    /// # Errors
    /// [`StartFault::InteractionSetting`](crate::error::StartFault::InteractionSetting).
    pub(crate) fn renew_limits(&mut self) -> Result<(), Fault> {
        if A::INTERACTS {
            let parameters = *self.parameters();
            self.forces.renew(&parameters);
            for tracked in self.tracked() {
                tracked.interaction.check()?;
            }
        }
        Ok(())
    }

    /// Leaves the efforts of interactions in their statuses.
    pub(crate) fn efforts(&self, time: S, state: &C::State<S>) -> Result<(), Fault> {
        if !A::INTERACTS {
            return Ok(());
        }
        let (mut rates, mut multipliers) = (C::State::zeros(), Array::zeros());
        let evaluator = self.evaluator();
        match evaluator.parts(time, state, &mut rates, &mut multipliers, true) {
            Ok(_) => Ok(()),
            Err(Fault::Step(StepFault::StateNotFinite)) => Err(evaluator.fault(time, state)),
            Err(fault) => Err(fault),
        }
    }

    /// The power (W) of friction that slides by its load, which is no force of a closure; `None`
    /// where it is not known.
    pub(super) fn power_by_load(
        &self,
        time: S,
        state: &C::State<S>,
        bodies: &M::State<S>,
    ) -> Option<S> {
        if !A::INTERACTS || !self.tracked().iter().any(Tracked::slips_by_load) {
            return Some(S::zero());
        }
        self.efforts(time, state).ok()?;
        let scene = Scene::<S, M> {
            constants: self.constants(),
            time,
            bodies,
        };
        let slipping = self
            .tracked()
            .iter()
            .filter(|tracked| tracked.slips_by_load());
        Some(slipping.fold(S::zero(), |power, tracked| {
            let rate = tracked.interaction.quantity.rate(&scene);
            tracked.status.get().effort.fused(rate, power)
        }))
    }

    /// The state with what is held brought back to where it is held, at rest; `None` where nothing
    /// is.
    pub(crate) fn held(&self, time: S, state: &C::State<S>) -> Result<Option<C::State<S>>, Fault> {
        let holds = |tracked: &Tracked<S, M>| tracked.mode().holds();
        if !A::INTERACTS || !self.tracked().iter().any(holds) {
            return Ok(None);
        }
        let mut faster = C::Velocities::<S>::zeros();
        let mut farther = C::Velocities::<S>::zeros();
        let evaluator = self.evaluator();
        evaluator.set_up(time, state, |setting, _| {
            let task = Task::Correct([&mut faster, &mut farther]);
            evaluator.interact(setting, task)
        })?;
        let way = C::way(self.own_constants(), time, state, &farther);
        let mut next = state.plus([(S::one(), &way)]);
        add(next.rates_slice_mut(), S::one(), faster.as_slice());
        Ok(Some(next))
    }

    /// The state after the impulses of an instant; the statuses have the modes that follow.
    #[inline(never)]
    pub(crate) fn switched(
        &self,
        time: S,
        state: &C::State<S>,
        is_moved: bool,
    ) -> Result<C::State<S>, Fault> {
        let mut change = C::Velocities::<S>::zeros();
        let evaluator = self.evaluator();
        evaluator.set_up(time, state, |setting, _| {
            let task = Task::Strike(&mut change, is_moved);
            evaluator.interact(setting, task)
        })?;
        let mut next = *state;
        add(next.rates_slice_mut(), S::one(), change.as_slice());
        evaluator.set_up(time, &next, |setting, solution| {
            let task = Task::Choose(solution);
            evaluator.interact(setting, task)
        })?;
        Ok(next)
    }
}
