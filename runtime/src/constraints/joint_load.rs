//! What a joint exerts on a body, by the multipliers of its rows.

use crate::math::quaternion::rotate;
use crate::math::scalar::Scalar;
use crate::math::vec3::read;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// `-D^T lambda` of one joint on one body: force (N) and moment about the centre of mass (N m),
/// both global.
pub(crate) fn load_on_body<S: Scalar, M: Mechanism>(
    jacobian: &[S],
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
    joint: usize,
    body: usize,
) -> [[S; 3]; 2] {
    let mut load = [S::zero(); 6];
    for block in M::REPORT
        .blocks
        .iter()
        .filter(|b| b.joint == joint && b.body == body)
    {
        let values = jacobian
            .get(block.offset..)
            .unwrap_or(&[])
            .chunks(block.columns.max(1));
        let rows = multipliers.as_slice().iter().skip(block.row);
        for (row, &lambda) in values.zip(rows).take(block.rows) {
            for (element, &value) in load.iter_mut().zip(row) {
                *element = *element - value * lambda;
            }
        }
    }
    let [f1, f2, f3, m1, m2, m3] = load;
    let p = orientation::<S, M>(state, BodyHandle::new(body));
    [[f1, f2, f3], rotate(&p, &[m1, m2, m3])]
}

/// `p` as it is; no rotation for a particle.
pub(crate) fn orientation<S: Scalar, M: Mechanism>(
    state: &M::State<S>,
    body: BodyHandle<M>,
) -> [S; 4] {
    match body.orientation() {
        Some((_, place)) => read(state.coordinates().as_slice(), place),
        None => [S::one(), S::zero(), S::zero(), S::zero()],
    }
}
