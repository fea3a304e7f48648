//! Efforts, impulses and modes of interactions.

use super::{Dynamics, Posed, Solvable};
use crate::error::{Fault, StepFault};
use crate::formulation::add;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::Several as _;
use crate::nonsmooth::checked::check_all;
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{Exerted, Show, Tracked};
use crate::nonsmooth::task::{Strike, Task};
use crate::state::vector::{Array, MovingState, Vector as _};

/// The interactions of a problem.
type List<P> =
    <<P as Posed>::Forces as AppliedForces<<P as Posed>::Number, <P as Posed>::Mechanism>>::List;

impl<P: Solvable> Dynamics<P> {
    /// Calls with the interactions, to be changed, and with the equations, where they are as they
    /// were until then. `None` where there are none.
    ///
    /// # Errors
    /// That of the call; the interactions are then as before.
    pub(super) fn change_list<R>(
        &mut self,
        change: impl FnOnce(&Self, &mut List<P>) -> Result<R, Fault>,
    ) -> Result<Option<R>, Fault> {
        let Some(mut list) = self.forces.list_mut().map(|list| list.clone()) else {
            return Ok(None);
        };
        let changed = change(self, &mut list)?;
        if let Some(place) = self.forces.list_mut() {
            *place = list;
        }
        Ok(Some(changed))
    }
}

impl<P, S: Real, M: Mechanism, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Coordinates = C>,
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
        if P::Forces::INTERACTS {
            let parameters = *self.parameters();
            self.forces.renew(&parameters);
            check_all(self.tracked())?;
        }
        Ok(())
    }

    /// The interactions, to be changed.
    pub(crate) fn tracked_mut(&mut self) -> &mut [Tracked<S, M>] {
        match self.forces.list_mut() {
            Some(list) => list.as_mut(),
            None => &mut [],
        }
    }

    /// Shows what all interactions exert in a state.
    pub(crate) fn efforts(
        &self,
        time: S,
        state: &C::State<S>,
        show: &mut Show<'_, S>,
    ) -> Result<(), Fault> {
        if !P::Forces::INTERACTS {
            return Ok(());
        }
        let (mut rates, mut multipliers) = (C::State::zeros(), Array::zeros());
        let evaluator = self.evaluator();
        match evaluator.parts(time, state, &mut rates, &mut multipliers, Some(show)) {
            Ok(_) => Ok(()),
            Err(Fault::Step(StepFault::StateNotFinite)) => Err(evaluator.fault(time, state)),
            Err(fault) => Err(fault),
        }
    }

    /// Leaves what all interactions exert in a state in their statuses.
    pub(crate) fn keep_efforts(&mut self, time: S, state: &C::State<S>) -> Result<(), Fault> {
        let mut exerted = List::<P>::each(Exerted::nothing());
        self.efforts(time, state, &mut |all| {
            let places = exerted.as_mut().iter_mut();
            places.zip(all).for_each(|(place, one)| *place = *one);
        })?;
        for (tracked, exerted) in self.tracked_mut().iter_mut().zip(exerted.as_ref()) {
            tracked.status.exerted = *exerted;
        }
        Ok(())
    }

    /// The power (W) of friction that slides by its load, which is no force of a closure; `None`
    /// where it is not known.
    pub(super) fn power_by_load(
        &self,
        time: S,
        state: &C::State<S>,
        bodies: &M::State<S>,
    ) -> Option<S> {
        if !P::Forces::INTERACTS || !self.tracked().iter().any(Tracked::slips_by_load) {
            return Some(S::zero());
        }
        let scene = Scene::<S, M> {
            constants: self.constants(),
            time,
            bodies,
        };
        let mut power = S::zero();
        let found = self.efforts(time, state, &mut |all| {
            let list = self.tracked().iter().zip(all);
            for (tracked, exerted) in list.filter(|(tracked, _)| tracked.slips_by_load()) {
                let rate = tracked.interaction.quantity.rate(&scene);
                power = exerted.effort.fused(rate, power);
            }
        });
        found.ok().map(|()| power)
    }

    /// The state with what is held brought back to where it is held, at rest; `None` where nothing
    /// is.
    pub(crate) fn held(
        &mut self,
        time: S,
        state: &C::State<S>,
    ) -> Result<Option<C::State<S>>, Fault> {
        let holds = |tracked: &Tracked<S, M>| tracked.mode().holds();
        if !P::Forces::INTERACTS || !self.tracked().iter().any(holds) {
            return Ok(None);
        }
        let mut faster = C::Velocities::<S>::zeros();
        let mut farther = C::Velocities::<S>::zeros();
        self.change_list(|dynamics, list| {
            let evaluator = dynamics.evaluator();
            evaluator.set_up(time, state, |setting, _| {
                let task = Task::Correct([&mut faster, &mut farther]);
                evaluator.interact(setting, list, task)
            })
        })?;
        let way = C::way(self.own_constants(), time, state, &farther);
        let mut next = state.plus([(S::one(), &way)]);
        add(next.rates_slice_mut(), S::one(), faster.as_slice());
        Ok(Some(next))
    }

    /// The state after the impulses of an instant; the statuses have the modes that follow.
    #[inline(never)]
    pub(crate) fn switched(
        &mut self,
        time: S,
        state: &C::State<S>,
        is_moved: bool,
    ) -> Result<C::State<S>, Fault> {
        let lands = self.tracked().iter().any(Tracked::lands);
        let may_stick = |tracked: &Tracked<S, M>| {
            let sticks = tracked.tangent().is_some() && tracked.mode() == InteractionMode::Sticking;
            tracked.status.follows() || lands && sticks
        };
        let tries = self.tracked().iter().any(may_stick);
        let how = Strike { is_moved, tries };
        if !tries {
            return self.switched_where(time, state, how);
        }
        let before = self.forces.list_mut().map(|list| list.clone());
        let next = self.switched_where(time, state, how);
        if !self.tracked().iter().any(|tracked| tracked.status.is_tried) {
            return next;
        }
        let sticks = |tracked: &Tracked<S, M>| tracked.mode() == InteractionMode::Sticking;
        let tried = self.forces.list_mut().map(|list| list.clone());
        if let (Some(list), Some(before)) = (self.forces.list_mut(), before) {
            *list = before;
        }
        // What would stick is led to its end, see `pace.rs`, or has not left its rest.
        let tried = tried.iter().flat_map(|list| list.as_ref());
        for (tracked, tried) in self.tracked_mut().iter_mut().zip(tried) {
            tracked.status.ends = next.is_ok() && tried.status.is_tried && sticks(tried);
        }
        let how = Strike {
            tries: false,
            ..how
        };
        self.switched_where(time, state, how)
    }

    fn switched_where(
        &mut self,
        time: S,
        state: &C::State<S>,
        how: Strike,
    ) -> Result<C::State<S>, Fault> {
        let mut change = C::Velocities::<S>::zeros();
        self.change_list(|dynamics, list| {
            let evaluator = dynamics.evaluator();
            evaluator.set_up(time, state, |setting, _| {
                let task = Task::Strike(&mut change, how);
                evaluator.interact(setting, list, task)
            })
        })?;
        let mut next = *state;
        add(next.rates_slice_mut(), S::one(), change.as_slice());
        self.change_list(|dynamics, list| {
            let evaluator = dynamics.evaluator();
            evaluator.set_up(time, &next, |setting, solution| {
                let task = Task::Choose(solution);
                evaluator.interact(setting, list, task)
            })
        })?;
        Ok(next)
    }
}
