//! What interactions change between steps, where the equations of motion are factorised.

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::{Several, VisitMut};
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::status::Tracked;
pub(crate) use crate::nonsmooth::switch::Strike;
use crate::nonsmooth::{choice, efforts, switch};

/// What is asked for.
pub(crate) enum Task<'t, S: Real, M: Mechanism, C: Coordinates<M>> {
    /// What brings back what is held: changes of velocities, and of coordinates as velocities over
    /// a unit of time.
    Correct([&'t mut C::Velocities<S>; 2]),
    /// Impulses, as changes of velocities.
    Strike(&'t mut C::Velocities<S>, Strike),
    /// The modes that follow, from the solution without interactions.
    Choose(&'t Solution<S, M, C>),
}

impl<S: Real, M: Mechanism, C: Coordinates<M>> Task<'_, S, M, C> {
    /// Whether the reactions of joints are asked for.
    pub(crate) fn asks_for_loads(&self, list: &[Tracked<S, M>]) -> bool {
        let is_by_load = |tracked: &Tracked<S, M>| tracked.bearing().is_some();
        matches!(self, Self::Choose(_)) && list.iter().any(is_by_load)
    }
}

/// Does it.
pub(crate) fn perform<S, M, F, C, L>(
    setting: &Setting<'_, S, M, F, C>,
    reactions: Option<Reactions<'_, S, M, F>>,
    list: &mut L,
    task: Task<'_, S, M, C>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
    L: Several<Tracked<S, M>>,
{
    let perform = Perform {
        setting,
        reactions,
        task,
    };
    list.visit_mut(perform).unwrap_or(Ok(()))
}

/// It, with what it needs of the equations of motion.
struct Perform<'a, 'r, 't, S: Real, M: Mechanism, F: Formulation<S>, C: Coordinates<M>> {
    setting: &'a Setting<'a, S, M, F, C>,
    reactions: Option<Reactions<'r, S, M, F>>,
    task: Task<'t, S, M, C>,
}

impl<S, M, F, C> VisitMut<Tracked<S, M>> for Perform<'_, '_, '_, S, M, F, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    type Output = Result<(), Fault>;

    fn visit<const K: usize>(self, list: &mut [Tracked<S, M>; K]) -> Result<(), Fault> {
        let Self {
            setting, reactions, ..
        } = self;
        match self.task {
            Task::Correct(changes) => efforts::corrections(setting, list, changes),
            Task::Strike(change, how) => switch::impulses(setting, list, how, change),
            Task::Choose(solution) => choice::modes(setting, reactions, list, solution),
        }
    }
}
