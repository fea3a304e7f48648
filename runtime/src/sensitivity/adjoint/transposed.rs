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
//! are the sums of what pairs are turned by, so `q` is a vector.

use std::vec;
use std::vec::Vec;

use crate::integrate::{Evaluated, FixedStep, Scheme, Tableau};
use crate::math::scalar::Real;
use crate::mechanism::handle::ValueHandle;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::joint_rates::JointRates;
use crate::state::vector::Array as _;

/// What the cost changes by with positions and rates of the joints.
type Pair<M, S> = [<M as JointCoordinates>::JointVelocities<S>; 2];

/// Steps that were taken, and how they are gone through backwards.
pub(super) struct Transposed<M: JointRates, S: Real> {
    tableau: Tableau,
    step: S,
    /// Times and states at the stages of all steps.
    stages: Vec<Evaluated<S, M::JointState<S>>>,
    /// What the cost changes by with the states at the stages of a step.
    slopes: Vec<Pair<M, S>>,
}

/// What a step does to what the cost changes by.
pub(super) struct Before<M: JointRates, S: Real> {
    /// With positions and rates at its start.
    pub(super) state: Pair<M, S>,
    /// With inputs, see [`Before::by`].
    inputs: M::Adjoint<S>,
}

impl<M: JointRates, S: Real> Transposed<M, S> {
    /// `None` without the kernel, with an input that it does not have, or a method that is no
    /// explicit Runge-Kutta method. So it is with balls, whose coordinates are no vector.
    pub(super) fn new<K: Scheme<S>>(
        integrator: FixedStep<S, K>,
        held: &[ValueHandle<M>],
        values: &[ValueHandle<M>],
        steps: usize,
    ) -> Option<Self> {
        let inputs = M::ADJOINT_BY?;
        let mut all = held.iter().chain(values);
        let has_all = all.all(|value| inputs.contains(&value.index()));
        let is_vector = M::JOINT_REPORT.euler_parameters.is_empty();
        let tableau = integrator.scheme.tableau()?;
        let count = tableau.stages.len() + 1;
        (has_all && is_vector).then(|| Self {
            tableau,
            step: integrator.step,
            stages: Vec::with_capacity(steps * count),
            slopes: vec![[M::JointVelocities::zeros(); 2]; count],
        })
    }

    /// Where the stages of the steps are put, one step after the other.
    pub(super) const fn stages(&mut self) -> &mut Vec<Evaluated<S, M::JointState<S>>> {
        &mut self.stages
    }

    /// Goes back before a step.
    pub(super) fn before(
        &mut self,
        number: usize,
        constants: &M::JointConstants<S>,
        after: Pair<M, S>,
    ) -> Before<M, S> {
        let count = self.slopes.len();
        let mut found = Before::<M, S> {
            state: after,
            inputs: M::Adjoint::zeros(),
        };
        let stages = self.stages.iter().skip(number * count).take(count);
        for (place, stage) in stages.enumerate().rev() {
            let [by_positions, by_rates] = self.weights(place, &after);
            let slopes = M::adjoint(constants, stage.time, &stage.state, &by_rates);
            let rates = by_rates.as_slice().len();
            let (positions, others) = slopes.as_slice().split_at(rates);
            let (rates, inputs) = others.split_at(rates);
            let mut of_stage = [M::JointVelocities::zeros(), by_positions];
            add(of_stage[0].as_mut_slice(), S::one(), positions);
            add(of_stage[1].as_mut_slice(), S::one(), rates);
            add(found.inputs.as_mut_slice(), S::one(), inputs);
            for (sum, of_stage) in found.state.iter_mut().zip(&of_stage) {
                add(sum.as_mut_slice(), S::one(), of_stage.as_slice());
            }
            if let Some(slopes) = self.slopes.get_mut(place) {
                *slopes = of_stage;
            }
        }
        found
    }

    /// How the slopes of a stage are weighed.
    fn weights(&self, stage: usize, after: &Pair<M, S>) -> Pair<M, S> {
        let mut weights = [M::JointVelocities::zeros(); 2];
        let mut take = |weight: f64, slopes: &Pair<M, S>| {
            let factor = S::constant(weight) * self.step;
            for (sum, slopes) in weights.iter_mut().zip(slopes) {
                add(sum.as_mut_slice(), factor, slopes.as_slice());
            }
        };
        let of = |terms: &[(usize, f64)]| terms.iter().find(|(slope, _)| *slope == stage).copied();
        if let Some((_, weight)) = of(self.tableau.result) {
            take(weight, after);
        }
        let later = self.tableau.stages.iter().zip(self.slopes.iter().skip(1));
        for (terms, slopes) in later.skip(stage) {
            if let Some((_, weight)) = of(terms) {
                take(weight, slopes);
            }
        }
        weights
    }
}

impl<M: JointRates, S: Real> Before<M, S> {
    /// With an input.
    pub(super) fn by(&self, input: ValueHandle<M>) -> S {
        let mut inputs = M::ADJOINT_BY.unwrap_or(&[]).iter();
        let place = inputs.position(|&place| place == input.index());
        let found = place.and_then(|place| self.inputs.as_slice().get(place));
        found.copied().unwrap_or(S::zero())
    }
}

/// Adds a number times others.
fn add<S: Real>(sum: &mut [S], factor: S, more: &[S]) {
    for (place, &more) in sum.iter_mut().zip(more) {
        *place = more.fused(factor, *place);
    }
}
