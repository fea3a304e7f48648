//! Efforts within a step, where the modes are fixed.

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::box_problem::Factors;
use crate::nonsmooth::columns::{Columns, Setting};
use crate::nonsmooth::interaction::Law;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{InteractionMode, Tracked};
use crate::state::vector::Array;

/// Rounds of correction. The second takes what round-off and an iterated formulation leave, so that
/// what is held does not creep.
const ROUNDS: usize = 2;

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The effort of friction that slides, which is known; `None` in another mode.
    pub(crate) fn sliding_effort(&self, scene: &Scene<'_, S, M>) -> Option<S> {
        let sign = self.mode().sliding::<S>()?;
        let Law::Friction(friction) = self.interaction.law else {
            return None;
        };
        let rate = self.interaction.quantity.rate(scene);
        Some(-sign * friction.sliding(rate))
    }
}

/// Adds the efforts that hold to a solution, which has those of sliding friction. Leaves all of
/// them in the statuses where they are wanted.
pub(crate) fn complete<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    solution: &mut Solution<S, M, C>,
    is_wanted: bool,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let holds = list.each_ref().map(|tracked| tracked.mode().holds());
    let mut efforts = [S::zero(); K];
    if holds.contains(&true) {
        let columns = Columns::of(setting, list, &holds)?;
        let factors = Factors::of(&columns.delassus, &holds);
        for _ in 0..ROUNDS {
            let accelerations = setting.accelerations(list, &solution.accelerations);
            let change = factors.solve(&accelerations).map(|change| -change);
            columns.add_to(&change, solution);
            for (effort, change) in efforts.iter_mut().zip(change) {
                *effort = *effort + change;
            }
        }
    }
    if is_wanted {
        setting.here(|scene| {
            for (tracked, &effort) in list.iter().zip(&efforts) {
                let effort = tracked.sliding_effort(scene).unwrap_or(effort);
                tracked.update(|status| status.effort = effort);
            }
        });
    }
    Ok(())
}

/// What brings back what is held, to where it is held and to rest: changes of velocities, and of
/// coordinates as velocities over a unit of time. The least ones in the metric of the mass.
pub(crate) fn corrections<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    list: &[Tracked<S, M>; K],
    [velocities, displacements]: [&mut C::Velocities<S>; 2],
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let holds = list.each_ref().map(|tracked| tracked.mode().holds());
    if !holds.contains(&true) {
        return Ok(());
    }
    let columns = Columns::of(setting, list, &holds)?;
    let factors = Factors::of(&columns.delassus, &holds);
    let (rates, beyond) = setting.here(|scene| {
        let rates = super::columns::rates(list, scene);
        let beyond = list.each_ref().map(|tracked| tracked.beyond(scene));
        (rates, beyond)
    });
    let impulses = factors.solve(&rates).map(|impulse| -impulse);
    columns.add_velocities(&impulses, velocities);
    let moves = factors.solve(&beyond).map(|by| -by);
    *displacements = Array::zeros();
    columns.add_velocities(&moves, displacements);
    Ok(())
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// How far it is from where it is held; zero where nothing but the rate is.
    fn beyond(&self, scene: &Scene<'_, S, M>) -> S {
        let status = self.status.get();
        let quantity = &self.interaction.quantity;
        match (status.mode, &self.interaction.law) {
            (InteractionMode::AtLower, Law::Limits(limits)) => {
                quantity.beyond(scene, limits.bounds[0])
            }
            (InteractionMode::AtUpper, Law::Limits(limits)) => {
                quantity.beyond(scene, limits.bounds[1])
            }
            (InteractionMode::Sticking, _) if quantity.has_value() => {
                quantity.beyond(scene, status.held)
            }
            _ => S::zero(),
        }
    }
}
