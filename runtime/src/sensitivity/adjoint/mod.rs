//! The gradient of a cost over steps, by what is set anew for each of them (discrete adjoint).
//!
//! Forward sensitivities cost a run for every few directions. Here the steps are taken once, and
//! then gone through backwards: what the rest of the cost changes by with the state at a step, its
//! adjoint, is carried back by the derivatives of that step alone (Griewank and Walther,
//! *Evaluating Derivatives*, chapter 3; Hager, *Runge-Kutta methods in optimal control and the
//! transformed adjoint system*, 2000). So all controls of all steps together cost some runs.
//!
//! A step is gone through backwards by the kernel of `kernels = [adjoint]` where that is there
//! (`transposed.rs`), else by steps over numbers that carry derivatives (`back.rs`). What is
//! carried is by all that a state is made of (`slopes.rs`): nothing follows anything else but at
//! the start. What the cost reads at an instant is made when it is read (`instant.rs`).

mod back;
mod instant;
mod slopes;
mod transposed;

use core::fmt::{self, Debug};
use std::vec;
use std::vec::Vec;

use nalgebra::SVector;

use self::back::Backwards;
pub use self::instant::Instant;
use self::transposed::Transposed;
use super::Differentiable;
use crate::dynamics::{Dynamics, Posed, Problem};
use crate::error::setting::positive;
use crate::error::{AnalysisFault, Fault, StartFault, Unheeding};
use crate::formulation::Formulation;
use crate::forward::Lifted;
use crate::independent::IndependentCoordinates;
use crate::integrate::{Evaluated, FixedStep, OneStep, Scheme, recorded};
use crate::math::scalar::Real;
use crate::mechanism::coordinates::Relative;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::{Mechanism as _, Terms as _};
use crate::nonsmooth::described::refuse_limits;

/// The directions that one step takes, as many as [`Lifted`] numbers have.
const LANES: usize = 4;

/// A mechanism by its joints.
type ByJoints<M, F, S> = Problem<M, F, S, Relative>;

/// Its equations.
type Steps<S, M, F> = Dynamics<ByJoints<M, F, S>>;

/// A mechanism, a formulation and an explicit method of a fixed step, along which costs have
/// gradients: by [`IndependentCoordinates::adjoint`].
///
/// `P` is the [`Problem`] that is solved, by joints, `K` the method.
pub struct Adjoint<'a, P: Posed<Mechanism: JointRates>, K, const N: usize> {
    space: &'a IndependentCoordinates<P::Mechanism, N, P::Number>,
    formulation: P::Formulation,
    integrator: FixedStep<P::Number, K>,
}

impl<P, K: Debug, const N: usize> Debug for Adjoint<'_, P, K, N>
where
    P: Posed<Mechanism: JointRates, Formulation: Debug>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Adjoint")
            .field("mechanism", &P::Mechanism::REPORT.name)
            .field("formulation", &self.formulation)
            .field("integrator", &self.integrator)
            .finish()
    }
}

/// A cost over steps, with its gradient: by [`Adjoint::gradient`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gradient<X, const N: usize, const U: usize, const P: usize, S = f64> {
    /// The sum of what the cost was at all instants.
    pub cost: S,
    /// By the controls of each step.
    pub by_controls: Vec<[S; U]>,
    /// By the coordinates at the start; of a ball by small turns along the axes of its rates.
    pub by_positions: SVector<S, N>,
    /// By the rates at the start.
    pub by_rates: SVector<S, N>,
    /// By the values that stay.
    pub by_values: [S; P],
    /// The states: the start, and those after each step.
    pub states: Vec<X>,
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// Steps of a fixed length, from the time of the space on, along which
    /// [`gradient`](Adjoint::gradient) takes the gradient of a cost by the controls of every step:
    /// inputs that are held for one each.
    ///
    /// ```
    /// use holonom::Forward;
    /// use holonom::prelude::*;
    ///
    /// /// A cart of 1 kg that a force pushes.
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints", kernels = [adjoint])]
    /// struct Cart {
    ///     #[input]
    ///     push: f64,
    ///     #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    ///     cart: Body,
    ///     #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     rail: Prismatic,
    ///     #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [push, 0.0, 0.0])]
    ///     motor: PointForce,
    /// }
    ///
    /// let (cart, h) = (Cart::default(), Cart::HANDLES);
    /// let space = cart.coordinates([h.rail])?;
    /// let start = space.state([0.0], [0.0])?;
    /// let run = space.adjoint(StandardLagrange, Rk4::every(0.1));
    /// // To 1 m in 1 s, by the controls of ten steps, with steepest descent.
    /// let mut controls = [[0.0]; 10];
    /// for _ in 0..100 {
    ///     let found = run.gradient(&start, [h.push], &controls, [], |instant| {
    ///         let off = instant.displacement(h.rail) - Forward::fixed(1.0);
    ///         match instant.controls() {
    ///             Some([push]) => Forward::fixed(1e-3) * push * push,
    ///             None => Forward::fixed(100.0) * off * off,
    ///         }
    ///     })?;
    ///     for (control, slope) in controls.iter_mut().zip(&found.by_controls) {
    ///         control[0] -= 0.1 * slope[0];
    ///     }
    /// }
    /// // The first push counts most: it acts for the longest time.
    /// assert!(controls[0][0] > 2.5 && controls[9][0] < 0.3);
    /// # Ok::<(), Fault>(())
    /// ```
    #[must_use]
    pub const fn adjoint<F, K>(
        &self,
        formulation: F,
        integrator: FixedStep<S, K>,
    ) -> Adjoint<'_, ByJoints<M, F, S>, K, N> {
        Adjoint {
            space: self,
            formulation,
            integrator,
        }
    }
}

impl<M, F, K, const N: usize, S> Adjoint<'_, ByJoints<M, F, S>, K, N>
where
    M: JointRates,
    S: Real,
    F: Formulation<S> + Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
    K: Copy
        + Scheme<S>
        + OneStep<S, Steps<S, M, F>>
        + OneStep<Lifted<S>, Steps<Lifted<S>, M, F::Carrying>>,
    FixedStep<S, K>: Differentiable<S, LANES>,
{
    /// Takes a step for each of the controls, which are held for it, and the gradient of the sum of
    /// a cost at all instants: before each step, and at the end.
    ///
    /// `held` are the inputs that controls are of, `values` parameters and inputs that stay. The
    /// others are those of the space, and so are the held ones at the end, where no step begins. A
    /// parameter leaves the coordinates and rates of the start as they are; what is not chosen
    /// follows there.
    ///
    /// The gradient is that of the steps as they are taken. In closed loops they leave the
    /// constraints a little, which is part of it. Of a law that bends at a switch it is that of the
    /// sides where the stages are.
    ///
    /// # Errors
    /// - What a step refuses, and [`IndependentCoordinates::mass`].
    /// - [`AnalysisFault::NoPosition`] of a cost that reads [`Instant::positions`] where a turn of
    ///   a ball or of a free body is chosen: an orientation is no coordinate.
    /// - [`AnalysisFault::GivenTwice`]: a value that stands twice among `held` and `values`.
    ///   [`StartFault::Setting`]: a step that is not positive.
    /// - [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite): a cost or its
    ///   gradient is not finite.
    /// - [`StartFault::SwitchLeftOut`] of laws that jump, [`StartFault::LimitsLeftOut`] of limits
    ///   in the description, unless the space is
    ///   [`without_limits`](IndependentCoordinates::without_limits).
    pub fn gradient<const U: usize, const P: usize>(
        &self,
        start: &M::JointState<S>,
        held: [ValueHandle<M>; U],
        controls: &[[S; U]],
        values: [ValueHandle<M>; P],
        cost: impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<Gradient<M::JointState<S>, N, U, P, S>, Fault> {
        if !self.space.passes_limits {
            refuse_limits::<M>(Unheeding::Derivatives)?;
        }
        let mut jumps = M::SWITCHES.iter().filter(|switch| !switch.is_continuous);
        if let Some(switch) = jumps.next() {
            return Err(Fault::Start(StartFault::SwitchLeftOut { law: switch.law }));
        }
        positive("step", self.integrator.step)?;
        if let Some(value) = twice(&held, &values) {
            return Err(Fault::Analysis(AnalysisFault::GivenTwice { value }));
        }
        let mut transposed = self.transposed((&held, &values), controls.len())?;
        let stages = transposed.as_mut().map(Transposed::stages);
        let states = self.states(start, held, controls, stages)?;
        let mut along = Backwards::new(self, held, values, transposed)?;
        let mut by_controls = vec![[S::zero(); U]; controls.len()];
        for (number, state) in states.iter().enumerate().rev() {
            let ends = (state, states.get(number + 1));
            let found = along.before(number, ends, controls.get(number), &cost)?;
            if let Some(place) = by_controls.get_mut(number) {
                *place = found;
            }
        }
        let found = along.found(by_controls, states)?;
        if found.is_finite() {
            Ok(found)
        } else {
            Err(crate::independent::not_finite())
        }
    }

    /// How steps are gone through by the kernel, where it is there and has what is asked for.
    fn transposed(
        &self,
        values: (&[ValueHandle<M>], &[ValueHandle<M>]),
        steps: usize,
    ) -> Result<Option<Transposed<M, S>>, Fault> {
        // Without equations the formulation is nothing.
        let has_rows = !M::JOINT_REPORT.closing.is_empty();
        if M::ADJOINT_BY.is_none() || has_rows && (F::ITERATED || F::Terms::COMPLIANT) {
            return Ok(None);
        }
        let dynamics = by_joints::<S, M, F>(self.space.parameters, self.formulation)?;
        let coefficients = dynamics.own_equations().coefficients;
        Ok(Transposed::new(
            self.integrator,
            coefficients,
            values,
            steps,
        ))
    }

    /// The time (s) of an instant.
    fn time(&self, number: usize) -> S {
        S::constant(number as f64).fused(self.integrator.step, self.space.time())
    }

    /// The states before each step and after the last. Where it is wanted, times and states at the
    /// stages of all steps.
    fn states<const U: usize>(
        &self,
        start: &M::JointState<S>,
        held: [ValueHandle<M>; U],
        controls: &[[S; U]],
        mut stages: Option<&mut Vec<Evaluated<S, M::JointState<S>>>>,
    ) -> Result<Vec<M::JointState<S>>, Fault> {
        let mut space = *self.space;
        let mut dynamics = by_joints::<S, M, F>(space.parameters, self.formulation)?;
        let mut states = Vec::with_capacity(controls.len() + 1);
        let mut state = *start;
        states.push(state);
        for (number, controls) in controls.iter().enumerate() {
            space.set_values(&held, controls)?;
            if are_inputs::<M>(&held) {
                dynamics.set_inputs(&M::inputs_of(&space.parameters))?;
            } else {
                dynamics = by_joints::<S, M, F>(space.parameters, self.formulation)?;
            }
            let time = self.time(number);
            let FixedStep { step, scheme } = self.integrator;
            match &mut stages {
                Some(stages) => {
                    recorded(&scheme, &mut dynamics, time, &mut state, step, stages)?;
                }
                None => scheme.step(&mut dynamics, time, &mut state, step)?,
            }
            states.push(state);
        }
        Ok(states)
    }
}

impl<X, const N: usize, const U: usize, const P: usize, S: Real> Gradient<X, N, U, P, S> {
    fn is_finite(&self) -> bool {
        let start = self.by_positions.iter().chain(&self.by_rates);
        let all = start.chain(&self.by_values);
        let mut all = all.chain(self.by_controls.iter().flatten());
        self.cost.is_finite() && all.all(|slope| slope.is_finite())
    }
}

fn by_joints<S: Real, M: JointRates, F: Formulation<S>>(
    parameters: M::Parameters<S>,
    formulation: F,
) -> Result<Steps<S, M, F>, Fault> {
    let dynamics = Dynamics::<Problem<M, F, S>>::of_parameters(parameters, formulation)?;
    Ok(dynamics.joint_coordinates())
}

/// The field of a value that stands twice among these.
fn twice<M: JointRates>(
    held: &[ValueHandle<M>],
    values: &[ValueHandle<M>],
) -> Option<&'static str> {
    let all = held.iter().chain(values).map(|value| value.index());
    let mut numbered = all.clone().enumerate();
    let found =
        numbered.find(|&(number, value)| all.clone().take(number).any(|other| other == value));
    found.and_then(|(_, value)| Some(M::REPORT.values.get(value)?.name))
}

/// Whether these are inputs, which need no preparation.
fn are_inputs<M: JointRates>(values: &[ValueHandle<M>]) -> bool {
    let mut infos = values
        .iter()
        .map(|value| M::REPORT.values.get(value.index()));
    infos.all(|info| info.is_some_and(|info| info.is_input))
}
