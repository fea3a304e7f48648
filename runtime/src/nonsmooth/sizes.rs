//! What counts as nothing beside an interaction, with the size that each is a part of.
//!
//! No size has a unit of its own: a stop may be a kilometre away, or a nanometre beside another.
//! Lengths are parts of what a value is the difference of, of the way between two limits, or of how
//! far from its limits a quantity has been; rates and efforts are parts of those at hand.

use crate::constraints::extent::largest;
use crate::math::scalar::Real;
use crate::math::vec3::{norm, read};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::law::Limits;
use crate::nonsmooth::quantity::{JointReading, Quantity};
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Tracked;
use crate::state::vector::{Array, StateParts};

/// A quantity within this part of its farthest way from a limit is on it: less than any bounce.
const ON_LIMIT: f64 = 1e-9;

/// Beyond a limit by more than this part of what it may move by, it was put there.
const BEYOND: f64 = 1e-6;

/// The same in `EPSILON`, where that is more: a correction of a state leaves so much.
const PUT: f64 = 1e4;

/// A rate of less than this part of what it is the sum of is none.
pub(super) const AT_REST: f64 = 1e-11;

/// Slip of a contact has ended where a step has led it to less than this part of what it is the sum
/// of. The direction of so little is nothing but the error of the step.
pub(super) const ENDED: f64 = 1e-9;

/// Round-off of a reading, in `EPSILON` of what it is made of.
pub(super) const ROUND_OFF: f64 = 64.0;

/// Round-off of a gap, in `EPSILON` of the lengths that it is the difference of.
const OF_GAP: f64 = 16.0;

/// By so many units in the last place of the time an instant may be off.
pub(super) const OF_TIME: f64 = 8.0;

/// The part of the capacity, or of the efforts at hand, below which an effort is at its bound.
pub(super) const AT_BOUND: f64 = 1e-12;

/// A part of a size, and at least so many `EPSILON` of it.
pub(super) fn part<S: Real>(part: f64, digits: f64) -> S {
    S::constant(part).max(S::constant(digits) * S::EPSILON)
}

/// Down to where a gap counts as none.
pub(super) struct Near<S> {
    /// Of a quantity that stands on its limit, or has just come to it.
    pub(super) held: S,
    /// Of any other.
    pub(super) free: S,
}

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The size of the terms of its distance from a limit: an angle is known as directions are, and
    /// a length as the positions and arms that it is the difference of.
    fn terms(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> S {
        let quantity = &self.interaction.quantity;
        let bounds = limits.bounds.into_iter().filter(|bound| bound.is_finite());
        let size = bounds.fold(quantity.value(scene).abs(), |size, bound| {
            size.max(bound.abs())
        });
        if quantity.is_angle() {
            size.max(S::one())
        } else {
            size.max(quantity.reach(scene))
        }
    }

    /// What round-off makes of its distance from a limit.
    pub(super) fn round_off_of_gap(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> S {
        S::constant(OF_GAP) * S::EPSILON * self.terms(limits, scene)
    }

    /// Down to where its distance from a limit is none.
    pub(super) fn near(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> Near<S> {
        let [lower, upper] = limits.bounds;
        let terms = self.terms(limits, scene);
        let rate = self.interaction.quantity.rate(scene).abs();
        let digits = S::constant(ROUND_OFF) * S::EPSILON * terms;
        // At an instant it is where it is by the digits of the time.
        let resolved = rate.fused(S::constant(OF_TIME) * scene.time.ulp(), digits);
        let way = terms.min(upper - lower);
        let farthest = self.status.farthest.min(way);
        Near {
            held: part::<S>(BEYOND, PUT).fused(way, resolved),
            free: S::constant(ON_LIMIT).fused(farthest, digits),
        }
    }
}

impl<S: Real> Quantity<S> {
    /// The largest of the lengths (m) that a length is made of: positions of its bodies, and arms
    /// from there to its points.
    fn reach<M: Mechanism>(&self, scene: &Scene<'_, S, M>) -> S {
        let arms = match *self {
            Self::Joint(reading) => of_joint(reading, scene),
            Self::Difference(first, second, _) => {
                of_joint(first, scene).max(of_joint(second, scene))
            }
            Self::Gap(at, ref surface, ref shape) | Self::Slip(at, ref surface, ref shape, _) => {
                let arm = norm(&at.arm::<S, M>(scene.constants));
                arm.max(surface.reach::<M>(scene.constants))
                    .max(shape.reach())
            }
            Self::Distance(a, b) => {
                let arm = |at: crate::nonsmooth::place::At| norm(&at.arm::<S, M>(scene.constants));
                arm(a).max(arm(b))
            }
        };
        let coordinates = scene.bodies.coordinates().as_slice();
        let bodies = M::REPORT.bodies.iter().enumerate();
        let own = bodies.filter(|(body, _)| self.is_of::<M>(*body));
        own.fold(arms, |reach, (_, info)| {
            reach.max(largest(&read::<S, 3>(coordinates, info.coordinate)))
        })
    }
}

fn of_joint<S: Real, M: Mechanism>(reading: JointReading, scene: &Scene<'_, S, M>) -> S {
    let joint = reading.joint();
    let bodies = M::REPORT
        .joints
        .get(joint)
        .map_or(0, |info| info.bodies.len());
    let arms = (0..bodies).map(|place| norm(&M::joint_point(scene.constants, joint, place)));
    arms.fold(S::zero(), S::max)
}

/// Forces and moments on the bodies in the metric of the mass: with what a unit effort does without
/// constraints, the square of an acceleration.
pub(super) fn strength_of_forces<S: Real, M: Mechanism>(scene: &Scene<'_, S, M>) -> S {
    let forces = M::forces(scene.constants, scene.time, scene.bodies);
    let mass = M::metric::<S>(scene.constants);
    let pairs = forces.as_slice().iter().zip(mass.as_slice());
    pairs.fold(S::zero(), |sum, (&force, &mass)| {
        (force * force).fused(mass.reciprocal(), sum)
    })
}
