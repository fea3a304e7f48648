//! Steps for a loop that somebody else owns.

use core::fmt::{self, Debug};

use crate::constraints::projection::Projection;
use crate::dynamics::{
    Bodies, Dynamics, Iterations, Posed, Problem, Solvable, State, UnderWay, WithCapacityFactor,
    WithCoordinates, WithForces, WithInteractions, WithLaw,
};
use crate::error::setting::positive;
use crate::error::{Fault, ParameterError, StepFault};
use crate::formulation::Formulation;
use crate::integrate::{OneStep, Scheme, System as _};
use crate::math::clock::Clock;
use crate::math::scalar::Real;
use crate::measure::interacting::{Heeding, Interacting, Unlimited};
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::measure::scaled::ScaledCapacity;
use crate::measure::view::View;
use crate::mechanism::coordinates::{Absolute, Coordinates, Relative};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{InputsOf, Mechanism, Orientation};
use crate::nonsmooth::described::Beside;
use crate::nonsmooth::handle::InteractionHandle;
use crate::nonsmooth::interaction::Interaction;

/// A mechanism, a formulation and a one-step method, prepared: takes one step at a time.
///
/// ```
/// use holonom::prelude::*;
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
/// let mut stepper = rod.stepper(StandardLagrange, Rk4)?;
/// let mut start = rod.described_state()?;
/// rod.set_angle(&mut start, hinge, 0.5)?;
/// let mut state = stepper.state_of(&start)?;
/// for _ in 0..200 {
///     stepper.step(&mut state, 1e-3)?;
/// }
/// let bodies = stepper.bodies(&state);
/// let view = stepper.view(&bodies);
/// assert!(view.angle(hinge) < 0.4 && view.violation() < 1e-30);
/// # Ok::<(), Fault>(())
/// ```
///
/// `P` is the [`Problem`] that is solved, `K` the method.
///
/// A step has a fixed number of evaluations ([`Rk4`](crate::Rk4) 4,
/// [`DormandPrince5`](crate::integrate::DormandPrince5) 6), allocates nothing and does not panic.
///
/// The equations of motion are solved in the coordinates that the attribute of the mechanism names,
/// or in others that are asked for. In absolute coordinates a state is one of the bodies. In
/// relative ones it is a [`JointCoordinates::JointState`]: a start is set in a state of the bodies,
/// by handle as ever, and [`Stepper::state_of`] takes it over; what is to be read is read of
/// [`Stepper::bodies`]. Joints of the tree cannot open there; equations that close loops drift or
/// are stabilised, as the formulation has it.
///
/// It has no warnings. A step over the zero of a law that switches is of first order. So is one in
/// which two points pass each other closely, where a force acts along their line
/// ([`switches`](crate::guide::switches#limits)).
pub struct Stepper<P: Solvable, K> {
    pub(crate) dynamics: Dynamics<UnderWay<P>>,
    pub(crate) scheme: K,
    pub(super) clock: Clock<P::Number>,
    projection: Option<Projection<P::Number>>,
    /// Whether the settings of interactions were accepted.
    pub(super) has_begun: bool,
    /// The state that the last step with contacts led to.
    pub(super) left: Option<State<P>>,
}

impl<P: Solvable<Forces: Clone>, K: Copy> Clone for Stepper<P, K> {
    fn clone(&self) -> Self {
        Self {
            dynamics: self.dynamics.clone(),
            scheme: self.scheme,
            clock: self.clock,
            projection: self.projection,
            has_begun: self.has_begun,
            left: self.left,
        }
    }
}

/// The name of the mechanism, and the method.
impl<P: Solvable, K: Debug> Debug for Stepper<P, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Stepper")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("method", &self.scheme)
            .finish_non_exhaustive()
    }
}

impl<M, F, S, K> Stepper<Problem<M, F, S>, K>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    K: Scheme<S>,
{
    /// Prepares the kernels in the coordinates that the attribute of the mechanism names; the time
    /// begins at zero.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F, scheme: K) -> Result<Self, Fault> {
        let dynamics = Dynamics::new(mechanism, formulation)?;
        let forces = Heeding::new(NoForces, dynamics.parameters());
        Ok(Self {
            dynamics: dynamics.with_forces(forces),
            scheme,
            clock: Clock::at(S::zero()),
            projection: None,
            has_begun: false,
            left: None,
        })
    }
}

impl<P: Solvable, K: Scheme<P::Number>> Stepper<P, K> {
    fn exchange<Q: Solvable<Number = P::Number>>(
        self,
        exchange: impl FnOnce(Dynamics<UnderWay<P>>) -> Dynamics<UnderWay<Q>>,
    ) -> Stepper<Q, K> {
        Stepper {
            dynamics: exchange(self.dynamics),
            scheme: self.scheme,
            clock: self.clock,
            projection: self.projection,
            has_begun: false,
            left: None,
        }
    }

    /// With other forces, or other interactions.
    fn exchange_forces<A: AppliedForces<P::Number, P::Mechanism>>(
        self,
        exchange: impl FnOnce(P::Forces) -> A,
    ) -> Stepper<WithForces<P, A>, K> {
        let parameters = *self.dynamics.parameters();
        self.exchange(|dynamics| {
            dynamics.exchange_forces(|old| Heeding::new(exchange(old.into_forces()), &parameters))
        })
    }

    /// Begins at a time (s).
    #[must_use]
    pub fn starting_at(mut self, time: P::Number) -> Self {
        self.clock = Clock::at(time);
        self
    }

    /// Corrects the state onto the constraints after every step.
    #[must_use]
    pub fn projection(mut self, projection: Projection<P::Number>) -> Self {
        self.projection = Some(projection);
        self
    }

    /// Applies forces as a function of time and state of the bodies, see [`Loads`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> Stepper<WithLaw<P, G>, K>
    where
        G: Fn(P::Number, &Bodies<P>, &mut Loads<'_, P::Number, P::Mechanism>),
    {
        self.exchange_forces(|forces| forces.with(ForceLaw(law)))
    }

    /// Adds limits, dry friction, brakes and clutches, see
    /// [`Simulation::interactions`](crate::Simulation::interactions).
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let (rod, h) = (Rod::default(), Rod::HANDLES);
    /// let limits = Interaction::limits(h.hinge.angle(), [-1.0, 1.0]).restitution(0.5);
    /// let mut stepper = rod.stepper(StandardLagrange, Rk4)?
    ///     .interactions([limits]);
    /// let mut state = stepper.initial_state()?;
    /// for _ in 0..4000 {
    ///     stepper.step(&mut state, 1e-3)?;
    /// }
    /// let bodies = stepper.bodies(&state);
    /// assert!((stepper.view(&bodies).angle(h.hinge) + 1.0).abs() < 1e-9); // it rests there
    /// # Ok::<(), Fault>(())
    /// ```
    #[must_use]
    pub fn interactions<const N: usize, const ALL: usize>(
        self,
        interactions: [Interaction<P::Number, P::Mechanism>; N],
    ) -> Stepper<WithInteractions<P, ALL>, K>
    where
        P::Mechanism: Beside<N, ALL>,
    {
        const {
            assert!(
                !P::Forces::INTERACTS,
                "`interactions` are said once, in one list"
            )
        };
        self.exchange_forces(|forces| Interacting::new(forces, P::Mechanism::beside(interactions)))
    }

    /// Multiplies the capacity of dry friction, of a brake or of a clutch by a function of the
    /// motion and of the inputs, see
    /// [`Simulation::capacity_factor`](crate::Simulation::capacity_factor).
    #[must_use]
    pub fn capacity_factor<G>(
        self,
        interaction: InteractionHandle<P::Mechanism>,
        factor: G,
    ) -> Stepper<WithCapacityFactor<P, G>, K>
    where
        G: Fn(&View<'_, P::Number, P::Mechanism>, &InputsOf<P::Mechanism, P::Number>) -> P::Number,
    {
        const {
            assert!(
                P::Forces::INTERACTS,
                "`capacity_factor` is said behind `interactions`"
            )
        };
        self.exchange_forces(|forces| ScaledCapacity::new(forces, interaction, factor))
    }

    /// Passes the limits of the description as if there were none, see
    /// [`Simulation::without_limits`](crate::Simulation::without_limits).
    #[must_use]
    pub fn without_limits(self) -> Stepper<WithForces<P, Unlimited<P::Forces>>, K> {
        self.exchange_forces(Unlimited)
    }

    /// Solves the equations of motion in other coordinates: `.coordinates::<Relative>()`.
    #[must_use]
    pub fn coordinates<C>(self) -> Stepper<WithCoordinates<P, C>, K>
    where
        C: Coordinates<P::Mechanism>,
    {
        self.exchange(Dynamics::coordinates)
    }

    /// Solves the equations of motion in relative (joint) coordinates.
    #[must_use]
    pub fn joint_coordinates(self) -> Stepper<WithCoordinates<P, Relative>, K>
    where
        P::Mechanism: JointCoordinates,
    {
        self.coordinates()
    }

    /// Solves the equations of motion in absolute coordinates.
    #[must_use]
    pub fn absolute_coordinates(self) -> Stepper<WithCoordinates<P, Absolute>, K> {
        self.coordinates()
    }

    /// Absolute coordinates with other rates of Euler parameters.
    #[doc(hidden)]
    #[must_use]
    pub fn orientation<O: Orientation>(self) -> Stepper<WithCoordinates<P, Absolute<O>>, K> {
        self.coordinates()
    }

    /// The time that was reached (s).
    #[must_use]
    pub fn time(&self) -> P::Number {
        self.clock.time()
    }

    /// Takes the present inputs and parameters of the mechanism, to be called between steps, and
    /// the limits of the description that depend on them.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    /// [`StartFault::InteractionSetting`](crate::error::StartFault::InteractionSetting) of a limit.
    pub fn update(&mut self, mechanism: &P::Mechanism) -> Result<(), Fault> {
        self.dynamics.update(mechanism)?;
        self.dynamics.renew_limits()
    }

    /// Takes these inputs, to be called between steps: in the number type of the run, at the cost
    /// of what depends on inputs.
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    #[inline]
    pub fn set_inputs(
        &mut self,
        inputs: &InputsOf<P::Mechanism, P::Number>,
    ) -> Result<(), ParameterError> {
        self.dynamics.set_inputs(inputs)
    }

    /// The state that the attributes of the bodies describe.
    ///
    /// # Errors
    /// As [`Dynamics::initial_state`].
    pub fn initial_state(&self) -> Result<State<P>, Fault> {
        self.dynamics.initial_state()
    }

    /// The state in which bodies stand and move so.
    ///
    /// # Errors
    /// As [`Dynamics::state_of`].
    pub fn state_of(&self, bodies: &Bodies<P>) -> Result<State<P>, Fault> {
        self.dynamics.state_of(bodies)
    }

    /// How the bodies stand and move in a state.
    #[must_use]
    pub fn bodies(&self, state: &State<P>) -> Bodies<P> {
        self.dynamics.bodies(state)
    }

    /// Readable access to a state of the bodies at the time that was reached.
    #[must_use]
    pub fn view<'a>(&'a self, bodies: &'a Bodies<P>) -> View<'a, P::Number, P::Mechanism> {
        self.dynamics.view(self.time(), bodies)
    }

    /// The multipliers of all joints in a state of the bodies, at the time that was reached and
    /// with the inputs of the last step: what [`View::reaction`] asks for. One evaluation in
    /// absolute coordinates.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    pub fn multipliers(
        &self,
        bodies: &Bodies<P>,
    ) -> Result<<P::Mechanism as Mechanism>::Multipliers<P::Number>, Fault> {
        let evaluation = self.dynamics.evaluate_bodies(self.time(), bodies)?;
        Ok(evaluation.multipliers)
    }

    /// The prepared dynamics, for evaluations outside a step; with interactions in their modes.
    #[must_use]
    pub fn dynamics(&self) -> &Dynamics<UnderWay<P>> {
        &self.dynamics
    }

    /// How often the augmented Lagrangian solved its system; zero for other formulations, and where
    /// no equation is solved.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.dynamics.iterations()
    }
}

impl<P: Solvable, K: Steps<P>> Stepper<P, K> {
    /// Moves the state by one step of `dt` (s).
    ///
    /// With limits of the description or other interactions it finds the modes at its start, so
    /// inputs may jump there, and those that begin and end within it. A step is then looked into at
    /// 18 instants. Each mode that ends begins a further step over the rest, of which there are at
    /// most 8, and 4 for each interaction. So the cost is bounded.
    ///
    /// The steps add up to the time without a growing error. A mechanism with laws of time refuses
    /// a step below the resolution of the time, [`StepFault::TooShort`]; without them the time does
    /// not matter.
    ///
    /// # Errors
    /// Why the step could not be done; with interactions those of
    /// [`Simulation::interactions`](crate::Simulation::interactions). State, time and modes are
    /// then as before.
    pub fn step(&mut self, state: &mut State<P>, dt: P::Number) -> Result<(), Fault> {
        if <UnderWay<P> as Posed>::Forces::INTERACTS {
            return self.step_with_modes(state, dt);
        }
        let time = self.time();
        let clock = self.checked(state, dt)?;
        if let Some(projection) = self.projection {
            self.projected(state, dt, clock.time(), &projection)?;
        } else {
            self.scheme.step(&mut self.dynamics, time, state, dt)?;
        }
        self.clock = clock;
        Ok(())
    }

    /// The clock after a step from a state, if both can be.
    #[inline]
    pub(crate) fn checked(
        &self,
        state: &State<P>,
        dt: P::Number,
    ) -> Result<Clock<P::Number>, Fault> {
        let clock = end_of_step::<P::Number, P::Mechanism>(&self.clock, dt)?;
        if !P::Coordinates::IS_RELATIVE {
            P::Coordinates::check(state)?;
        }
        Ok(clock)
    }

    /// Ends a step that was looked into with a state after `dt` (s).
    pub(crate) fn end_step(
        &mut self,
        state: &mut State<P>,
        mut next: State<P>,
        dt: P::Number,
    ) -> Result<(), Fault> {
        let clock = self.clock.after(dt);
        self.dynamics.renormalise(&mut next, None);
        *state = match self.projection {
            Some(projection) => self.corrected(&next, clock.time(), &projection)?,
            None => next,
        };
        self.clock = clock;
        Ok(())
    }

    /// A step that is corrected. No part of the other, which has no use for its stack.
    #[inline(never)]
    fn projected(
        &mut self,
        state: &mut State<P>,
        dt: P::Number,
        end: P::Number,
        projection: &Projection<P::Number>,
    ) -> Result<(), Fault> {
        let mut next = *state;
        let time = self.time();
        self.scheme.step(&mut self.dynamics, time, &mut next, dt)?;
        *state = self.corrected(&next, end, projection)?;
        Ok(())
    }

    fn corrected(
        &self,
        next: &State<P>,
        end: P::Number,
        projection: &Projection<P::Number>,
    ) -> Result<State<P>, Fault> {
        let mut bodies = self.dynamics.bodies(next);
        let constants = self.dynamics.constants();
        projection.correct_in_motion::<P::Mechanism>(constants, end, &mut bodies)?;
        Ok(self.dynamics.nearest_to(&bodies, next))
    }

    /// The same with these inputs over the step, which stay until others are set: also where the
    /// step is refused for another reason than they.
    ///
    /// # Errors
    /// As [`Self::step`], and an input that is not finite. State and time are then as before.
    #[inline]
    pub fn step_with(
        &mut self,
        state: &mut State<P>,
        inputs: &InputsOf<P::Mechanism, P::Number>,
        dt: P::Number,
    ) -> Result<(), Fault> {
        self.set_inputs(inputs)?;
        self.step(state, dt)
    }
}

/// Schemes that step a problem `P`. It is implemented by every scheme for its equations; a function
/// that is generic over schemes asks for it.
pub trait Steps<P: Solvable>: OneStep<P::Number, Dynamics<UnderWay<P>>> {}

impl<P: Solvable, K: OneStep<P::Number, Dynamics<UnderWay<P>>>> Steps<P> for K {}

/// The clock after a step, if that is one.
pub(crate) fn end_of_step<S: Real, M: Mechanism>(
    clock: &Clock<S>,
    dt: S,
) -> Result<Clock<S>, Fault> {
    let time = clock.time();
    if positive("step", dt)? < time.ulp() && M::REPORT.time.is_anywhere() {
        return Err(Fault::Step(StepFault::TooShort {
            step: dt.to_f64(),
            time: time.to_f64(),
        }));
    }
    Ok(clock.after(dt))
}
