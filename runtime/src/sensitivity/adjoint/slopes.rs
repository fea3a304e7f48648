//! What a cost changes by with a state.

use std::vec;
use std::vec::Vec;

use crate::forward::Forward;
use crate::independent::{changes, rates_of_joints};
use crate::math::scalar::Real;
use crate::mechanism::joint_kernels::JointParts as _;
use crate::mechanism::joint_rates::JointRates;
use crate::state::vector::Array as _;

/// What a cost changes by with a state, of which nothing follows anything else.
pub(super) struct Slopes<M: JointRates, S: Real> {
    /// With the position that goes with each rate of a joint; of a ball with turns along its axes.
    pub(super) positions: M::JointVelocities<S>,
    /// With each rate of a joint.
    pub(super) rates: M::JointVelocities<S>,
    /// With each state of the user's own.
    pub(super) own: Vec<S>,
}

impl<M: JointRates, S: Real> Slopes<M, S> {
    pub(super) fn zeros() -> Self {
        Self {
            positions: M::JointVelocities::zeros(),
            rates: M::JointVelocities::zeros(),
            own: vec![S::zero(); M::JOINT_REPORT.states.len()],
        }
    }

    /// Begins anew.
    pub(super) fn clear(&mut self) {
        self.positions = M::JointVelocities::zeros();
        self.rates = M::JointVelocities::zeros();
        self.own.fill(S::zero());
    }

    /// Adds those with positions, and with rates and own states one after the other.
    pub(super) fn add_parts(&mut self, positions: &[S], others: &[S]) {
        add(self.positions.as_mut_slice(), S::one(), positions);
        let rates = self.rates.as_mut_slice();
        let (of_rates, own) = others.split_at(rates.len().min(others.len()));
        add(rates, S::one(), of_rates);
        add(&mut self.own, S::one(), own);
    }

    /// What the cost changes by along the directions that a state varies in.
    pub(super) fn along<const K: usize>(&self, state: &M::JointState<Forward<S, K>>) -> [S; K] {
        let mut slopes = [S::zero(); K];
        let mut take = |number: &Forward<S, K>, by: S| {
            for (slope, along) in slopes.iter_mut().zip(number.derivatives()) {
                *slope = by.fused(along, *slope);
            }
        };
        let (positions, rates) = (changes::<M, S, K>(state), rates_of_joints::<M, _>(state));
        for (numbers, by) in [(&positions, &self.positions), (&rates, &self.rates)] {
            let pairs = numbers.as_slice().iter().zip(by.as_slice());
            pairs.for_each(|(number, &by)| take(number, by));
        }
        for (own, &by) in M::JOINT_REPORT.states.iter().zip(&self.own) {
            if let Some(number) = state.rest_slice().get(own.coordinate) {
                take(number, by);
            }
        }
        slopes
    }
}

/// Adds a number times others.
pub(super) fn add<S: Real>(sum: &mut [S], factor: S, more: &[S]) {
    for (place, &more) in sum.iter_mut().zip(more) {
        *place = more.fused(factor, *place);
    }
}
