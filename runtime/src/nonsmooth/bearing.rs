//! Where the friction of a joint acts that goes with its load, and how that load is read.

use crate::constraints::joint_load::{load_on_body, orientation};
use crate::joints::{PointOnLine, Prismatic, Revolute};
use crate::math::quaternion::rotate;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, minus, norm, over, plus, times};
use crate::mechanism::handle::{BodyHandle, Joint};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::JointInfo;
use crate::nonsmooth::quantity::{JointReading, Quantity};
use crate::nonsmooth::scene::Scene;

/// A joint whose dry friction may go with its load: it has one axis, along which it slides or about
/// which it turns, and nothing else moves in its bearing.
///
/// For [`Interaction::friction_by_load`](crate::run::Interaction::friction_by_load). Implement it
/// for a joint of your own with one angle, or with one displacement along an axis that its
/// reaction is to be taken across.
#[diagnostic::on_unimplemented(
    message = "the friction of `{Self}` by its load is not known",
    label = "this joint has no single axis in a bearing",
    note = "`friction_by_load` takes a `Prismatic`, a `PointOnLine` or a `Revolute`; `Interaction::friction` takes any angle or displacement, with a known capacity"
)]
pub trait HasBearing: Joint {
    /// Whether it turns about its axis: then its bearing has a radius. Else it slides along it.
    const TURNS: bool;
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

/// The bearing of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bearing<S> {
    /// Of a hinge (m).
    pub(crate) radius: Option<S>,
    /// Half of its length (m), where moments count.
    pub(crate) half_length: Option<S>,
}

/// The forces across the axis at both ends of a bearing (N, global), times the radius (N m) of a
/// hinge. Without a length each is half of the whole.
pub(super) type Ends<S> = [[S; 3]; 2];

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
}

impl<S: Real> Bearing<S> {
    /// Where it is; `None` for a joint without a body.
    pub(super) fn placed<M: Mechanism>(
        &self,
        quantity: &Quantity<S>,
        scene: &Scene<'_, S, M>,
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
        Some(Placed {
            joint,
            body,
            axis: over(&axis, length),
            arm: rotate(&p, &M::joint_point(scene.constants, joint, place)),
            lever: self.radius.unwrap_or(S::one()),
            half_length: self.half_length,
        })
    }
}

impl<S: Real> Placed<S> {
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
        let across = times(&across(&force, &self.axis), half);
        let Some(half_length) = self.half_length else {
            return [across; 2];
        };
        // Two forces at both ends that make the moment about the middle.
        let moment = minus(&moment, &cross(&self.arm, &force));
        let pair = cross(&moment, &self.axis);
        let pair = times(&pair, half.quotient(half_length));
        [plus(&across, &pair), minus(&across, &pair)]
    }
}

/// A vector without its part along an axis.
fn across<S: Scalar>(vector: &[S; 3], axis: &[S; 3]) -> [S; 3] {
    let terms = vector.iter().zip(axis);
    let along = terms.fold(S::zero(), |sum, (&a, &b)| a.fused(b, sum));
    minus(vector, &times(axis, along))
}
