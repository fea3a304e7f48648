//! The gradient of a cost over steps, by what is set anew for each of them (discrete adjoint).
//!
//! Forward sensitivities cost a run for every few directions. Here the steps are taken once, and
//! then gone through backwards: what the rest of the cost changes by with the state at a step, its
//! adjoint, is carried back by the derivatives of that step alone (Griewank and Walther,
//! *Evaluating Derivatives*, chapter 3; Hager, *Runge-Kutta methods in optimal control and the
//! transformed adjoint system*, 2000). So all controls of all steps together cost some runs.

use core::fmt::{self, Debug};
use core::ops::Deref;
use std::vec;
use std::vec::Vec;

use nalgebra::SVector;

use super::Differentiable;
use crate::dynamics::{Dynamics, Posed, Problem};
use crate::error::{Fault, LeavesOut, StartFault, Unheeding};
use crate::formulation::Formulation;
use crate::forward::{Forward, Lifted, lifted};
use crate::independent::{Along, IndependentCoordinates};
use crate::integrate::{FixedStep, OneStep, Scheme};
use crate::math::scalar::{Real, Scalar};
use crate::measure::view::View;
use crate::mechanism::coordinates::Relative;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::{Mechanism as _, bodies_alone};
use crate::nonsmooth::described::refuse_limits;
use crate::state::vector::Array as _;

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
    /// By the coordinates at the start.
    pub by_positions: SVector<S, N>,
    /// By the rates at the start.
    pub by_rates: SVector<S, N>,
    /// By the values that stay.
    pub by_values: [S; P],
    /// The states: the start, and those after each step.
    pub states: Vec<X>,
}

/// What a cost may read: a [`View`], over numbers that carry derivatives.
pub struct Instant<'a, M: JointRates, const U: usize, S: Real = f64> {
    view: View<'a, Lifted<S>, M>,
    number: usize,
    controls: Option<[Lifted<S>; U]>,
}

impl<M: JointRates, const U: usize, S: Real> Instant<'_, M, U, S> {
    /// How many steps were taken before.
    #[must_use]
    pub const fn number(&self) -> usize {
        self.number
    }

    /// The controls of the step that begins here; `None` at the end.
    #[must_use]
    pub const fn controls(&self) -> Option<[Lifted<S>; U]> {
        self.controls
    }

    /// Whether no step begins here.
    #[must_use]
    pub const fn is_end(&self) -> bool {
        self.controls.is_none()
    }
}

impl<'a, M: JointRates, const U: usize, S: Real> Deref for Instant<'a, M, U, S> {
    type Target = View<'a, Lifted<S>, M>;

    fn deref(&self) -> &Self::Target {
        &self.view
    }
}

impl<M: JointRates, const U: usize, S: Real> Debug for Instant<'_, M, U, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Instant")
            .field("number", &self.number)
            .finish_non_exhaustive()
    }
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
    /// #[mechanism(coordinates = "joints", kernels = [mass])]
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
    /// others are those of the space. A parameter leaves the coordinates and rates of the start as
    /// they are.
    ///
    /// In closed loops the gradient is that of states that satisfy the constraints, as those of
    /// [`IndependentCoordinates::state`] do.
    ///
    /// # Errors
    /// - What a step refuses, and [`IndependentCoordinates::mass`].
    /// - [`StepFault::RatesNotFinite`](crate::error::StepFault::RatesNotFinite): a cost or its
    ///   gradient is not finite.
    /// - [`StartFault::StateLeftOut`] of states of the user's own, [`StartFault::SwitchLeftOut`] of
    ///   laws that switch, [`StartFault::LimitsLeftOut`] of limits in the description, unless the
    ///   space is [`without_limits`](IndependentCoordinates::without_limits).
    pub fn gradient<const U: usize, const P: usize>(
        &self,
        start: &M::JointState<S>,
        held: [ValueHandle<M>; U],
        controls: &[[S; U]],
        values: [ValueHandle<M>; P],
        cost: impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<Gradient<M::JointState<S>, N, U, P, S>, Fault> {
        bodies_alone::<M>(LeavesOut::Linearisation)?;
        if !self.space.passes_limits {
            refuse_limits::<M>(Unheeding::Derivatives)?;
        }
        if let Some(switch) = M::SWITCHES.first() {
            return Err(Fault::Start(StartFault::SwitchLeftOut { law: switch.law }));
        }
        let states = self.states(start, held, controls)?;
        let carrying = self.formulation.carrying();
        let mut along = Backwards {
            adjoint: self,
            held,
            values,
            space: *self.space,
            dynamics: by_joints(lifted(&self.space.parameters), carrying)?,
            cost: S::zero(),
            by_positions: [S::zero(); N],
            by_rates: [S::zero(); N],
            by_values: [S::zero(); P],
        };
        let mut by_controls = vec![[S::zero(); U]; controls.len()];
        for (number, state) in states.iter().enumerate().rev() {
            let found = along.before(number, state, controls.get(number), &cost)?;
            if let Some(place) = by_controls.get_mut(number) {
                *place = found;
            }
        }
        let found = Gradient {
            cost: along.cost,
            by_controls,
            by_positions: along.by_positions.into(),
            by_rates: along.by_rates.into(),
            by_values: along.by_values,
            states,
        };
        if found.is_finite() {
            Ok(found)
        } else {
            Err(crate::independent::not_finite())
        }
    }

    /// The time (s) of an instant.
    fn time(&self, number: usize) -> S {
        S::constant(number as f64).fused(self.integrator.step, self.space.time())
    }

    /// The states before each step and after the last.
    fn states<const U: usize>(
        &self,
        start: &M::JointState<S>,
        held: [ValueHandle<M>; U],
        controls: &[[S; U]],
    ) -> Result<Vec<M::JointState<S>>, Fault> {
        let mut space = *self.space;
        let mut dynamics = by_joints::<S, M, F>(space.parameters, self.formulation)?;
        let mut states = Vec::with_capacity(controls.len() + 1);
        let mut state = *start;
        states.push(state);
        for (number, controls) in controls.iter().enumerate() {
            for (&input, &control) in held.iter().zip(controls) {
                space.set_value(input, control)?;
            }
            if are_inputs::<M>(&held) {
                dynamics.set_inputs(&M::inputs_of(&space.parameters))?;
            } else {
                dynamics = by_joints::<S, M, F>(space.parameters, self.formulation)?;
            }
            let (time, step) = (self.time(number), self.integrator.step);
            self.integrator
                .scheme
                .step(&mut dynamics, time, &mut state, step)?;
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

/// Whether these are inputs, which need no preparation.
fn are_inputs<M: JointRates>(values: &[ValueHandle<M>]) -> bool {
    let mut infos = values
        .iter()
        .map(|value| M::REPORT.values.get(value.index()));
    infos.all(|info| info.is_some_and(|info| info.is_input))
}

/// What a direction belongs to.
#[derive(Clone, Copy)]
enum Part {
    Position,
    Rate,
    Control,
    Value,
}

/// The way back: what the cost from a step on changes by with the state there.
struct Backwards<'a, M, F, K, const N: usize, const U: usize, const P: usize, S>
where
    M: JointRates,
    S: Real,
    F: Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
{
    adjoint: &'a Adjoint<'a, ByJoints<M, F, S>, K, N>,
    held: [ValueHandle<M>; U],
    values: [ValueHandle<M>; P],
    /// With the controls and the time of a step.
    space: IndependentCoordinates<M, N, S>,
    dynamics: Steps<Lifted<S>, M, F::Carrying>,
    cost: S,
    by_positions: [S; N],
    by_rates: [S; N],
    by_values: [S; P],
}

impl<M, F, K, const N: usize, const U: usize, const P: usize, S> Backwards<'_, M, F, K, N, U, P, S>
where
    M: JointRates,
    S: Real,
    F: Formulation<S> + Differentiable<S, LANES, Carrying: Formulation<Lifted<S>>>,
    K: Copy + OneStep<S, Steps<S, M, F>> + OneStep<Lifted<S>, Steps<Lifted<S>, M, F::Carrying>>,
    FixedStep<S, K>: Differentiable<S, LANES>,
{
    /// Goes back before a step, or to the end of all; the derivatives by its controls.
    fn before(
        &mut self,
        number: usize,
        state: &M::JointState<S>,
        controls: Option<&[S; U]>,
        cost: &impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<[S; U], Fault> {
        self.space.set_time(self.adjoint.time(number));
        for (&input, &control) in self.held.iter().zip(controls.into_iter().flatten()) {
            self.space.set_value(input, control)?;
        }
        let mut by_positions = [S::zero(); N];
        let mut by_rates = [S::zero(); N];
        let mut by_controls = [S::zero(); U];
        let positions = (0..N).map(|column| (Part::Position, column, Along::Position(column)));
        let rates = (0..N).map(|column| (Part::Rate, column, Along::Rate(column)));
        let value = |part: Part| {
            move |(column, value): (usize, &ValueHandle<M>)| {
                (part, column, Along::Value(value.index()))
            }
        };
        let (held, values) = (self.held, self.values);
        let of_controls = held.iter().enumerate().map(value(Part::Control));
        let of_controls = of_controls.filter(|_| controls.is_some());
        let of_values = values.iter().enumerate().map(value(Part::Value));
        let mut columns = positions.chain(rates).chain(of_controls).chain(of_values);
        let mut is_first = true;
        loop {
            let chunk: [_; LANES] = core::array::from_fn(|_| columns.next());
            if chunk[0].is_none() && !is_first {
                break;
            }
            let directions = chunk.map(|column| column.map(|(.., direction)| direction));
            let is_end = controls.is_none();
            let (now, slopes) = self.along((number, is_end), state, &directions, cost)?;
            if is_first {
                self.cost = self.cost + now;
            }
            is_first = false;
            for ((part, column, _), slope) in chunk.into_iter().flatten().zip(slopes) {
                let place = match part {
                    Part::Position => by_positions.get_mut(column),
                    Part::Rate => by_rates.get_mut(column),
                    Part::Control => by_controls.get_mut(column),
                    Part::Value => self.by_values.get_mut(column),
                };
                if let Some(place) = place {
                    *place = *place + slope;
                }
            }
        }
        (self.by_positions, self.by_rates) = (by_positions, by_rates);
        Ok(by_controls)
    }

    /// The cost at an instant, and how the cost from there on changes along directions.
    fn along(
        &mut self,
        (number, is_end): (usize, bool),
        state: &M::JointState<S>,
        directions: &[Option<Along>; LANES],
        cost: &impl Fn(&Instant<'_, M, U, S>) -> Lifted<S>,
    ) -> Result<(S, [S; LANES]), Fault> {
        let (there, bodies) = self.space.standing_along(state, directions)?;
        if are_inputs::<M>(&self.held) && are_inputs::<M>(&self.values) {
            self.dynamics.set_inputs(&M::inputs_of(&there.parameters))?;
        } else {
            let carrying = self.adjoint.formulation.carrying();
            self.dynamics = by_joints(there.parameters, carrying)?;
        }
        let time = Forward::fixed(self.space.time());
        let control = |input: ValueHandle<M>| {
            let number = there.parameters.as_slice().get(input.index());
            number.copied().unwrap_or(Forward::zero())
        };
        let instant = Instant {
            view: View::new(self.dynamics.constants(), time, &bodies),
            number,
            controls: (!is_end).then(|| self.held.map(control)),
        };
        let now = cost(&instant);
        let mut slopes = now.derivatives();
        if is_end {
            return Ok((now.value(), slopes));
        }
        let mut next = there.state;
        let FixedStep { step, scheme } = self.adjoint.integrator;
        scheme.step(&mut self.dynamics, time, &mut next, Forward::fixed(step))?;
        let positions = self.space.positions_of(&next)?;
        let of_positions = positions.iter().zip(&self.by_positions);
        let rates = self.space.rates_of(&next);
        for (number, &adjoint) in of_positions.chain(rates.iter().zip(&self.by_rates)) {
            for (slope, by) in slopes.iter_mut().zip(number.derivatives()) {
                *slope = adjoint.fused(by, *slope);
            }
        }
        Ok((now.value(), slopes))
    }
}
