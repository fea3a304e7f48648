//! What a joint exerts on its bodies.

use nalgebra::Vector3;

use crate::constraints::joint_load::{load_on_body, orientation};
use crate::math::quaternion::rotate;
use crate::math::scalar::Scalar;
use crate::math::vec3::{cross, minus, plus};
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array;

/// A force and a moment, reduced to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        into = "crate::measure::written::WrittenWrench<S>",
        from = "crate::measure::written::WrittenWrench<S>",
        bound(
            serialize = "S: Scalar + serde::Serialize",
            deserialize = "S: Scalar + serde::Deserialize<'de>"
        )
    )
)]
pub struct Wrench<S> {
    /// The force (N, global).
    pub force: Vector3<S>,
    /// The moment about the point (N m, global).
    pub moment: Vector3<S>,
    /// The point (m, global).
    pub point: Vector3<S>,
    /// Whether nothing else would do. Not so where equations of the joint depend on others
    /// ([`JointInfo::undetermined`](crate::mechanism::JointInfo)): then a part of the reaction is
    /// one of many that hold the bodies, by the choice of equations that are kept or the compliance
    /// that they share, and zero in it says nothing.
    pub is_unique: bool,
}

/// A force and a moment (N, N m, global) about a point.
struct Reduced<S> {
    force: [S; 3],
    moment: [S; 3],
}

/// The wrench of a joint on the body at a place of its `between`, reduced to the joint's point on
/// that body.
///
/// On a body it is `-D^T lambda`: the force, and the moment about the centre of mass moved to the
/// point. On the ground it is the opposite of the sum over the bodies. `None` for a joint or a
/// place that is not there.
pub(crate) fn wrench<S: Scalar, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
    joint: usize,
    place: usize,
) -> Option<Wrench<S>> {
    let jacobian = M::jacobian(constants, time, state);
    let load = |body| load_on_body::<S, M>(jacobian.as_slice(), state, multipliers, joint, body);
    let info = M::REPORT.joints.get(joint)?;
    let bodies = info.bodies;
    let offset = M::joint_point(constants, joint, place);
    let (point, reduced) = match *bodies.get(place)? {
        Some(body) => {
            let handle = BodyHandle::<M>::new(body);
            let centre = crate::measure::access::position(state, handle);
            let arm = rotate(&orientation::<S, M>(state, handle), &offset);
            let [force, moment] = load(body);
            (
                plus(&centre, &arm),
                Reduced {
                    force,
                    moment: minus(&moment, &cross(&arm, &force)),
                },
            )
        }
        None => {
            let zero = [S::zero(); 3];
            let mut sum = Reduced {
                force: zero,
                moment: zero,
            };
            for body in bodies.iter().copied().flatten() {
                let centre = crate::measure::access::position(state, BodyHandle::<M>::new(body));
                let [force, moment] = load(body);
                let moved = cross(&minus(&centre, &offset), &force);
                sum.force = minus(&sum.force, &force);
                sum.moment = minus(&sum.moment, &plus(&moment, &moved));
            }
            (offset, sum)
        }
    };
    Some(Wrench {
        force: Vector3::from(reduced.force),
        moment: Vector3::from(reduced.moment),
        point: Vector3::from(point),
        is_unique: info.undetermined.is_empty(),
    })
}

/// Components along principal body axes, turned into global axes.
pub(crate) fn in_global_axes<S: Scalar, M: Mechanism>(
    state: &M::State<S>,
    body: BodyHandle<M>,
    components: [S; 3],
) -> [S; 3] {
    rotate(&orientation::<S, M>(state, body), &components)
}
