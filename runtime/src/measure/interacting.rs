//! Forces with interactions.

use crate::error::Fault;
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, Loads};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::columns::Setting;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::loads::Reactions;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Tracked;
use crate::nonsmooth::task::{Task, perform};

/// Further forces `A`, and `K` interactions
/// ([`Simulation::interactions`](crate::Simulation::interactions)).
#[derive(Clone, Debug)]
pub struct Interacting<S: Real, M: Mechanism, A, const K: usize> {
    forces: A,
    list: [Tracked<S, M>; K],
}

impl<S: Real, M: Mechanism, A, const K: usize> Interacting<S, M, A, K> {
    pub(crate) fn new(forces: A, interactions: [Interaction<S, M>; K]) -> Self {
        Self {
            forces,
            list: interactions.map(Tracked::new),
        }
    }
}

impl<S, M, A, const K: usize> AppliedForces<S, M> for Interacting<S, M, A, K>
where
    S: Real,
    M: Mechanism,
    A: AppliedForces<S, M>,
{
    const PRESENT: bool = A::PRESENT || K > 0;
    const INTERACTS: bool = K > 0;

    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        self.forces.apply(time, state, loads);
        let view = loads.view();
        let scene = Scene::<S, M> {
            constants: view.constants(),
            time,
            bodies: state,
        };
        for tracked in &self.list {
            if let Some(effort) = tracked.sliding_effort(&scene) {
                let quantity = &tracked.interaction.quantity;
                quantity.add_effort(&scene, effort, loads.forces);
            }
        }
    }

    fn interactions(&self) -> &[Tracked<S, M>] {
        &self.list
    }

    // One piece of code, apart from what a step without interactions is.
    #[inline(never)]
    fn interact<F: Formulation<S>, C: Coordinates<M>>(
        &self,
        setting: &Setting<'_, S, M, F, C>,
        reactions: Option<Reactions<'_, S, M, F>>,
        task: Task<'_, S, M, C>,
    ) -> Result<(), Fault> {
        perform(setting, reactions, &self.list, task)
    }
}
