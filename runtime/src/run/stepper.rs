//! Steps for a loop that somebody else owns.

use crate::constraints::projection::Projection;
use crate::dynamics::{Dynamics, Iterations};
use crate::error::Fault;
use crate::error::setting::positive;
use crate::formulation::Formulation;
use crate::integrate::Scheme;
use crate::math::clock::Clock;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, ForceLaw, Loads, NoForces};
use crate::measure::view::View;
use crate::mechanism::kernels::{Mechanism, Normalised, Orientation};
use crate::mechanism::orientations::check_state;

/// A mechanism, a formulation and a one-step method, prepared: takes one step at a time.
///
/// A step has a fixed number of evaluations ([`Rk4`](crate::Rk4) 4,
/// [`DormandPrince5`](crate::integrate::DormandPrince5) 6), allocates nothing and does not panic.
pub struct Stepper<S: Real, M: Mechanism, F: Formulation<S>, K, P = Normalised, A = NoForces> {
    dynamics: Dynamics<S, M, F, P, A>,
    scheme: K,
    clock: Clock<S>,
    projection: Option<Projection<S>>,
}

impl<S: Real, M: Mechanism, F: Formulation<S>, K: Copy, P, A: Clone> Clone
    for Stepper<S, M, F, K, P, A>
{
    fn clone(&self) -> Self {
        Self {
            dynamics: self.dynamics.clone(),
            scheme: self.scheme,
            clock: self.clock,
            projection: self.projection,
        }
    }
}

impl<S: Real, M: Mechanism, F: Formulation<S>, K: Scheme<S>> Stepper<S, M, F, K> {
    /// Prepares the kernels; the time begins at zero.
    ///
    /// # Errors
    /// A parameter of the mechanism or a coefficient of the formulation that is not acceptable.
    pub fn new(mechanism: &M, formulation: F, scheme: K) -> Result<Self, Fault> {
        let dynamics = Dynamics::new(mechanism, formulation)?;
        Ok(Self {
            dynamics,
            scheme,
            clock: Clock::at(S::zero()),
            projection: None,
        })
    }
}

impl<S, M, F, K, P, A> Stepper<S, M, F, K, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Scheme<S>,
    P: Orientation,
{
    /// Begins at a time (s).
    #[must_use]
    pub fn starting_at(mut self, time: S) -> Self {
        self.clock = Clock::at(time);
        self
    }

    /// Corrects the state onto the constraints after every step.
    #[must_use]
    pub fn projection(mut self, projection: Projection<S>) -> Self {
        self.projection = Some(projection);
        self
    }

    /// Reads Euler parameters in another way: `.orientation::<Raw>()`.
    #[must_use]
    pub fn orientation<P2: Orientation>(self) -> Stepper<S, M, F, K, P2, A> {
        let Self {
            dynamics,
            scheme,
            clock,
            projection,
        } = self;
        Stepper {
            dynamics: dynamics.orientation(),
            scheme,
            clock,
            projection,
        }
    }

    /// Applies forces as a function of time and state, see [`Loads`].
    #[must_use]
    pub fn forces<G>(self, law: G) -> Stepper<S, M, F, K, P, ForceLaw<G>>
    where
        G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
    {
        let Self {
            dynamics,
            scheme,
            clock,
            projection,
        } = self;
        Stepper {
            dynamics: dynamics.forces(law),
            scheme,
            clock,
            projection,
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

    /// Readable access to a state at the time that was reached.
    #[must_use]
    pub fn view<'a>(&'a self, state: &'a M::State<S>) -> View<'a, S, M> {
        self.dynamics.view(self.time(), state)
    }

    /// The multipliers of all joints in a state, at the time that was reached and with the inputs
    /// of the last step: what [`View::reaction`] asks for. One evaluation.
    ///
    /// # Errors
    /// As [`Dynamics::evaluate`].
    pub fn multipliers(&self, state: &M::State<S>) -> Result<M::Multipliers<S>, Fault>
    where
        A: AppliedForces<S, M>,
    {
        let (evaluation, _) = self.dynamics.evaluate(self.time(), state)?;
        Ok(evaluation.multipliers)
    }

    /// The prepared dynamics, for evaluations outside a step.
    #[must_use]
    pub fn dynamics(&self) -> &Dynamics<S, M, F, P, A> {
        &self.dynamics
    }

    /// How often the augmented Lagrangian solved its system; zero for other formulations.
    #[must_use]
    pub fn iterations(&self) -> Iterations {
        self.dynamics.iterations()
    }
}

impl<S, M, F, K, P, A> Stepper<S, M, F, K, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    K: Scheme<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    /// Moves the state by one step of `dt` (s).
    ///
    /// The steps add up to the time without a growing error. A mechanism with laws of time refuses
    /// a step below the resolution of the time, [`Fault::StepTooShort`]; without them the time does
    /// not matter.
    ///
    /// # Errors
    /// Why the step could not be done. State and time are then as before.
    pub fn step(&mut self, state: &mut M::State<S>, dt: S) -> Result<(), Fault> {
        let time = self.time();
        let clock = end_of_step::<S, M>(&self.clock, dt)?;
        check_state::<S, M>(state)?;
        if let Some(projection) = self.projection {
            self.projected(state, dt, clock.time(), &projection)?;
        } else {
            self.scheme.step(&mut self.dynamics, time, state, dt)?;
        }
        self.clock = clock;
        Ok(())
    }

    /// A step that is corrected. No part of the other, which has no use for its stack.
    #[inline(never)]
    fn projected(
        &mut self,
        state: &mut M::State<S>,
        dt: S,
        end: S,
        projection: &Projection<S>,
    ) -> Result<(), Fault> {
        let mut next = *state;
        let time = self.time();
        self.scheme.step(&mut self.dynamics, time, &mut next, dt)?;
        let constants = self.dynamics.constants();
        projection.correct_in_motion::<M>(constants, end, &mut next)?;
        *state = next;
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
        state: &mut M::State<S>,
        inputs: &M::Inputs<S>,
        dt: S,
    ) -> Result<(), Fault> {
        self.set_inputs(inputs)?;
        self.step(state, dt)
    }
}

/// The clock after a step, if that is one.
pub(crate) fn end_of_step<S: Real, M: Mechanism>(
    clock: &Clock<S>,
    dt: S,
) -> Result<Clock<S>, Fault> {
    let time = clock.time();
    if positive("step", dt)? < time.ulp() && M::REPORT.time.is_anywhere() {
        return Err(Fault::StepTooShort {
            step: dt.to_f64(),
            time: time.to_f64(),
        });
    }
    Ok(clock.after(dt))
}
