//! A mechanism as a system of differential equations, in absolute or relative coordinates.
//!
//! [`Dynamics`] is one type for both: [`Coordinates`] names the kernels. Whatever reads a mechanism
//! (views, reactions, the monitor, projections) reads its bodies, and so the equations in absolute
//! coordinates are always prepared. `evaluate.rs` evaluates either equations, `system.rs` is what
//! an integrator moves. `jacobian.rs` has the exact Jacobian:
//! `docs/decisions/009-jacobian-by-forward-numbers.md`.
//!
//! Faults. The smallest pivot leaves a kernel with its result, and `faults.rs` makes an error with
//! the joint's name. `origin.rs` finds where a non-finite rate began, after a fault only:
//! `docs/decisions/007-checks-after-a-step.md`. Where relative coordinates give no rates, their own
//! numbers name the body.
//!
//! `likes.rs` judges the values of parameters with `like`: it assembles, from the described state
//! or by continuation from the typical values. Then it looks at the pivots. For each omitted
//! equation it compares value and gradient with the others, at the start and at a few
//! configurations and times.

pub(crate) mod equations;
pub(crate) mod evaluate;
mod faults;
mod interacting;
mod jacobian;
mod kept;
pub(crate) mod likes;
mod monitored;
mod near;
mod on_constraints;
pub(crate) mod origin;
mod problem;
mod secants;
mod straight_on;
mod system;
mod trial;

use core::fmt;

use evaluate::VANISHED;
pub(crate) use evaluate::{Evaluator, vanishes};
pub(crate) use faults::singular;
pub(crate) use problem::Carrying;
pub use problem::{
    Bodies, Posed, Problem, Solvable, State, UnderWay, WithCapacityFactor, WithCoordinates,
    WithForces, WithInteractions, WithLaw,
};

use crate::assembly::consistent_start::check_start;
use crate::constraints::compliance::compliances;
use crate::error::{Fault, ParameterError, StepFault};
use crate::formulation::{Formulation, inconsistency};
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::measure::view::View;
use crate::mechanism::absolute::stabilised;
use crate::mechanism::coordinates::{
    Absolute, AbsoluteEquations, Coordinates, Equations, EquationsIn, Evaluation, Relative,
};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{Mechanism, Orientation, Pivot, Stabilisation, have_equations};
use crate::mechanism::orientations::{check_state, with_unit_orientations};
use crate::mechanism::switch::Switch;
use crate::mechanism::turns;
use crate::monitor::Seen;
use crate::state::vector::{Array as _, StateParts, Vector};

/// A mechanism with a formulation, prepared: what an integrator moves.
///
/// States are those of the [`Problem`] ([`State`]): in absolute coordinates the state of the
/// bodies, in relative ones [`JointCoordinates::JointState`]. [`Dynamics::bodies`] says how the
/// bodies stand and move in a state, and everything that can be read of a mechanism is read there.
///
/// ```
/// use holonom::prelude::*;
/// use holonom::{dynamics::Dynamics, integrate::OneStep};
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
/// let mut dynamics = Dynamics::<Problem<_, _>>::new(&Rod::default(), StandardLagrange)?;
/// let mut state = dynamics.initial_state()?;
/// for step in 0..100 {
///     Rk4.step(&mut dynamics, 0.01 * f64::from(step), &mut state, 0.01)?;
/// }
/// let bodies = dynamics.bodies(&state);
/// let angle = dynamics.view(1.0, &bodies).angle(Rod::HANDLES.hinge);
/// assert!((state.pairs()[0][0] - angle.cos()).abs() < 1e-14);
/// # Ok::<(), Fault>(())
/// ```
pub struct Dynamics<P: Solvable> {
    parameters: <P::Mechanism as Mechanism>::Parameters<P::Number>,
    absolute: AbsoluteEquations<P::Number, P::Mechanism>,
    own: <P::Coordinates as Coordinates<P::Mechanism>>::Own<P::Number>,
    stabilisation: Stabilisation<P::Number>,
    formulation: P::Formulation,
    forces: P::Forces,
    pub(crate) iterations: Iterations,
    pub(crate) seen: Seen<P::Number>,
    /// Whether turns were counted through the last step.
    has_counted: bool,
    /// The relative pivot from which on it is asked whether a singular configuration is passed.
    pub(crate) near: P::Number,
    /// The pivot without the compliance at the end of the last step, where it was found.
    rigid: Option<P::Number>,
}

/// The parameters and inputs of a mechanism; inputs are finite in the number type of the run, too.
pub(crate) fn parameters<S: Real, M: Mechanism>(
    mechanism: &M,
) -> Result<M::Parameters<S>, ParameterError> {
    let mut parameters = mechanism.parameters()?;
    M::put_inputs(&mechanism.inputs(), &mut parameters)?;
    Ok(parameters)
}

/// How often the augmented Lagrangian solved its system.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Iterations {
    /// In all evaluations together.
    pub total: usize,
    /// In the evaluation that took the most.
    pub largest: usize,
    /// The evaluations in which the iteration was ended before its tolerance, near a singular
    /// configuration.
    pub unconverged: usize,
}

/// The equations in absolute coordinates.
fn equations<S: Real, M: Mechanism, F: Formulation<S>>(
    parameters: &M::Parameters<S>,
    formulation: &F,
    stabilisation: &Stabilisation<S>,
) -> Result<AbsoluteEquations<S, M>, Fault> {
    let constants = M::prepare(parameters);
    let radian = formulation.radian();
    let compliances = compliances::<S, M, F::Terms>(&constants, stabilisation, radian)?;
    Ok(Equations {
        coefficients: M::coefficients_by_row(&constants, stabilisation, &compliances),
        constants,
        compliances,
    })
}

impl<M: Mechanism, F: Formulation<S>, S: Real> Dynamics<Problem<M, F, S>> {
    /// Prepares the kernels in the coordinates that the attribute of the mechanism names, without
    /// forces beyond the description.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F) -> Result<Self, Fault> {
        let parameters = parameters(mechanism)?;
        mechanism.check_likes::<S>(None)?;
        Self::of_parameters(parameters, formulation)
    }

    /// The same of parameters that are known to be acceptable.
    pub(crate) fn of_parameters(
        parameters: M::Parameters<S>,
        formulation: F,
    ) -> Result<Self, Fault> {
        let stabilisation = formulation.stabilisation()?;
        let absolute = equations::<S, M, F>(&parameters, &formulation, &stabilisation)?;
        Ok(Self {
            own: M::Coordinates::own(&parameters, &stabilisation, &absolute),
            absolute,
            parameters,
            stabilisation,
            formulation,
            forces: NoForces,
            iterations: Iterations::default(),
            seen: Seen::nothing(),
            has_counted: false,
            near: S::constant(VANISHED) * S::EPSILON,
            rigid: None,
        })
    }
}

impl<P: Solvable<Forces: Clone>> Clone for Dynamics<P> {
    fn clone(&self) -> Self {
        Self {
            parameters: self.parameters,
            absolute: self.absolute,
            own: self.own,
            stabilisation: self.stabilisation,
            formulation: self.formulation,
            forces: self.forces.clone(),
            iterations: self.iterations,
            seen: self.seen,
            has_counted: false,
            near: self.near,
            rigid: self.rigid,
        }
    }
}

/// The name of the mechanism, and how often a formulation has solved.
impl<P: Solvable> fmt::Debug for Dynamics<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Dynamics")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("iterations", &self.iterations)
            .finish_non_exhaustive()
    }
}

impl<P, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> Dynamics<P>
where
    P: Solvable<Number = S, Mechanism = M, Formulation = F, Forces = A, Coordinates = C>,
{
    /// The same with forces from a closure, which is shown the state of the bodies.
    #[must_use]
    pub fn forces<G>(self, law: G) -> Dynamics<WithForces<P, ForceLaw<G>>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        self.with_forces(ForceLaw(law))
    }

    pub(crate) fn with_forces<A2: AppliedForces<S, M>>(
        self,
        forces: A2,
    ) -> Dynamics<WithForces<P, A2>> {
        self.exchange_forces(|_| forces)
    }

    pub(crate) fn exchange_forces<A2: AppliedForces<S, M>>(
        self,
        exchange: impl FnOnce(A) -> A2,
    ) -> Dynamics<WithForces<P, A2>> {
        Dynamics {
            parameters: self.parameters,
            absolute: self.absolute,
            own: self.own,
            stabilisation: self.stabilisation,
            formulation: self.formulation,
            forces: exchange(self.forces),
            iterations: self.iterations,
            seen: self.seen,
            has_counted: false,
            near: self.near,
            rigid: self.rigid,
        }
    }

    /// The forces beyond the description.
    pub(crate) fn applied_forces(&self) -> &A {
        &self.forces
    }

    /// The same in other coordinates.
    #[must_use]
    pub fn coordinates<C2: Coordinates<M>>(self) -> Dynamics<WithCoordinates<P, C2>> {
        Dynamics {
            own: C2::own(&self.parameters, &self.stabilisation, &self.absolute),
            parameters: self.parameters,
            absolute: self.absolute,
            stabilisation: self.stabilisation,
            formulation: self.formulation,
            forces: self.forces,
            iterations: self.iterations,
            seen: self.seen,
            has_counted: false,
            near: self.near,
            rigid: self.rigid,
        }
    }

    /// The same in relative (joint) coordinates.
    #[must_use]
    pub fn joint_coordinates(self) -> Dynamics<WithCoordinates<P, Relative>>
    where
        M: JointCoordinates,
    {
        self.coordinates()
    }

    /// The same in absolute coordinates.
    #[must_use]
    pub fn absolute_coordinates(self) -> Dynamics<WithCoordinates<P, Absolute>> {
        self.coordinates()
    }

    /// The same in absolute coordinates, with other rates of Euler parameters.
    #[doc(hidden)]
    #[must_use]
    pub fn orientation<O: Orientation>(self) -> Dynamics<WithCoordinates<P, Absolute<O>>> {
        self.coordinates()
    }

    /// Takes the present parameters and inputs of the mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        let parameters = parameters(mechanism)?;
        mechanism.check_likes(Some(&self.parameters))?;
        self.take_parameters(parameters)
    }

    /// The parameters and inputs.
    pub(crate) fn parameters(&self) -> &M::Parameters<S> {
        &self.parameters
    }

    /// Takes parameters and inputs that are known to be acceptable.
    pub(crate) fn take_parameters(&mut self, parameters: M::Parameters<S>) -> Result<(), Fault> {
        self.absolute = equations::<S, M, F>(&parameters, &self.formulation, &self.stabilisation)?;
        self.own = C::own(&parameters, &self.stabilisation, &self.absolute);
        self.forces.take_inputs(&parameters);
        self.parameters = parameters;
        Ok(())
    }

    /// Takes these inputs, and leaves the parameters: in the number type of the run, at the cost of
    /// what depends on inputs.
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    #[inline]
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), ParameterError> {
        M::put_inputs(inputs, &mut self.parameters)?;
        self.forces.take_inputs(&self.parameters);
        M::take_inputs(&self.parameters, &mut self.absolute.constants);
        C::take_inputs(&self.parameters, &mut self.own);
        Ok(())
    }

    /// Holds a side of a switch: 1 or -1. With 0 the side is that of the state.
    pub(crate) fn hold(&mut self, switch: &Switch, side: S) {
        let parameters = self.parameters.as_mut_slice();
        let held = parameters.get_mut(switch.place);
        if let Some(held) = held.filter(|held| **held != side) {
            *held = side;
            M::take_inputs(&self.parameters, &mut self.absolute.constants);
            C::take_inputs(&self.parameters, &mut self.own);
        }
    }

    /// What depends on the parameters of the mechanism alone, in absolute coordinates.
    #[must_use]
    pub fn constants(&self) -> &M::Constants<S> {
        &self.absolute.constants
    }

    /// The same in its own coordinates.
    #[inline(always)]
    pub(crate) fn own_constants(&self) -> &C::Constants<S> {
        &C::equations(&self.absolute, &self.own).constants
    }

    /// The equations in its own coordinates, as a kernel takes them.
    pub(crate) fn own_equations(&self) -> &EquationsIn<S, M, C> {
        C::equations(&self.absolute, &self.own)
    }

    pub(crate) fn formulation(&self) -> &F {
        &self.formulation
    }

    /// How often the augmented Lagrangian solved its system in
    /// [`System::rates`](crate::integrate::System::rates); zero for other formulations, and where
    /// no equation is solved.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.iterations
    }

    /// The state that the attributes of the bodies describe.
    ///
    /// # Errors
    /// As [`Dynamics::state_of`]; [`MechanismExt::assemble`](crate::MechanismExt::assemble) mends a
    /// start that opens a joint.
    pub fn initial_state(&self) -> Result<C::State<S>, Fault> {
        self.state_of(&M::initial_state(self.constants()))
    }

    /// How the bodies stand and move in a state; in relative coordinates exactly as the joints of
    /// the tree let them.
    #[must_use]
    pub fn bodies(&self, state: &C::State<S>) -> M::State<S> {
        C::bodies(self.own_constants(), state)
    }

    /// The state in which bodies stand and move so.
    ///
    /// # Errors
    /// A state that is not finite. In relative coordinates
    /// [`StartFault::Inconsistent`](crate::error::StartFault::Inconsistent) where the bodies do not
    /// stand as the joints let them, or move so that one would open within a second, by more than
    /// four digits; smaller violations of the joints of the tree are taken away. There
    /// [`StepFault::StateNotFinite`] where the two axes of a joint are in line.
    pub fn state_of(&self, bodies: &M::State<S>) -> Result<C::State<S>, Fault> {
        let given = bodies;
        let mut bodies = *given;
        turns::count::<S, M>(self.constants(), given, S::zero(), &mut bodies);
        M::rewrap(self.constants(), &mut bodies);
        check_state::<S, M>(&bodies)?;
        if C::IS_RELATIVE {
            let second = (S::zero(), S::one());
            check_start::<S, M>(self.constants(), second, &bodies, true)?;
        }
        let state = C::of_bodies(self.own_constants(), &bodies);
        if state.is_finite() {
            Ok(state)
        } else {
            Err(Fault::Step(StepFault::StateNotFinite))
        }
    }

    /// The state in which bodies stand and move so, or nearly so.
    #[inline(always)]
    pub(crate) fn nearest(&self, bodies: &M::State<S>) -> C::State<S> {
        C::of_bodies(self.own_constants(), bodies)
    }

    /// The same, with those signs of Euler parameters that are nearer to those of another state.
    pub(crate) fn nearest_to(&self, bodies: &M::State<S>, near: &C::State<S>) -> C::State<S> {
        C::of_bodies_near(self.own_constants(), bodies, near)
    }

    /// Readable access to a state of the bodies.
    #[must_use]
    pub fn view<'a>(&'a self, time: S, bodies: &'a M::State<S>) -> View<'a, S, M> {
        View::new(self.constants(), time, bodies)
    }

    /// Evaluates the equations in its own coordinates.
    #[inline(always)]
    pub(crate) fn evaluator(&self) -> Evaluator<'_, S, M, F, A, C> {
        Evaluator {
            equations: C::equations(&self.absolute, &self.own),
            absolute: &self.absolute,
            stabilisation: &self.stabilisation,
            formulation: &self.formulation,
            forces: &self.forces,
        }
    }

    /// Evaluates the equations of the bodies.
    #[inline(always)]
    pub(crate) fn of_bodies(&self) -> Evaluator<'_, S, M, F, A, Absolute<C::Orientation>> {
        Evaluator {
            equations: &self.absolute,
            absolute: &self.absolute,
            stabilisation: &self.stabilisation,
            formulation: &self.formulation,
            forces: &self.forces,
        }
    }

    /// Rates of the state and multipliers, and how often the system was solved.
    ///
    /// # Errors
    /// [`StepFault::Singular`] where constraints depend on each other and the formulation has no
    /// compliance, [`StepFault::NotConverged`] of the augmented Lagrangian, a state or rates that
    /// are not finite.
    #[inline(always)]
    pub fn evaluate(
        &self,
        time: S,
        state: &C::State<S>,
    ) -> Result<(Evaluation<S, M, C>, usize), Fault> {
        let mut evaluation = Evaluation::zeros();
        let iterations = self.evaluate_into(time, state, &mut evaluation)?;
        Ok((evaluation, iterations))
    }

    /// The same, written into a place ([`Evaluation::zeros`] makes one): nothing is copied, which
    /// counts beside a short kernel. What stands there after a fault is of no use.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    #[inline(always)]
    pub fn evaluate_into(
        &self,
        time: S,
        state: &C::State<S>,
        evaluation: &mut Evaluation<S, M, C>,
    ) -> Result<usize, Fault> {
        self.evaluator().evaluate_into(time, state, evaluation)
    }

    /// The kernel of an evaluation in one straight line, and its smallest relative pivot. Nothing
    /// is checked, a closure does not enter and nothing iterates. For measuring.
    #[inline(always)]
    pub fn kernel(
        &self,
        time: S,
        state: &C::State<S>,
        rates: &mut C::State<S>,
        multipliers: &mut C::Multipliers<S>,
    ) -> Pivot<S> {
        self.evaluator().straight(time, state, rates, multipliers)
    }

    /// Rates and multipliers of all joints in a state of the bodies, by the equations in absolute
    /// coordinates: what [`View::reaction`] asks for.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    pub fn evaluate_bodies(
        &self,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<Evaluation<S, M, Absolute>, Fault> {
        have_equations::<M>()?;
        let mut evaluation = Evaluation::<S, M, Absolute<C::Orientation>>::zeros();
        self.of_bodies()
            .evaluate_into(time, bodies, &mut evaluation)?;
        let Evaluation {
            rates,
            multipliers,
            pivot,
        } = evaluation;
        Ok(Evaluation {
            rates,
            multipliers,
            pivot,
        })
    }

    /// How far the accelerations of an evaluation of the bodies are from what the constraints ask:
    /// the largest `|D u' - gamma*|` of a row, relative to the sum of the sizes of its terms and of
    /// what the applied forces would do without constraints; and the row's joint.
    ///
    /// Round-off for rigid constraints; the bias of a [`Penalty`](crate::Penalty), which a motion
    /// gathers; for an augmented Lagrangian what its tolerance, or an acceptance, leaves. It costs
    /// about as much as one evaluation.
    pub fn inconsistency<O: Orientation>(
        &self,
        time: S,
        bodies: &M::State<S>,
        evaluation: &Evaluation<S, M, Absolute<O>>,
    ) -> (S, Option<&'static str>) {
        let read = &with_unit_orientations::<S, M>(bodies);
        let forces = self.all_forces(time, read);
        let Stabilisation { rate, position, .. } = self.stabilisation;
        let constants = self.constants();
        let gamma = stabilised::<S, M, F::Terms>(constants, [rate, position], time, read);
        let accelerations = evaluation.rates.velocities();
        let (row, size) = inconsistency::<S, M>(
            constants,
            (time, read),
            (accelerations, S::zero()),
            &forces,
            &gamma,
        );
        (size, M::REPORT.joint_of(row))
    }

    /// Forces and moments of the closure alone, as [`Mechanism::forces`] has them, in a state whose
    /// Euler parameters have length 1.
    pub(crate) fn applied(&self, time: S, bodies: &M::State<S>) -> M::Velocities<S> {
        self.of_bodies().applied(time, bodies)
    }

    /// Forces and moments of the description and of a closure, in a state whose Euler parameters
    /// have length 1.
    pub(crate) fn all_forces(&self, time: S, bodies: &M::State<S>) -> M::Velocities<S> {
        self.of_bodies().all_forces(time, bodies)
    }
}
