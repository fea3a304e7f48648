//! A state along all that it is made of: positions and rates of all joints, chosen or not, and the
//! user's own states.

use super::IndependentCoordinates;
use super::directions::{StateAlong, vary};
use super::partition::{joint_rates, of_joints, put_velocities};
use super::points::moved;
use crate::forward::{Forward, lifted};
use crate::math::quaternion::{conjugate, product};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::mechanism::joint_kernels::{Freedom, JointParts as _};
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::relative::rates_of_motion;
use crate::state::vector::{Array as _, Vector as _};

/// What changes along a direction, and nothing else with it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Whole {
    /// A parameter or an input, by its place. A state of the user's own stays where its start is
    /// changed.
    Value(usize),
    /// The position that goes with a rate of a joint; of a ball a small turn along the axis of the
    /// rate.
    Position(usize),
    /// A rate of a joint.
    Rate(usize),
    /// A state of the user's own, by its number.
    Own(usize),
}

impl<M: JointRates, const N: usize, S: Real> IndependentCoordinates<M, N, S> {
    /// A state along some directions; what closes loops is not asked.
    pub(crate) fn whole_along<const K: usize>(
        &self,
        state: &M::JointState<S>,
        directions: &[Option<Whole>; K],
    ) -> StateAlong<M, N, K, S> {
        let mut equations = self.equations.lifted::<K>();
        let mut parameters: M::Parameters<Forward<S, K>> = lifted(&self.parameters);
        let mut ways = M::JointVelocities::<Forward<S, K>>::zeros();
        let mut rates = M::JointVelocities::<Forward<S, K>>::zeros();
        let present = joint_rates::<M, S>(state);
        for (rate, &present) in rates.as_mut_slice().iter_mut().zip(present.as_slice()) {
            *rate = Forward::fixed(present);
        }
        let (mut is_varied, mut is_moved) = (false, false);
        for (lane, direction) in directions.iter().enumerate() {
            match *direction {
                Some(Whole::Value(place)) => {
                    is_varied = true;
                    vary(parameters.as_mut_slice().get_mut(place), lane);
                }
                Some(Whole::Position(place)) => {
                    is_moved = true;
                    vary(ways.as_mut_slice().get_mut(place), lane);
                }
                Some(Whole::Rate(place)) => vary(rates.as_mut_slice().get_mut(place), lane),
                Some(Whole::Own(_)) | None => {}
            }
        }
        if is_varied {
            equations.constants = M::prepare_joints(&parameters);
        }
        let mut there = moved::<M, S, K>(state, |_| [S::zero(); K]);
        if is_moved {
            // The rates of coordinates are linear in velocities, and these begin at zero.
            put_velocities::<M, Forward<S, K>>(&ways, &mut there);
            let constants = &equations.constants;
            let slope = rates_of_motion::<Forward<S, K>, M>(constants, equations.time, &there);
            there = moved::<M, S, K>(state, |place| slope.element(place).derivatives());
        }
        for (lane, direction) in directions.iter().enumerate() {
            if let Some(Whole::Own(number)) = *direction
                && let Some(own) = M::JOINT_REPORT.states.get(number)
            {
                vary(there.rest_slice_mut().get_mut(own.coordinate), lane);
            }
        }
        put_velocities::<M, Forward<S, K>>(&rates, &mut there);
        StateAlong {
            parameters,
            is_varied,
            equations,
            state: there,
        }
    }

    /// The number of a chosen coordinate, by the place of its rate.
    pub(crate) fn column_of(&self, place: usize) -> Option<usize> {
        self.equations
            .places
            .iter()
            .position(|&chosen| chosen == place)
    }
}

/// What the positions of all joints change by in a state that carries derivatives, as
/// [`Whole::Position`] has them: numbers of which the values mean nothing.
pub(crate) fn changes<M: JointRates, S: Scalar, const K: usize>(
    state: &M::JointState<Forward<S, K>>,
) -> M::JointVelocities<Forward<S, K>> {
    let mut along = M::JointVelocities::<Forward<S, K>>::zeros();
    let still = |number: Forward<S, K>| Forward::fixed(number.value());
    for motion in M::JOINT_REPORT.motions {
        let places = along.as_mut_slice().iter_mut().skip(motion.velocity);
        match motion.freedom {
            Freedom::Turn { .. } | Freedom::Screw { .. } => {
                let pair = state.pairs_slice().get(motion.coordinate);
                for (place, &[c, s]) in places.zip(pair) {
                    *place = still(c) * s - still(s) * c;
                }
            }
            Freedom::Slide => {
                let slide = state.rest_slice().get(motion.coordinate);
                places.zip(slide).for_each(|(place, &slide)| *place = slide);
            }
            Freedom::Ball => {
                // `p' = p (0, w) / 2`.
                let p: [Forward<S, K>; 4] = read(state.rest_slice(), motion.coordinate);
                let [_, turns @ ..] = product(&conjugate(&p.map(still)), &p);
                let turns = turns.into_iter();
                places
                    .zip(turns)
                    .for_each(|(place, turn)| *place = turn + turn);
            }
        }
    }
    of_joints::<M, Forward<S, K>>(along.as_slice())
}

/// The rates of all joints at a state.
pub(crate) fn rates_of_joints<M: JointRates, S: Scalar>(
    state: &M::JointState<S>,
) -> M::JointVelocities<S> {
    joint_rates::<M, S>(state)
}
