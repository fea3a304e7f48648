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

/// What a row of `Phi` may be at a start.
#[derive(Clone, Copy, Debug)]
pub struct StartRow<S> {
    /// By what a violation becomes metres or radians.
    pub factor: S,
    /// Whether it is metres.
    pub is_length: bool,
    /// The violation (m, rad) that is accepted.
    pub accepted: S,
    /// The violation (m/s, rad/s) of `Phi'` that is accepted, over a second and for velocities up
    /// to one length of the mechanism in a second. For larger ones it grows with them.
    pub accepted_rate: S,
}

/// What all rows may be.
struct StartRows<S: Scalar, M: Mechanism> {
    rows: RowUnits<S, M>,
    /// The length of the mechanism (m).
    length: S,
    /// What the digits of positions resolve (m).
    resolution: S,
}

impl<S: Real, M: Mechanism> StartRows<S, M> {
    fn at(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        Self {
            rows: RowUnits::<S, M>::of(&Rows::at(constants, time, state)),
            length: characteristic_length::<S, M>(constants, state),
            resolution: S::constant(8.0) * resolution::<S, M>(state),
        }
    }

    fn each(&self) -> impl Iterator<Item = StartRow<S>> + '_ {
        let factors = self.rows.factors().iter().enumerate();
        factors.map(|(row, &factor)| {
            let is_length = self.rows.is_length(row);
            let size = if is_length { self.length } else { S::one() };
            let inexact = S::constant(INEXACT) * size;
            StartRow {
                factor,
                is_length,
                accepted: inexact + self.resolution,
                accepted_rate: inexact,
            }
        })
    }
}

/// What the rows of `Phi` may be at a start near a state, one after the other, and the length of
/// the mechanism (m): for programs that check starts as [`check_start`] does.
pub fn start_rows<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    row: impl FnMut(StartRow<S>),
) -> S {
    let rows = StartRows::<S, M>::at(constants, time, state);
    rows.each().for_each(row);
    rows.length
}

/// Refuses a start at which a joint is open, or its bodies move against it so fast that it would
/// open over the run; `is_final` says that no run could accept it.
pub fn check_start<S: Real, M: Mechanism>(
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
    let rows = StartRows::<S, M>::at(constants, time, state);
    let phi = M::constraints(constants, time, state);
    for (row, (&phi, of)) in phi.as_slice().iter().zip(rows.each()).enumerate() {
        let violation = phi.abs() * of.factor;
        if violation > of.accepted {
            let quantity = if of.is_length {
                Quantity::Length
            } else {
                Quantity::Angle
            };
            return Err(fault(row, quantity, violation));
        }
    }
    let phi_rate = constraint_rates::<S, M>(constants, time, state);
    let fastest = reach::<S, M>(state.velocities(), rows.length).size;
    for (row, (&rate, of)) in phi_rate.as_slice().iter().zip(rows.each()).enumerate() {
        let violation = rate.abs() * of.factor;
        let opens = violation * duration > of.accepted_rate;
        // Small beside the velocities in lengths of the mechanism, it is a number of few digits.
        if opens && violation > fastest * of.accepted_rate {
            let quantity = if of.is_length {
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
