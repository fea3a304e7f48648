//! How large a mechanism is.

use crate::array::{Array, StateParts};
use crate::mechanism::Mechanism;
use crate::rotation::{minus, read};
use crate::scalar::{Real, Scalar};
use crate::view::square;

/// The largest distance of a centre of mass, or of a joint's point on the ground, from the first centre of mass.
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

/// The Euclidean norm, without a square out of the range of numbers.
pub(crate) fn norm<S: Real>(vector: &[S]) -> S {
    let sum = square(vector);
    if sum * S::EPSILON > S::smallest() && sum.is_finite() {
        return sum.sqrt();
    }
    let most = vector.iter().fold(S::zero(), |most, x| most.max(x.abs()));
    if most > S::zero() {
        let sum = vector.iter().fold(S::zero(), |sum, x| {
            let part = x.quotient(most);
            part.fused(part, sum)
        });
        sum.sqrt() * most
    } else {
        most
    }
}
