//! The compliance of every row, from the factor of a penalty.

use crate::constraints::rows::Rows;
use crate::error::{Fault, StartFault};
use crate::math::scalar::Real;
use crate::mechanism::kernels::{Mechanism, Stabilisation, Terms};
use crate::state::vector::Array;

/// A compliance below so many `EPSILON` of what a row yields to a unit load is lost in the
/// round-off of it: of rows that depend on others nothing else is left.
pub(crate) const RESOLVED: f64 = 64.0;

/// The compliance of every row: that of the formulation, in the unit of the row at the reference
/// configuration, with `radian` metres for a radian.
///
/// # Errors
/// [`StartFault::PenaltyFactor`] where equations are kept that depend on others and the compliance
/// is lost in round-off.
pub(crate) fn compliances<S: Real, M: Mechanism, T: Terms>(
    constants: &M::Constants<S>,
    stabilisation: &Stabilisation<S>,
    radian: S,
) -> Result<M::Multipliers<S>, Fault> {
    if !T::COMPLIANT {
        return Ok(M::Multipliers::<S>::zeros());
    }
    let described = M::initial_state(constants);
    let rows = Rows::<S, M>::at(constants, S::zero(), &described);
    let mut compliances = rows.units(radian);
    let mut largest: Option<S> = None;
    let elements = compliances.as_mut_slice().iter_mut();
    for (compliance, &stiffness) in elements.zip(rows.stiffness.as_slice()) {
        let unit = *compliance;
        *compliance = unit * stabilisation.compliance;
        let lost = S::constant(RESOLVED) * S::EPSILON * stiffness;
        if lost > S::zero() {
            let limit = unit.quotient(lost);
            largest = Some(largest.map_or(limit, |known| known.min(limit)));
        }
    }
    let alpha = stabilisation.compliance.reciprocal();
    let depends = M::REPORT.keeps_redundant();
    match largest {
        Some(largest) if depends && alpha > largest => {
            Err(Fault::Start(StartFault::PenaltyFactor {
                alpha: alpha.to_f64(),
                largest: largest.to_f64(),
            }))
        }
        _ => Ok(compliances),
    }
}
