//! What is asked of the interactions where the equations of motion are factorised.

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::status::Tracked;
use crate::nonsmooth::{choice, efforts, switch};

/// What is asked for.
pub enum Task<'t, S: Real, M: Mechanism, C: Coordinates<M>> {
    /// To complete a solution by the efforts that hold, and to leave all efforts in the statuses
    /// where they are wanted.
    Complete(&'t mut Solution<S, M, C>, bool),
    /// What brings back what is held: changes of velocities, and of coordinates as velocities over
    /// a unit of time.
    Correct([&'t mut C::Velocities<S>; 2]),
    /// Impulses, as changes of velocities, and whether a handler has moved the mechanism.
    Strike(&'t mut C::Velocities<S>, bool),
    /// The modes that follow, from the solution without interactions.
    Choose(&'t Solution<S, M, C>),
}

impl<S: Real, M: Mechanism, C: Coordinates<M>> Task<'_, S, M, C> {
    /// Whether the reactions of joints are asked for.
    pub(crate) fn asks_for_loads(&self, list: &[Tracked<S, M>]) -> bool {
        let mut list = list.iter();
        match self {
            Self::Complete(_, is_wanted) => list.any(|tracked| tracked.asks_for_load(*is_wanted)),
            Self::Choose(_) => list.any(|tracked| tracked.bearing().is_some()),
            Self::Correct(_) | Self::Strike(..) => false,
        }
    }
}

/// Does it.
pub(crate) fn perform<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
    reactions: Option<Reactions<'_, S, M, F>>,
    list: &[Tracked<S, M>; K],
    task: Task<'_, S, M, C>,
) -> Result<(), Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    match task {
        Task::Complete(solution, is_wanted) => {
            efforts::complete(setting, reactions, list, (solution, is_wanted))
        }
        Task::Correct(changes) => efforts::corrections(setting, list, changes),
        Task::Strike(change, is_moved) => switch::impulses(setting, list, is_moved, change),
        Task::Choose(solution) => choice::modes(setting, reactions, list, solution),
    }
}
