//! How large a mechanism is.

use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::norm;
use crate::math::vec3::{minus, read};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyInfo;
use crate::state::vector::{Array, StateParts};

/// The largest distance of a centre of mass, or of a joint's point on the ground, from the first
/// centre of mass.
pub(crate) fn extent<S: Real, M: Mechanism>(constants: &M::Constants<S>, state: &M::State<S>) -> S {
    let first = centre::<S, M>(state, 0);
    let mut extent = S::zero();
    for body in 0..M::REPORT.bodies.len() {
        extent = extent.max(norm(&minus(&centre::<S, M>(state, body), &first)));
    }
    for (index, joint) in M::REPORT.joints.iter().enumerate() {
        // Rows of rotations alone need no point, and none is then given.
        for (place, body) in joint.bodies.iter().enumerate() {
            let point = M::joint_point(constants, index, place);
            let given = point.iter().any(|&x| x != S::zero());
            extent = extent.max(match body {
                Some(_) => norm(&point),
                None if given => norm(&minus(&point, &first)),
                None => S::zero(),
            });
        }
    }
    extent
}

/// The centre of mass of a body (m, global).
pub(crate) fn centre<S: Scalar, M: Mechanism>(state: &M::State<S>, body: usize) -> [S; 3] {
    let place = M::REPORT.bodies.get(body).map_or(0, |info| info.coordinate);
    read(state.coordinates().as_slice(), place)
}

/// What the digits of positions resolve (m): `EPSILON` of the largest.
pub(crate) fn resolution<S: Real, M: Mechanism>(state: &M::State<S>) -> S {
    S::EPSILON * farthest(M::REPORT.bodies, state.coordinates().as_slice())
}

/// The largest component (m) of a position.
pub(crate) fn farthest<S: Real>(bodies: &[BodyInfo], coordinates: &[S]) -> S {
    let positions = bodies.iter();
    let positions = positions.map(|body| largest(&read::<S, 3>(coordinates, body.coordinate)));
    positions.fold(S::zero(), S::max)
}

/// The largest magnitude; zero where there is none.
pub(crate) fn largest<S: Real>(elements: &[S]) -> S {
    elements.iter().fold(S::zero(), |most, x| most.max(x.abs()))
}
