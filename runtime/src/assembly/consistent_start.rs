//! Whether a run may begin where it is told to.

use crate::constraints::apart::reach;
use crate::constraints::extent::resolution;
use crate::constraints::row_units::{RowUnits, characteristic_length};
use crate::constraints::rows::Rows;
use crate::constraints::side::check_sides;
use crate::error::{Fault, Quantity, StartFault};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::Block;
use crate::state::vector::{Array, StateParts};

/// A violation at the start that counts as an inexact number of a description, over the length of
/// the mechanism, over a radian, and over the velocities of the mechanism: four digits.
const INEXACT: f64 = 1e-4;

/// Refuses a start at which a joint is open, or its bodies move against it so fast that it would
/// open over the run; `is_final` says that no run could accept it.
pub(crate) fn check_start<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (time, duration): (S, S),
    state: &M::State<S>,
    is_final: bool,
) -> Result<(), Fault> {
    check_sides::<S, M>(constants, state)?;
    let fault = |row: usize, quantity: Quantity, violation: S| {
        Fault::Start(StartFault::Inconsistent {
            joint: M::REPORT.joint_of(row).unwrap_or_default(),
            quantity,
            violation: violation.to_f64(),
            is_final,
        })
    };
    let rows = RowUnits::<S, M>::of(&Rows::at(constants, time, state));
    let length = characteristic_length::<S, M>(constants, state);
    let inexact = S::constant(INEXACT);
    let size = |is_length: bool| if is_length { length } else { S::one() };
    let phi = M::constraints(constants, time, state);
    let resolution = S::constant(8.0) * resolution::<S, M>(state);
    for (row, (&phi, &factor)) in phi.as_slice().iter().zip(rows.factors()).enumerate() {
        let is_length = rows.is_length(row);
        let violation = phi.abs() * factor;
        if violation > inexact * size(is_length) + resolution {
            let quantity = if is_length {
                Quantity::Length
            } else {
                Quantity::Angle
            };
            return Err(fault(row, quantity, violation));
        }
    }
    let phi_rate = constraint_rates::<S, M>(constants, time, state);
    let fastest = reach::<S, M>(state.velocities(), length).size;
    for (row, (&rate, &factor)) in phi_rate.as_slice().iter().zip(rows.factors()).enumerate() {
        let is_length = rows.is_length(row);
        let violation = rate.abs() * factor;
        let opens = violation * duration > inexact * size(is_length);
        // Small beside the velocities in lengths of the mechanism, it is a number of few digits.
        if opens && violation > inexact * fastest * size(is_length) {
            let quantity = if is_length {
                Quantity::Speed
            } else {
                Quantity::AngularVelocity
            };
            return Err(fault(row, quantity, violation));
        }
    }
    Ok(())
}

/// `Phi'`, by `D u` where the time stands in no equation, because `D` is compiled already.
fn constraint_rates<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> M::Multipliers<S> {
    if const { M::REPORT.time.constraints } {
        return M::constraint_rates(constants, time, state);
    }
    let mut rates = M::Multipliers::<S>::zeros();
    let jacobian = M::jacobian(constants, time, state);
    add_products(
        M::REPORT.blocks,
        jacobian.as_slice(),
        state.velocities().as_slice(),
        rates.as_mut_slice(),
    );
    rates
}

/// Adds `D u`.
fn add_products<S: Scalar>(blocks: &[Block], jacobian: &[S], velocities: &[S], sums: &mut [S]) {
    for block in blocks {
        let entries = jacobian.get(block.offset..).unwrap_or(&[]);
        let of_body = velocities.get(block.column..).unwrap_or(&[]);
        let sums = sums.iter_mut().skip(block.row).take(block.rows);
        for (sum, row) in sums.zip(entries.chunks_exact(block.columns.max(1))) {
            for (&entry, &u) in row.iter().zip(of_body) {
                *sum = entry.fused(u, *sum);
            }
        }
    }
}
