//! Where the friction of a joint acts that goes with its load, and how that load is read.
//!
//! A thread of the mean radius `r` and the lead angle `l` slides along its helix, with a friction
//! `mu N` along it by the force `N` across its flank. Of its effort `x` about the axis the part `x
//! sin l cos l / r` acts along the axis, so that `N cos l` is the thrust of the joint less that.
//! With `x = mu N r / cos l` this is `mu |thrust r / cos^2 l - x tan l|`: affine in the efforts
//! before its size is taken, as all loads are.

use crate::constraints::joint_load::{load_on_body, orientation};
use crate::joints::{PointOnLine, Prismatic, Revolute, Screw};
use crate::math::quaternion::rotate;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, norm, over, plus, read, times};
use crate::mechanism::handle::{BodyHandle, Joint};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::JointInfo;
use crate::nonsmooth::quantity::{JointReading, Quantity};
use crate::nonsmooth::scene::Scene;

/// A joint whose dry friction may go with its load. It slides along one axis or turns about it, or
/// does both by a thread. Nothing else moves in its bearing.
///
/// For [`Interaction::friction_by_load`](crate::run::Interaction::friction_by_load). Implement it
/// for a joint of your own with one angle, or with one displacement along an axis that its
/// reaction is to be taken across.
#[diagnostic::on_unimplemented(
    message = "the friction of `{Self}` by its load is not known",
    label = "this joint has no single axis in a bearing",
    note = "`friction_by_load` takes a `Prismatic`, a `PointOnLine`, a `Revolute` or a `Screw`; `Interaction::friction` takes any angle or displacement, with a known capacity"
)]
pub trait HasBearing: Joint {
    /// Whether it turns about its axis: then its bearing has a radius. Else it slides along it.
    const TURNS: bool;

    /// Whether it has a thread, which bears the force along its axis alone.
    const IS_THREAD: bool = false;
}

impl HasBearing for Prismatic {
    const TURNS: bool = false;
}

impl HasBearing for PointOnLine {
    const TURNS: bool = false;
}

impl HasBearing for Revolute {
    const TURNS: bool = true;
}

impl HasBearing for Screw {
    const TURNS: bool = true;
    const IS_THREAD: bool = true;
}

/// The bearing of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bearing<S> {
    /// Of a hinge (m).
    pub(crate) radius: Option<S>,
    /// Half of its length (m), where moments count.
    pub(crate) half_length: Option<S>,
    /// Of the collar of a hinge (m), where the force along the axis counts.
    pub(crate) collar: Option<S>,
    /// The radius is that of a thread.
    pub(crate) is_thread: bool,
}

/// The forces across the axis at both ends of a bearing, then the one along it at a collar or a
/// thread (N, global). Of what turns they are times their radii (N m). Without a length each end
/// has half of the whole.
pub(super) type Ends<S> = [[S; 3]; 3];

/// A bearing at a state of the bodies.
pub(super) struct Placed<S> {
    joint: usize,
    /// The body on which the reaction is read.
    body: usize,
    /// The axis (global), of length 1.
    axis: [S; 3],
    /// From the centre of mass to the middle of the bearing (m, global).
    arm: [S; 3],
    /// The radius of a hinge, 1 of a slide.
    lever: S,
    half_length: Option<S>,
    /// What the force along the axis counts times.
    collar: S,
    /// The tangent of the lead angle of a thread.
    lead: S,
}

impl<S: Real> Bearing<S> {
    /// Where it is; `None` for a joint without a body.
    pub(super) fn placed<M: Mechanism>(
        &self,
        quantity: &Quantity<S>,
        scene: &Scene<'_, S, M>,
        jacobian: &[S],
    ) -> Option<Placed<S>> {
        let Quantity::Joint(reading) = *quantity else {
            return None;
        };
        let joint = reading.joint();
        let info: &JointInfo = M::REPORT.joints.get(joint)?;
        let places = info.bodies.iter().copied().enumerate();
        let (place, body) = places
            .rev()
            .find_map(|(place, body)| Some((place, body?)))?;
        let handle = BodyHandle::<M>::new(body);
        let first = handle.info()?.velocity;
        let turns = matches!(reading, JointReading::Angle(_));
        let first = if turns { first + 3 } else { first };
        let mut axis = [S::zero(); 3];
        quantity.each_part(scene, |of, part| {
            let component = of.checked_sub(first);
            if let Some(component) = component.and_then(|component| axis.get_mut(component)) {
                *component = part;
            }
        });
        let p = orientation::<S, M>(scene.bodies, handle);
        if turns {
            axis = rotate(&p, &axis);
        }
        let length = norm(&axis);
        let otherwise = if turns { S::zero() } else { S::one() };
        let mut placed = Placed {
            joint,
            body,
            axis: over(&axis, length),
            arm: rotate(&p, &M::joint_point(scene.constants, joint, place)),
            lever: self.radius.unwrap_or(otherwise),
            half_length: self.half_length,
            collar: self.collar.unwrap_or(S::zero()),
            lead: S::zero(),
        };
        if self.is_thread {
            let radius = placed.lever;
            placed.lead = placed.advance::<M>(scene.bodies, jacobian).quotient(radius);
            placed.collar = radius * placed.lead.fused(placed.lead, S::one());
            placed.lever = S::zero();
        }
        Some(placed)
    }
}

impl<S: Real> Placed<S> {
    /// How far a screw moves along its axis (m) by a radian. Of its equations one alone has a force
    /// along the axis, with a moment about it that does as much work against it.
    fn advance<M: Mechanism>(&self, bodies: &M::State<S>, jacobian: &[S]) -> S {
        let p = orientation::<S, M>(bodies, BodyHandle::new(self.body));
        let blocks = M::REPORT.blocks.iter();
        let own = blocks.filter(|block| block.joint == self.joint && block.body == self.body);
        let mut sums = [S::zero(); 2];
        for block in own {
            let values = jacobian.get(block.offset..).unwrap_or(&[]);
            for row in values.chunks(block.columns.max(1)).take(block.rows) {
                let force = read::<S, 3>(row, 0);
                let moment = rotate(&p, &read::<S, 3>(row, 3));
                let moment = minus(&moment, &cross(&self.arm, &force));
                let [force, moment] = [force, moment].map(|vector| along(&vector, &self.axis));
                let [work, square] = sums;
                sums = [force.fused(moment, work), force.fused(force, square)];
            }
        }
        let [work, square] = sums;
        if square > S::zero() {
            -work.quotient(square)
        } else {
            S::zero()
        }
    }

    /// What a unit of the own effort adds to the load, besides by the reaction of the joint.
    pub(super) fn by_itself(&self) -> Ends<S> {
        let nothing = [S::zero(); 3];
        [nothing, nothing, times(&self.axis, -self.lead)]
    }

    /// The forces at both ends by multipliers, in which they are linear.
    pub(super) fn ends<M: Mechanism>(
        &self,
        bodies: &M::State<S>,
        jacobian: &[S],
        multipliers: &M::Multipliers<S>,
    ) -> Ends<S> {
        let [force, moment] =
            load_on_body::<S, M>(jacobian, bodies, multipliers, self.joint, self.body);
        let half = S::constant(0.5) * self.lever;
        let thrust = times(&self.axis, self.collar * along(&force, &self.axis));
        let across = times(&across(&force, &self.axis), half);
        let Some(half_length) = self.half_length else {
            return [across, across, thrust];
        };
        // Two forces at both ends that make the moment about the middle.
        let moment = minus(&moment, &cross(&self.arm, &force));
        let pair = cross(&moment, &self.axis);
        let pair = times(&pair, half.quotient(half_length));
        [plus(&across, &pair), minus(&across, &pair), thrust]
    }
}

/// The part of a vector along an axis.
fn along<S: Scalar>(vector: &[S; 3], axis: &[S; 3]) -> S {
    let terms = vector.iter().zip(axis);
    terms.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum))
}

/// A vector without its part along an axis.
fn across<S: Scalar>(vector: &[S; 3], axis: &[S; 3]) -> [S; 3] {
    minus(vector, &times(axis, along(vector, axis)))
}
