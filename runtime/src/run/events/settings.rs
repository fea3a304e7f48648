//! What may be said of a simulation once it has events and controllers.

use crate::constraints::projection::Projection;
use crate::formulation::Formulation;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::interacting::{Interacting, Unlimited};
use crate::measure::load::{AppliedForces, ForceLaw, Loads};
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::Beside;
use crate::nonsmooth::interaction::Interaction;
use crate::run::events::hybrid::HybridSimulation;
use crate::run::post_step::PostStabilisation;
use crate::run::simulation::Simulation;

impl<T, E> HybridSimulation<T, E> {
    fn of<T2>(self, say: impl FnOnce(T) -> T2) -> HybridSimulation<T2, E> {
        HybridSimulation {
            simulation: say(self.simulation),
            happenings: self.happenings,
        }
    }
}

/// A simulation in other coordinates.
type In<'a, S, M, F, I, A, C, E> = HybridSimulation<Simulation<'a, S, M, F, I, A, C>, E>;

impl<'a, S, M, F, I, A, C, E> In<'a, S, M, F, I, A, C, E>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// See [`Simulation::initial_state`].
    #[must_use]
    pub fn initial_state(self, state: M::State<S>) -> Self {
        self.of(|simulation| simulation.initial_state(state))
    }

    /// See [`Simulation::assembled`].
    #[must_use]
    pub fn assembled(self) -> Self {
        self.of(Simulation::assembled)
    }

    /// See [`Simulation::projection`].
    #[must_use]
    pub fn projection(self, projection: Projection<S>) -> Self {
        self.of(|simulation| simulation.projection(projection))
    }

    /// See [`Simulation::post_stabilisation`].
    #[must_use]
    pub fn post_stabilisation(self, stabilisation: &'a dyn PostStabilisation<S, M>) -> Self {
        self.of(|simulation| simulation.post_stabilisation(stabilisation))
    }

    /// See [`Simulation::inconsistent_start`].
    #[must_use]
    pub fn inconsistent_start(self) -> Self {
        self.of(Simulation::inconsistent_start)
    }

    /// See [`Simulation::breaks`].
    #[must_use]
    pub fn breaks(self, instants: &'a [S]) -> Self {
        self.of(|simulation| simulation.breaks(instants))
    }

    /// See [`Simulation::unmonitored`].
    #[must_use]
    pub fn unmonitored(self) -> Self {
        self.of(Simulation::unmonitored)
    }

    /// See [`Simulation::forces`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> In<'a, S, M, F, I, A::With<ForceLaw<G>>, C, E>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        self.of(|simulation| simulation.forces(law))
    }

    /// See [`Simulation::coordinates`].
    #[must_use]
    pub fn coordinates<C2: Coordinates<M>>(self) -> In<'a, S, M, F, I, A, C2, E> {
        self.of(Simulation::coordinates)
    }

    /// See [`Simulation::joint_coordinates`].
    #[must_use]
    pub fn joint_coordinates(self) -> In<'a, S, M, F, I, A, Relative, E>
    where
        M: JointCoordinates,
    {
        self.coordinates()
    }

    /// See [`Simulation::absolute_coordinates`].
    #[must_use]
    pub fn absolute_coordinates(self) -> In<'a, S, M, F, I, A, Absolute, E> {
        self.coordinates()
    }

    /// See [`Simulation::interactions`].
    #[must_use]
    pub fn interactions<const K: usize, const ALL: usize>(
        self,
        interactions: [Interaction<S, M>; K],
    ) -> In<'a, S, M, F, I, Interacting<S, M, A, ALL>, C, E>
    where
        M: Beside<K, ALL>,
    {
        self.of(|simulation| simulation.interactions(interactions))
    }

    /// See [`Simulation::without_limits`].
    #[must_use]
    pub fn without_limits(self) -> In<'a, S, M, F, I, Unlimited<A>, C, E> {
        self.of(Simulation::without_limits)
    }
}
