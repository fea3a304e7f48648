//! Steps in joint coordinates, for a loop that somebody else owns.

use crate::dynamics::Iterations;
use crate::dynamics::joint_dynamics::JointDynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::Scheme;
use crate::math::clock::Clock;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::measure::view::View;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::run::stepper::end_of_step;

/// What [`Stepper`](crate::Stepper) is for bodies: a mechanism in joint coordinates, a formulation
/// and a one-step method, prepared; takes one step at a time.
///
/// Its states are [`JointCoordinates::JointState`]. A start is set in a state of the bodies, by
/// handle as ever, and [`JointStepper::joints`] takes it over; what is to be read is read of
/// [`JointStepper::bodies`]. A step has a fixed number of evaluations, allocates nothing and does
/// not panic. Joints of the tree cannot open; equations that close loops drift or are stabilised,
/// as the formulation has it.
///
/// ```
/// use holonom::joints::Revolute;
/// use holonom::prelude::*;
/// use holonom::JointStepper;
///
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// struct Rod {
///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
///     rod: Body,
///     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
/// }
///
/// let rod = Rod::default();
/// let hinge = Rod::HANDLES.hinge;
/// let mut stepper = JointStepper::<f64, _, _, _>::new(&rod, StandardLagrange, Rk4)?;
/// let mut start = rod.described_state()?;
/// rod.set_angle(&mut start, hinge, 0.5)?;
/// let mut state = stepper.joints(&start)?;
/// for _ in 0..200 {
///     stepper.step(&mut state, 1e-3)?;
/// }
/// let bodies = stepper.bodies(&state);
/// let view = stepper.view(&bodies);
/// assert!(view.angle(hinge) < 0.4 && view.violation() < 1e-30);
/// # Ok::<(), Fault>(())
/// ```
pub struct JointStepper<S: Real, M: JointCoordinates, F: Formulation<S>, K, A = NoForces> {
    dynamics: JointDynamics<S, M, F, A>,
    scheme: K,
    clock: Clock<S>,
}

impl<S: Real, M: JointCoordinates, F: Formulation<S>, K: Copy, A: Clone> Clone
    for JointStepper<S, M, F, K, A>
{
    fn clone(&self) -> Self {
        Self {
            dynamics: self.dynamics.clone(),
            scheme: self.scheme,
            clock: self.clock,
        }
    }
}

impl<S: Real, M: JointCoordinates, F: Formulation<S>, K: Scheme<S>> JointStepper<S, M, F, K> {
    /// Prepares the kernels; the time begins at zero.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F, scheme: K) -> Result<Self, Fault> {
        Ok(Self {
            dynamics: JointDynamics::new(mechanism, formulation)?,
            scheme,
            clock: Clock::at(S::zero()),
        })
    }
}

impl<S, M, F, K, A> JointStepper<S, M, F, K, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    K: Scheme<S>,
{
    /// Begins at a time (s).
    #[must_use]
    pub fn starting_at(mut self, time: S) -> Self {
        self.clock = Clock::at(time);
        self
    }

    /// Applies forces as a function of time and state of the bodies, see [`Loads`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> JointStepper<S, M, F, K, ForceLaw<G>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        let Self {
            dynamics,
            scheme,
            clock,
        } = self;
        JointStepper {
            dynamics: dynamics.forces(law),
            scheme,
            clock,
        }
    }

    /// The time that was reached (s).
    #[must_use]
    pub fn time(&self) -> S {
        self.clock.time()
    }

    /// Takes the present inputs and parameters of the mechanism, to be called between steps.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        self.dynamics.update(mechanism)
    }

    /// Takes these inputs, to be called between steps: in the number type of the run, at the cost
    /// of what depends on inputs.
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    #[inline]
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), Fault> {
        self.dynamics.set_inputs(inputs)
    }

    /// The state that the attributes of the bodies describe.
    ///
    /// # Errors
    /// As [`JointDynamics::initial_state`].
    pub fn initial_state(&self) -> Result<M::JointState<S>, Fault> {
        self.dynamics.initial_state()
    }

    /// The joint coordinates of bodies.
    ///
    /// # Errors
    /// As [`JointDynamics::joints`].
    pub fn joints(&self, bodies: &M::State<S>) -> Result<M::JointState<S>, Fault> {
        self.dynamics.joints(bodies)
    }

    /// How the bodies stand and move.
    #[must_use]
    pub fn bodies(&self, state: &M::JointState<S>) -> M::State<S> {
        self.dynamics.bodies(state)
    }

    /// Readable access to a state of the bodies at the time that was reached.
    #[must_use]
    pub fn view<'a>(&'a self, bodies: &'a M::State<S>) -> View<'a, S, M> {
        self.dynamics.of_bodies().view(self.time(), bodies)
    }

    /// The multipliers of all joints in a state of the bodies, at the time that was reached and
    /// with the inputs of the last step: what [`View::reaction`] asks for. One evaluation of the
    /// bodies, which costs more than a step.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`](crate::dynamics::Dynamics::evaluate).
    pub fn multipliers(&self, bodies: &M::State<S>) -> Result<M::Multipliers<S>, Fault>
    where
        A: AppliedForces<S, M>,
    {
        let of_bodies = self.dynamics.of_bodies();
        let (evaluation, _) = of_bodies.evaluate(self.time(), bodies)?;
        Ok(evaluation.multipliers)
    }

    /// The prepared dynamics, for evaluations outside a step.
    #[must_use]
    pub fn dynamics(&self) -> &JointDynamics<S, M, F, A> {
        &self.dynamics
    }

    /// How often the augmented Lagrangian solved its system; zero for other formulations, and where
    /// no equation remains.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.dynamics.iterations()
    }
}

impl<S, M, F, K, A> JointStepper<S, M, F, K, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    K: Scheme<S>,
    A: AppliedForces<S, M>,
{
    /// Moves the state by one step of `dt` (s), as [`Stepper::step`](crate::Stepper::step) does.
    ///
    /// # Errors
    /// Why the step could not be done. State and time are then as before.
    pub fn step(&mut self, state: &mut M::JointState<S>, dt: S) -> Result<(), Fault> {
        let clock = end_of_step::<S, M>(&self.clock, dt)?;
        self.scheme
            .step(&mut self.dynamics, self.clock.time(), state, dt)?;
        self.clock = clock;
        Ok(())
    }

    /// The same with these inputs over the step, which stay until others are set: also where the
    /// step is refused for another reason than they.
    ///
    /// # Errors
    /// As [`Self::step`], and an input that is not finite. State and time are then as before.
    #[inline]
    pub fn step_with(
        &mut self,
        state: &mut M::JointState<S>,
        inputs: &M::Inputs<S>,
        dt: S,
    ) -> Result<(), Fault> {
        self.set_inputs(inputs)?;
        self.step(state, dt)
    }
}
