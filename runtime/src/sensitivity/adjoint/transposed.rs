//! A step backwards, by the kernel that `kernels = [adjoint]` asks for.
//!
//! An explicit Runge-Kutta method of the tableau `a`, `b` takes a step `h` of `q' = v`,
//! `v' = f(q, v, u)`. At its end the cost changes by `p` and `r` with `q` and `v`. The slopes of
//! stage `i` are then weighed with
//!
//! ```text
//! k_i = h (b_i p + sum over j > i of a_ji x_j),  l_i = h (b_i r + sum over j > i of a_ji y_j)
//! ```
//!
//! and its state has `x_i = f_q^T l_i`, `y_i = k_i + f_v^T l_i`. At the start the cost changes
//! by `p + sum of x_i` and `r + sum of y_i`, and with the inputs by the sum of `f_u^T l_i`. Angles
//! are the sums of what pairs are turned by, so `q` is a vector. States of the user's own stand
//! beside the rates: what they are moved by is a number like an acceleration. Multipliers need no
//! weights, as no state keeps them.
//!
//! **Balls.** A step moves Euler parameters `e` as four numbers, `e' = e (0, w) / 2`, and scales
//! them to length 1 at its end. What `f` changes by is orthogonal to `e`, since it reads `e / |e|`.
//! So are all changes of the cost between two steps, which are those by small turns: `2 e (0, c)`
//! for slopes `c` along the axes of the ball. Before the scaling they are that over the length.
//! Within a step all four numbers are carried back, so that the gradient is that of the step as it
//! is taken, to round-off.

use std::vec;
use std::vec::Vec;

use super::slopes::{Slopes, add};
use crate::integrate::{Evaluated, FixedStep, Scheme, Tableau};
use crate::math::quaternion::{conjugate, length, product};
use crate::math::scalar::Real;
use crate::math::vec3::read;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates, JointMotion, JointParts as _};
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::Terms;
use crate::state::vector::{Array as _, MovingState as _};

/// Steps that were taken, and how they are gone through backwards.
pub(super) struct Transposed<M: JointRates, S: Real> {
    tableau: Tableau,
    step: S,
    coefficients: M::JointCoefficients<S>,
    /// Times and states at the stages of all steps.
    stages: Vec<Evaluated<S, M::JointState<S>>>,
    /// What the cost changes by with the states at the stages of a step, and behind them at its
    /// end.
    slopes: Vec<OfStage<M, S>>,
    /// The same by Euler parameters, ball by ball for each stage.
    balls: Vec<[S; 4]>,
    /// How the slopes of a stage are weighed, of which this is the part of the balls.
    weights: Vec<[S; 4]>,
}

/// What the cost changes by with positions, and with rates and states of the user's own.
type OfStage<M, S> = (
    <M as JointCoordinates>::JointVelocities<S>,
    <M as JointCoordinates>::AdjointWeights<S>,
);

/// What the cost changes by with the inputs of a step: the first of these numbers.
pub(super) struct ByInputs<M: JointRates, S: Real>(M::Adjoint<S>);

/// The balls.
fn balls<M: JointRates>() -> impl Iterator<Item = &'static JointMotion> {
    let motions = M::JOINT_REPORT.motions.iter();
    motions.filter(|motion| motion.freedom == Freedom::Ball)
}

/// Whether a value is the start of a state of the user's own, which changes no step.
fn is_start<M: JointRates>(value: usize) -> bool {
    M::JOINT_REPORT.states.iter().any(|own| own.value == value)
}

impl<M: JointRates, S: Real> Transposed<M, S> {
    /// `None` without the kernel, with a value that it does not have, or a method that is no
    /// explicit Runge-Kutta method.
    pub(super) fn new<K: Scheme<S>>(
        integrator: FixedStep<S, K>,
        coefficients: M::JointCoefficients<S>,
        (held, values): (&[ValueHandle<M>], &[ValueHandle<M>]),
        steps: usize,
    ) -> Option<Self> {
        let inputs = M::ADJOINT_BY?;
        let mut all = held.iter().chain(values).map(|value| value.index());
        if !all.all(|value| inputs.contains(&value) || is_start::<M>(value)) {
            return None;
        }
        let tableau = integrator.scheme.tableau()?;
        let count = tableau.stages.len() + 1;
        let zeros = [S::zero(); 4];
        let balls = balls::<M>().count();
        Some(Self {
            tableau,
            step: integrator.step,
            coefficients,
            stages: Vec::with_capacity(steps * count),
            slopes: vec![(M::JointVelocities::zeros(), M::AdjointWeights::zeros()); count + 1],
            balls: vec![zeros; balls * (count + 1)],
            weights: vec![zeros; balls],
        })
    }

    /// Where the stages of the steps are put, one step after the other.
    pub(super) const fn stages(&mut self) -> &mut Vec<Evaluated<S, M::JointState<S>>> {
        &mut self.stages
    }

    /// Goes back before a step to the state `next`, where the cost changes by slopes; adds to those
    /// at its start.
    pub(super) fn before<T: Terms>(
        &mut self,
        number: usize,
        constants: &M::JointConstants<S>,
        (after, next): (&Slopes<M, S>, &M::JointState<S>),
        found: &mut Slopes<M, S>,
    ) -> ByInputs<M, S> {
        let count = self.slopes.len() - 1;
        self.begin(number, after, next);
        if let Some((positions, others)) = self.slopes.last() {
            found.add_parts(positions.as_slice(), others.as_slice());
        }
        let mut inputs = M::Adjoint::zeros();
        let one = S::one();
        for place in (0..count).rev() {
            let (by_positions, weights) = self.weights(place);
            let Some(stage) = self.stages.get(number * count + place) else {
                continue;
            };
            let coefficients = &self.coefficients;
            let (time, state) = (stage.time, &stage.state);
            let slopes = M::adjoint::<S, T>(constants, coefficients, time, state, &weights);
            let rates = by_positions.as_slice().len();
            let (positions, others) = slopes.as_slice().split_at(rates);
            let (others, of_inputs) = others.split_at(weights.as_slice().len());
            let mut of_stage = (M::JointVelocities::zeros(), M::AdjointWeights::zeros());
            add(of_stage.0.as_mut_slice(), one, positions);
            add(of_stage.1.as_mut_slice(), one, others);
            add(of_stage.1.as_mut_slice(), one, by_positions.as_slice());
            add(inputs.as_mut_slice(), one, of_inputs);
            let balls = balls::<M>().zip(&self.weights);
            let places = self.balls.iter_mut().skip(place * self.weights.len());
            for ((ball, weight), by) in balls.zip(places) {
                *by = through_ball::<M, S>(state, ball, weight, &mut of_stage);
            }
            found.add_parts(of_stage.0.as_slice(), of_stage.1.as_slice());
            if let Some(slopes) = self.slopes.get_mut(place) {
                *slopes = of_stage;
            }
        }
        self.end(number, found);
        ByInputs(inputs)
    }

    /// Takes the slopes at the end of a step, and those by Euler parameters before they are scaled.
    fn begin(&mut self, number: usize, after: &Slopes<M, S>, next: &M::JointState<S>) {
        let count = self.slopes.len() - 1;
        let mut of_end = (after.positions, M::AdjointWeights::zeros());
        let places = of_end.1.as_mut_slice().iter_mut();
        let numbers = after.rates.as_slice().iter().chain(&after.own);
        places
            .zip(numbers)
            .for_each(|(place, &number)| *place = number);
        for (ball, motion) in balls::<M>().enumerate() {
            let by = by_parameters(
                &read(next.rest_slice(), motion.coordinate),
                &read(after.positions.as_slice(), motion.velocity),
                self.length_before(number * count, motion).reciprocal(),
            );
            // Within the step these numbers stand for the turns.
            let turns = of_end.0.as_mut_slice().iter_mut().skip(motion.velocity);
            turns.take(3).for_each(|turn| *turn = S::zero());
            let place = self.balls.get_mut(count * self.weights.len() + ball);
            place.into_iter().for_each(|place| *place = by);
        }
        if let Some(end) = self.slopes.last_mut() {
            *end = of_end;
        }
    }

    /// The length of the Euler parameters of a ball at the end of a step before they are scaled.
    fn length_before(&self, first: usize, ball: &JointMotion) -> S {
        let at = |stage: usize| {
            let found = self.stages.get(first + stage);
            found.map_or([S::zero(); 4], |stage| {
                read(stage.state.rest_slice(), ball.coordinate)
            })
        };
        let mut e = at(0);
        for &(stage, weight) in self.tableau.result {
            let Some(found) = self.stages.get(first + stage) else {
                continue;
            };
            let [x, y, z] = read(found.state.rates_slice(), ball.velocity);
            let slope = product(&at(stage), &[S::zero(), x, y, z]);
            add(&mut e, S::constant(0.5 * weight) * self.step, &slope);
        }
        length(&e)
    }

    /// How the slopes of a stage are weighed; of Euler parameters, in their place.
    fn weights(&mut self, stage: usize) -> OfStage<M, S> {
        let mut weights = (M::JointVelocities::zeros(), M::AdjointWeights::zeros());
        let balls = self.weights.len();
        self.weights.fill([S::zero(); 4]);
        let mut take = |weight: f64, from: usize| {
            let factor = S::constant(weight) * self.step;
            if let Some((positions, others)) = self.slopes.get(from) {
                add(weights.0.as_mut_slice(), factor, positions.as_slice());
                add(weights.1.as_mut_slice(), factor, others.as_slice());
            }
            let by = self.balls.iter().skip(from * balls);
            for (sum, by) in self.weights.iter_mut().zip(by) {
                add(sum, factor, by);
            }
        };
        let of = |terms: &[(usize, f64)]| terms.iter().find(|(slope, _)| *slope == stage).copied();
        if let Some((_, weight)) = of(self.tableau.result) {
            take(weight, self.slopes.len() - 1);
        }
        for (later, terms) in self.tableau.stages.iter().enumerate().skip(stage) {
            if let Some((_, weight)) = of(terms) {
                take(weight, later + 1);
            }
        }
        weights
    }

    /// Adds slopes by turns at the start of a step, of those by Euler parameters at its end and
    /// stages.
    fn end(&self, number: usize, found: &mut Slopes<M, S>) {
        let count = self.slopes.len() - 1;
        let Some(start) = self.stages.get(number * count) else {
            return;
        };
        for (ball, motion) in balls::<M>().enumerate() {
            let mut sum = [S::zero(); 4];
            for by in self
                .balls
                .iter()
                .skip(ball)
                .step_by(self.weights.len().max(1))
            {
                add(&mut sum, S::one(), by);
            }
            let e = read(start.state.rest_slice(), motion.coordinate);
            let turns = along_axes(&e, &sum);
            let places = found
                .positions
                .as_mut_slice()
                .iter_mut()
                .skip(motion.velocity);
            places
                .zip(turns)
                .for_each(|(place, turn)| *place = *place + turn);
        }
    }
}

/// What the cost changes by with the Euler parameters at a stage; adds what it does with the rates,
/// and takes the turns away.
fn through_ball<M: JointRates, S: Real>(
    state: &M::JointState<S>,
    ball: &JointMotion,
    weight: &[S; 4],
    (turns, rates): &mut OfStage<M, S>,
) -> [S; 4] {
    let e: [S; 4] = read(state.rest_slice(), ball.coordinate);
    let [x, y, z]: [S; 3] = read(state.rates_slice(), ball.velocity);
    let along = along_axes(&e, weight);
    let places = rates.as_mut_slice().iter_mut().skip(ball.velocity);
    places
        .zip(along)
        .for_each(|(place, along)| *place = *place + along);
    let norm = e.iter().fold(S::zero(), |sum, &e| e.fused(e, sum));
    let by_turns = read(turns.as_slice(), ball.velocity);
    let places = turns.as_mut_slice().iter_mut().skip(ball.velocity);
    places.take(3).for_each(|place| *place = S::zero());
    let mut by = by_parameters(&e, &by_turns, norm.reciprocal());
    let back = product(weight, &[S::zero(), -x, -y, -z]);
    add(&mut by, S::constant(0.5), &back);
    by
}

/// `2 e (0, c)` times a factor: what changes by `c` along turns and is orthogonal to `e`, where the
/// factor is `1 / |e|^2`.
fn by_parameters<S: Real>(e: &[S; 4], &[x, y, z]: &[S; 3], factor: S) -> [S; 4] {
    let twice = factor + factor;
    product(e, &[S::zero(), x, y, z]).map(|number| twice * number)
}

/// What a slope by Euler parameters is along `e (0, w) / 2` for each axis.
fn along_axes<S: Real>(e: &[S; 4], by: &[S; 4]) -> [S; 3] {
    let [_, turns @ ..] = product(&conjugate(e), by);
    turns.map(|turn| S::constant(0.5) * turn)
}

impl<M: JointRates, S: Real> ByInputs<M, S> {
    /// With one of them; zero with the start of a state.
    pub(super) fn by(&self, input: ValueHandle<M>) -> S {
        let mut inputs = M::ADJOINT_BY.unwrap_or(&[]).iter();
        let place = inputs.position(|&place| place == input.index());
        let found = place.and_then(|place| self.0.as_slice().get(place));
        found.copied().unwrap_or(S::zero())
    }
}
