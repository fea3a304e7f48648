//! Angles and displacements of joints, to be set in a state of the bodies.

use core::f64::consts::TAU;

use crate::assembly::free_motion::FREE;
use crate::assembly::subtree::{Subtree, Twist, orientation_of};
use crate::constraints::extent::resolution;
use crate::error::{Fault, StepFault};
use crate::math::quaternion::{conjugate, normalised, product};
use crate::math::scalar::Real;
use crate::math::vec3::square;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::turns;
use crate::state::vector::{Array, StateParts, Vector};

/// What a displacement may miss by, in last digits of positions.
const DIGITS: f64 = 64.0;

impl<S: Real, M: Mechanism> Subtree<'_, S, M> {
    /// Sets the angle (rad).
    pub(crate) fn set_angle(mut self, angle: S) -> Result<M::State<S>, Fault> {
        let axis = self.axis()?;
        let mut now = turns::angle::<S, M>(self.constants, &self.state, self.joint);
        // What an element of the same bodies counts has an effect.
        if let Some(counted) = self.turns(&axis) {
            now = counted(now);
        }
        self.displace(&axis, angle - now);
        turns::set::<S, M, _>(&mut self.state, self.joint, angle);
        self.finite()
    }

    /// Sets the rate of the angle (rad/s).
    pub(crate) fn set_angle_rate(mut self, rate: S) -> Result<M::State<S>, Fault> {
        let axis = self.axis()?;
        let now = M::joint_angle(self.constants, &self.state, self.joint).rate;
        self.accelerate(&axis.scaled(rate - now));
        self.finite()
    }

    /// Sets the displacement (m).
    pub(crate) fn set_displacement(mut self, displacement: S) -> Result<M::State<S>, Fault> {
        let direction = self.direction()?;
        let way = displacement - self.displacement();
        self.displace(&direction, way);
        let left = displacement - self.displacement();
        let size = way.abs().max(displacement.abs());
        let round_off = S::constant(DIGITS) * resolution::<S, M>(&self.state);
        if left.abs() > S::EPSILON.sqrt().fused(size, round_off) {
            // Its definition's displacement is not along the motion.
            return Err(self.holds());
        }
        self.finite()
    }

    /// Sets the rate of the displacement (m/s).
    pub(crate) fn set_displacement_rate(mut self, rate: S) -> Result<M::State<S>, Fault> {
        let direction = self.direction()?;
        let now = M::joint_displacement(self.constants, S::zero(), &self.state, self.joint).rate;
        self.accelerate(&direction.scaled(rate - now));
        self.finite()
    }

    /// Turns the second body against the first, so that it is turned by these Euler parameters from
    /// how it stands in the reference configuration; global axes there.
    pub(crate) fn set_orientation(mut self, orientation: &[S; 4]) -> Result<M::State<S>, Fault> {
        let [first, second] = *self.info.bodies else {
            return Err(self.holds());
        };
        let described = M::initial_state(self.constants);
        let stood = |body| orientation_of::<S, M>(&described, body);
        let stands = |body| orientation_of::<S, M>(&self.state, body);
        // From global axes in the reference configuration to where they are now, for either body.
        let turned = |body| product(&stands(body), &conjugate(&stood(body)));
        let wanted = if Some(self.body) == second {
            let to = product(&turned(first), &normalised(orientation));
            product(&to, &conjugate(&turned(second)))
        } else {
            let to = product(&turned(second), &conjugate(&normalised(orientation)));
            product(&to, &conjugate(&turned(first)))
        };
        let [e0, e1, e2, e3] = wanted;
        let vector = [e1, e2, e3];
        let sine = square(&vector).sqrt();
        let angle = S::constant(2.0) * sine.atan2(e0);
        let (one, zero) = (S::one(), S::zero());
        let point = self.centre(&[[one, zero, zero], [zero, one, zero], [zero, zero, one]])?;
        if sine > S::zero() {
            let axis = Twist {
                turn: vector.map(|x| x.quotient(sine)),
                point,
                slide: [S::zero(); 3],
            };
            self.displace(&axis, angle);
        }
        self.finite()
    }

    fn displacement(&self) -> S {
        M::joint_displacement(self.constants, S::zero(), &self.state, self.joint).value
    }

    fn finite(self) -> Result<M::State<S>, Fault> {
        if self.state.is_finite() {
            Ok(self.state)
        } else {
            Err(Fault::Step(StepFault::StateNotFinite))
        }
    }

    /// The angle with the turns that an element between the same bodies counts, from the angle
    /// without; `None` where none does.
    fn turns(&self, axis: &Twist<S>) -> Option<impl Fn(S) -> S + use<S, M>> {
        let joints = M::REPORT.joints.iter();
        let joints = joints.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
        let forces = M::REPORT.forces.iter();
        let forces = forces.map(|info| (info.bodies, info.auxiliary, info.auxiliaries));
        let rates = self.counter_rates(axis);
        let bodies = self.info.bodies;
        let is_same = |other: &[Option<usize>]| match (bodies, other) {
            ([a, b], [c, d]) => (a, b) == (c, d) || (a, b) == (d, c),
            _ => false,
        };
        for (other, first, count) in joints.chain(forces) {
            if count != 1 || !is_same(other) {
                continue;
            }
            let rate = rates.as_slice().get(first).copied();
            let counted = self.state.coordinates().as_slice().get(first).copied();
            let (Some(rate), Some(counted)) = (rate, counted) else {
                continue;
            };
            if (rate.abs() - S::one()).abs() > S::constant(FREE) {
                continue;
            }
            let whole = counted * rate;
            return Some(move |angle: S| {
                let turns = ((whole - angle) * S::constant(TAU.recip())).round();
                turns.fused(S::constant(TAU), angle)
            });
        }
        None
    }
}
