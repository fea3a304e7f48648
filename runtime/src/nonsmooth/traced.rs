//! Limits of a description over numbers that are written down and cannot be compared.
//!
//! What programs that trace kernels ask for. An impact is that of `switch.rs` at one limit.

use core::f64::consts::TAU;

use crate::math::scalar::Scalar;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::JointLimits;
use crate::mechanism::traced::{AtTime, TracedCoordinates};
use crate::mechanism::turns;
use crate::nonsmooth::columns::NO_FREEDOM;
use crate::nonsmooth::quantity::{JointReading, Quantity};
use crate::nonsmooth::scene::Scene;
use crate::state::vector::{Array, MovingState};

/// A joint with limits in a state.
#[derive(Clone, Copy, Debug)]
pub struct LimitedJoint<S> {
    /// Its angle (rad) or displacement (m). Without a count of turns, the angle within half a turn
    /// of the middle between the limits.
    pub value: S,
    /// Its rate (rad/s, m/s).
    pub rate: S,
    /// Whether the value is an angle that is told up to whole turns alone.
    pub is_up_to_turns: bool,
}

/// How a joint with limits is and moves.
pub fn limited_joint<S: Scalar, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    bodies: &M::State<S>,
    limits: &JointLimits<S>,
) -> LimitedJoint<S> {
    if !limits.is_angle {
        let parts = M::joint_displacement(constants, time, bodies, limits.joint);
        return LimitedJoint {
            value: parts.value,
            rate: parts.rate,
            is_up_to_turns: false,
        };
    }
    let parts = M::joint_angle(constants, bodies, limits.joint);
    let [lower, upper] = limits.bounds;
    let middle = (lower + upper) * S::constant(0.5);
    let is_up_to_turns = parts.turns.is_none();
    let angle = parts.angle();
    LimitedJoint {
        value: if is_up_to_turns {
            turns::nearest(angle, middle)
        } else {
            angle
        },
        rate: parts.rate,
        is_up_to_turns,
    }
}

impl<S: Scalar> LimitedJoint<S> {
    /// How far it is above its lower limit and below its upper one (rad, m), negative beyond.
    /// Negative infinity of both where an angle is told up to turns and the limits are a turn or
    /// more apart: then it is not known.
    pub fn gaps(&self, limits: &JointLimits<S>) -> [S; 2] {
        let [lower, upper] = limits.bounds;
        let gaps = [self.value - lower, upper - self.value];
        if !self.is_up_to_turns {
            return gaps;
        }
        let unknown = S::constant(f64::NEG_INFINITY);
        gaps.map(|gap| (upper - lower).select(S::constant(TAU), gap, unknown))
    }

    /// Not negative where a step (s) from another state ends within the limits, or not farther
    /// beyond one of them than it began.
    pub fn heeds(&self, before: &Self, step: S, limits: &JointLimits<S>) -> S {
        let mut after = *self;
        if self.is_up_to_turns {
            let turned = (before.rate + self.rate) * (step * S::constant(0.5));
            after.value = turns::nearest(self.value, before.value + turned);
        }
        let [ended, begun] = [after.gaps(limits), before.gaps(limits)];
        let [one, other] = [0, 1].map(|side| ended[side] - begun[side].min(S::zero()));
        one.min(other)
    }
}

/// Turns back the rates of joints that are not farther inside a limit than `within` (rad, m) and
/// approach it, one after the other. An approach below `rest` (rad/s, m/s) has no restitution.
/// Returns the least relative pivot of the systems that were solved, zero where a joint cannot
/// move.
pub fn impact<S: Scalar, M: Mechanism, C: TracedCoordinates<M>>(
    at: &AtTime<'_, S, M, C>,
    state: &mut C::State<S>,
    limits: &[JointLimits<S>],
    [within, rest]: [S; 2],
) -> S {
    let (zero, one) = (S::zero(), S::one());
    let mut least = one;
    for limits in limits {
        let bodies = C::bodies_by_selection(at.own, state);
        let joint = limited_joint::<S, M>(at.absolute, at.time, &bodies, limits);
        let [above, below] = joint.gaps(limits);
        let inward = above.select(below, joint.rate, -joint.rate);
        // Negative where it is struck.
        let mut key = within.select(above.min(below), one, inward);
        if joint.is_up_to_turns {
            let [lower, upper] = limits.bounds;
            key = (upper - lower).select(S::constant(TAU), key, one);
        }
        let restitution = (-inward).select(rest, zero, limits.restitution);
        let change = -((one + restitution) * joint.rate);
        let mut next = *state;
        let [pivot, moves] = struck(at, &mut next, limits, change);
        let pivot = zero.select(moves, pivot, zero);
        least = key.select(zero, pivot.min(least), least);
        let velocities = state.rates_slice_mut().iter_mut();
        for (velocity, &after) in velocities.zip(next.rates_slice()) {
            *velocity = key.select(zero, after, *velocity);
        }
    }
    least
}

/// Changes the rate of a limited joint by an impulse along it, with the constraints kept. Returns
/// the least relative pivot of the system, and a number that is positive where the joint can move.
fn struck<S: Scalar, M: Mechanism, C: TracedCoordinates<M>>(
    at: &AtTime<'_, S, M, C>,
    state: &mut C::State<S>,
    limits: &JointLimits<S>,
    change: S,
) -> [S; 2] {
    let quantity = Quantity::<S>::Joint(if limits.is_angle {
        JointReading::Angle(limits.joint)
    } else {
        JointReading::Displacement(limits.joint)
    });
    let bodies = C::bodies_by_selection(at.own, state);
    let scene = Scene::<S, M> {
        constants: at.absolute,
        time: at.time,
        bodies: &bodies,
    };
    let mut loads = M::Velocities::<S>::zeros();
    quantity.add_effort(&scene, S::one(), &mut loads);
    let prepared = (at.own, at.coefficients);
    let (column, pivot) = C::moved_by(prepared, at.time, state, &loads, &Array::zeros());
    let rate_at = |velocities: &C::Velocities<S>| {
        let mut moving = *state;
        let places = moving.rates_slice_mut().iter_mut();
        places
            .zip(velocities.as_slice())
            .for_each(|(place, &velocity)| *place = velocity);
        let bodies = C::bodies_by_selection(at.own, &moving);
        quantity.rate(&Scene::<S, M> {
            bodies: &bodies,
            ..scene
        })
    };
    let compliance = rate_at(&column) - rate_at(&Array::zeros());
    let mass = M::metric::<S>(at.absolute);
    let free = loads.as_slice().iter().zip(mass.as_slice());
    let free = free.fold(S::zero(), |sum, (&load, &mass)| {
        (load * load).fused(mass.reciprocal(), sum)
    });
    let impulse = change * compliance.reciprocal();
    let velocities = state.rates_slice_mut().iter_mut();
    for (velocity, &part) in velocities.zip(column.as_slice()) {
        *velocity = part.fused(impulse, *velocity);
    }
    let epsilon = if S::SEVEN_DIGITS {
        f64::from(f32::EPSILON)
    } else {
        f64::EPSILON
    };
    let moves = compliance - S::constant(NO_FREEDOM * epsilon) * free;
    [pivot, moves]
}
