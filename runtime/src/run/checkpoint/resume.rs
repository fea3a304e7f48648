//! Runs that go on from a checkpoint.

use super::Checkpoint;
use crate::dynamics::Problem;
use crate::formulation::Formulation;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::run::events::list::Happenings;
use crate::run::output::IntoFlow;
use crate::run::report::RunResult;
use crate::run::runs::Runs;
use crate::run::sample::Sample;
use crate::run::simulation::Simulation;

impl<S, M, F, I, A, C> Simulation<'_, Problem<S, M, F, A, C>, I>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Goes on from a [`Checkpoint`] to the end of its interval: what is
    /// shown and reported from there on is what the whole run would have shown and reported.
    ///
    /// Build the simulation as that of the run: the same mechanism with the values of its start,
    /// the same formulation, method, coordinates, corrections, breaks, forces, interactions, events
    /// and controllers. The initial state is of no account.
    ///
    /// ```
    /// use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let rod = Rod::default();
    /// let simulation = || rod.simulation(StandardLagrange, DormandPrince::default());
    /// let mut kept = Vec::new();
    /// let whole = simulation()
    ///     .checkpoints(10, |checkpoint| kept.push(checkpoint.clone()))
    ///     .run(0.0..=5.0, every(0.1), |_| ())?;
    /// let half = &kept[kept.len() / 2];
    /// assert_eq!(simulation().resume(half, |_| ())?, whole); // to the last bit
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Simulation::run`], and [`Fault::Checkpoint`](crate::Fault::Checkpoint) where the
    /// simulation is not that of the checkpoint.
    pub fn resume<O, R>(
        &self,
        checkpoint: &Checkpoint<M, S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<S, M, F, C, A>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        self.setup.run_with(None, checkpoint, observe)
    }
}

impl<S, M, F, I, A, C, E, X> Simulation<'_, Problem<S, M, F, A, C>, I, (E, X)>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    I: Method<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    (E, X): Happenings<S, M>,
{
    /// Goes on from a [`Checkpoint`] with events and controllers: the same ones as in its run, in
    /// the same order. Closures begin with what they remember, so put it back first.
    ///
    /// # Errors
    /// Those of a run, and [`Fault::Checkpoint`](crate::Fault::Checkpoint) where the simulation is
    /// not that of the checkpoint.
    pub fn resume<O, R>(
        &mut self,
        checkpoint: &Checkpoint<M, S>,
        observe: O,
    ) -> RunResult<S, M, R::Error<M::State<S>>>
    where
        I: Runs<S, M, F, C, A>,
        O: FnMut(&Sample<'_, S, M>) -> R,
        R: IntoFlow,
    {
        let list: &mut dyn Happenings<S, M> = &mut self.happenings;
        self.setup.run_with(Some(list), checkpoint, observe)
    }
}
