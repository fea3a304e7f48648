//! What is asked of the interactions where the equations of motion are factorised.

use crate::error::Fault;
use crate::formulation::{Formulation, Solution};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::columns::Setting;
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
    /// The modes that follow, from accelerations without interactions.
    Choose(&'t C::Velocities<S>),
}

/// Does it.
pub(crate) fn perform<S, M, F, C, const K: usize>(
    setting: &Setting<'_, S, M, F, C>,
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
            efforts::complete(setting, list, solution, is_wanted)
        }
        Task::Correct(changes) => efforts::corrections(setting, list, changes),
        Task::Strike(change, is_moved) => switch::impulses(setting, list, is_moved, change),
        Task::Choose(accelerations) => choice::modes(setting, list, accelerations),
    }
}
