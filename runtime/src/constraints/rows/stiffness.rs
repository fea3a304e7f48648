//! What rows yield to a unit load: the diagonal of `D M^-1 D^T`, and compliances that are a part of
//! it.

use crate::math::scalar::Real;
use crate::math::vec3::read;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::Block;
use crate::state::vector::Array;

/// Compliances of the rows at a time and configuration, as [`Rows`](super::Rows) have them: without
/// what else these are about.
pub(crate) fn compliances_at<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    part: S,
) -> M::Multipliers<S> {
    compliances::<S, M>(stiffness_at::<S, M>(constants, time, state), part)
}

/// Lets equations of velocities yield to anything, since they do not hold positions.
pub(crate) fn yield_velocities<S: Real, M: Mechanism>(compliances: &mut M::Multipliers<S>) {
    for &row in M::REPORT.velocity_rows {
        if let Some(compliance) = compliances.as_mut_slice().get_mut(row) {
            // A part of what the row yields by itself, at the least 64 EPSILON, as of all rows.
            *compliance = compliance.quotient(S::EPSILON * S::EPSILON);
        }
    }
}

/// The diagonal of `D M^-1 D^T` at a time and configuration, as [`Rows`](super::Rows) have it.
pub(crate) fn stiffness_at<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> M::Multipliers<S> {
    let jacobian = M::jacobian(constants, time, state);
    stiffness::<S, M>(&jacobian, &yields::<S, M>(constants), M::REPORT.blocks)
}

pub(super) fn compliances<S: Real, M: Mechanism>(
    stiffness: M::Multipliers<S>,
    part: S,
) -> M::Multipliers<S> {
    let mut compliances = stiffness;
    for element in compliances.as_mut_slice() {
        *element = part * felt(*element);
    }
    compliances
}

/// The stiffness of a row; of one that vanishes, any.
pub(super) fn felt<S: Real>(stiffness: S) -> S {
    if stiffness > S::zero() {
        stiffness
    } else {
        S::one()
    }
}

/// `M^-1`.
pub(super) fn yields<S: Real, M: Mechanism>(constants: &M::Constants<S>) -> M::Velocities<S> {
    let mut yields = M::metric(constants);
    for mass in yields.as_mut_slice() {
        *mass = S::one().quotient(*mass);
    }
    yields
}

/// The diagonal of `D M^-1 D^T` by some blocks of `D`, the same for the rows of a vector equation.
pub(super) fn stiffness<S: Real, M: Mechanism>(
    jacobian: &M::Jacobian<S>,
    yields: &M::Velocities<S>,
    blocks: &[Block],
) -> M::Multipliers<S> {
    let mut stiffness = M::Multipliers::<S>::zeros();
    for block in blocks {
        let (values, yields) = (jacobian.as_slice(), yields.as_slice());
        let values = values.get(block.offset..).unwrap_or(&[]);
        let yields = yields.get(block.column..).unwrap_or(&[]);
        let rows = stiffness.as_mut_slice().get_mut(block.row..);
        let rows = rows.and_then(|rows| rows.get_mut(..block.rows));
        let rows = rows.unwrap_or(&mut []);
        // As many columns as are known: a loop over others costs a comparison for each.
        match block.columns {
            6 => add_stiffness::<S, 6>(rows, values, yields),
            _ => add_stiffness::<S, 3>(rows, values, yields),
        }
    }
    evened::<S, M>(&mut stiffness);
    stiffness
}

/// Adds what rows of so many elements yield to a unit load.
#[inline]
fn add_stiffness<S: Real, const N: usize>(rows: &mut [S], values: &[S], yields: &[S]) {
    let yields: [S; N] = read(yields, 0);
    for (stiffness, row) in rows.iter_mut().zip(values.as_chunks::<N>().0) {
        for (&value, &inverse) in row.iter().zip(&yields) {
            *stiffness = (value * value).fused(inverse, *stiffness);
        }
    }
}

/// Gives the three rows of a vector equation the largest of their values.
pub(crate) fn evened<S: Real, M: Mechanism>(values: &mut M::Multipliers<S>) {
    for &first in M::VECTOR_ROWS {
        let rows = values.as_mut_slice().get_mut(first..).unwrap_or(&mut []);
        let three = rows.iter_mut().take(3);
        let most = three.fold(S::zero(), |most, value| most.max(*value));
        rows.iter_mut().take(3).for_each(|value| *value = most);
    }
}
