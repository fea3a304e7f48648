//! Multipliers that load no body.

use crate::array::Array;
use crate::mechanism::Mechanism;
use crate::report::BodyKind;
use crate::scalar::Real;

/// Loads that cancel to this part of what they are one by one: equations that are as good as dependent.
const CANCELLED: f64 = 1e-2;

/// Whether multipliers are nearly a state of self-stress: equation by equation they load the bodies, but together the loads
/// `D^T lambda` cancel to a hundredth, on every body.
///
/// Such multipliers exist where equations depend on each other, nearly or exactly: the loads of independent equations do not
/// cancel. Moments count as forces at the radius of gyration, so that neither units nor masses weigh: a light
/// body between heavy ones is not a dependence.
pub(crate) fn self_stressed<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    multipliers: &M::Multipliers<S>,
) -> bool {
    let jacobian = M::jacobian(constants, time, state);
    let leverages = leverages::<S, M>(constants);
    let mut together = M::Velocities::<S>::zeros();
    let mut one_by_one = S::zero();
    for block in M::REPORT.blocks {
        let values = jacobian.as_slice().get(block.offset..).unwrap_or(&[]);
        let rows = values.chunks(block.columns.max(1)).take(block.rows);
        let multipliers = multipliers.as_slice().iter().skip(block.row);
        for (row, &multiplier) in rows.zip(multipliers) {
            let sums = together.as_mut_slice().iter_mut();
            let places = sums.zip(leverages.as_slice()).skip(block.column);
            for ((sum, &leverage), &value) in places.zip(row) {
                let load = value * multiplier;
                *sum = *sum + load;
                one_by_one = (load * load).fused(leverage, one_by_one);
            }
        }
    }
    let places = together.as_slice().iter().zip(leverages.as_slice());
    let left = places.fold(S::zero(), |sum, (&load, &leverage)| {
        (load * load).fused(leverage, sum)
    });
    left <= S::constant(CANCELLED * CANCELLED) * one_by_one
}

/// What the square of a load counts: 1 for a force, `m / J` for a moment.
fn leverages<S: Real, M: Mechanism>(constants: &M::Constants<S>) -> M::Velocities<S> {
    let mut leverages = M::mass(constants);
    for body in M::REPORT.bodies {
        let elements = match body.kind {
            BodyKind::Rigid => 6,
            BodyKind::Particle => 3,
        };
        let own = leverages.as_mut_slice().iter_mut().skip(body.velocity);
        let mut mass = None;
        for element in own.take(elements) {
            let mass = *mass.get_or_insert(*element);
            *element = mass.quotient(*element);
        }
    }
    leverages
}
