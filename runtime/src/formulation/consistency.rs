//! How far accelerations are from what the constraints ask of them.

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array;

/// The row whose accelerations are farthest from `D u' = gamma*`, and how far: relative to the sum
/// of the sizes of its terms, `|D| |u'|`, `|D| M^-1 |g|` (what applied forces would do without
/// constraints), `|D|` times accelerations that it is seen beside, and `|gamma*|`. Zero where all
/// are met, about one where a constraint does nothing.
pub(crate) fn inconsistency<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (time, state): (S, &M::State<S>),
    (accelerations, beside): (&M::Velocities<S>, S),
    forces: &M::Velocities<S>,
    gamma: &M::Multipliers<S>,
) -> (usize, S) {
    let jacobian = M::jacobian(constants, time, state);
    let mass = M::metric(constants);
    let mut missing = *gamma;
    let mut terms = *gamma;
    for term in terms.as_mut_slice() {
        *term = term.abs();
    }
    for block in M::REPORT.blocks {
        let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
        let rows = missing.as_mut_slice().iter_mut().zip(terms.as_mut_slice());
        let rows = rows.skip(block.row).take(block.rows);
        for ((missing, terms), row) in rows.zip(values.chunks(block.columns.max(1))) {
            let moved = accelerations.as_slice().iter().zip(forces.as_slice());
            let moved = moved.zip(mass.as_slice()).skip(block.column);
            for (&value, ((&acceleration, &force), &mass)) in row.iter().zip(moved) {
                *missing = *missing - value * acceleration;
                let size = acceleration.abs() + force.abs().quotient(mass) + beside;
                *terms = value.abs().fused(size, *terms);
            }
        }
    }
    let mut worst = (0, S::zero());
    let rows = missing.as_slice().iter().zip(terms.as_slice());
    for (row, (missing, &terms)) in rows.enumerate() {
        if missing.abs() > worst.1 * terms {
            worst = (row, missing.abs().quotient(terms));
        }
    }
    worst
}
