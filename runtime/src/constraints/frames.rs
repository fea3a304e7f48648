//! Axes and points of bodies, and what carries them in the spanning tree.

use crate::math::quaternion::{normalised, rotate};
use crate::math::scalar::Real;
use crate::math::vec3::read;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The body that carries another one; `None` for the ground.
pub(crate) fn carrier_of<M: Mechanism>(body: usize) -> Option<usize> {
    M::REPORT
        .carriers
        .get(body)
        .and_then(|carrier| carrier.body)
}

/// From the axes of what carries a body to global ones.
pub(crate) fn carrier_axes<S: Real, M: Mechanism>(state: &M::State<S>, body: usize) -> [S; 4] {
    axes_of::<S, M>(state, carrier_of::<M>(body))
}

/// From the axes of a body to global ones.
pub(crate) fn axes_of<S: Real, M: Mechanism>(state: &M::State<S>, body: Option<usize>) -> [S; 4] {
    let body = body.and_then(|body| M::REPORT.bodies.get(body));
    match body {
        Some(body) if body.kind == BodyKind::Rigid => {
            normalised(&read(state.coordinates().as_slice(), body.coordinate + 3))
        }
        _ => [S::one(), S::zero(), S::zero(), S::zero()],
    }
}

/// The centre of mass (m, global); the origin of the ground.
pub(crate) fn centre_of<S: Real, M: Mechanism>(state: &M::State<S>, body: Option<usize>) -> [S; 3] {
    let body = body.and_then(|body| M::REPORT.bodies.get(body));
    body.map_or([S::zero(); 3], |body| {
        read(state.coordinates().as_slice(), body.coordinate)
    })
}

/// The point (m, global) of a joint on the body that it carries.
pub(crate) fn point_of<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    joint: usize,
    body: usize,
) -> [S; 3] {
    let bodies = M::REPORT
        .joints
        .get(joint)
        .map_or(&[][..], |info| info.bodies);
    let place = bodies.iter().position(|&other| other == Some(body));
    let arm = place.map_or([S::zero(); 3], |place| {
        M::joint_point(constants, joint, place)
    });
    let [x, y, z] = centre_of::<S, M>(state, Some(body));
    let [a, b, c] = rotate(&axes_of::<S, M>(state, Some(body)), &arm);
    [x + a, y + b, z + c]
}

/// The point (m, global) by which a body hangs on what carries it; its centre of mass where no
/// joint carries it.
pub(crate) fn hanging_point<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    body: usize,
) -> [S; 3] {
    let carrier = M::REPORT.carriers.get(body);
    match carrier.and_then(|carrier| carrier.joint) {
        Some(joint) => point_of::<S, M>(constants, state, joint, body),
        None => centre_of::<S, M>(state, Some(body)),
    }
}
