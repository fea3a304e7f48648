//! The compliance of every row, from the factor of a penalty.

use crate::constraints::rows::{Rows, fraction, moving};
use crate::error::{Fault, StartFault};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::{Mechanism, Stabilisation, Terms};
use crate::state::vector::{Array, StateParts as _};

/// A compliance below so many `EPSILON` of what a row yields to a unit load is lost in the
/// round-off of it: of rows that depend on others nothing else is left.
pub(crate) const RESOLVED: f64 = 64.0;

/// The compliance of every row: that of the formulation, in the unit of the row at the reference
/// configuration, with `radian` metres for a radian.
///
/// # Errors
/// [`StartFault::PenaltyFactor`] where equations are kept that depend on others and the compliance
/// is lost in round-off.
pub fn compliances<S: Real, M: Mechanism, T: Terms>(
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

/// Hands over all numbers that the units of rows, and so their compliances, are made of: what none
/// of these depends on changes no compliance. For numbers that cannot be compared, as units are
/// chosen by comparisons.
pub fn numbers_of_units<S: Scalar, M: Mechanism>(
    constants: &M::Constants<S>,
    mut each: impl FnMut(S),
) {
    let described = M::initial_state(constants);
    let jacobian = M::jacobian(constants, S::zero(), &described);
    let mut all = |numbers: &[S]| numbers.iter().for_each(|&number| each(number));
    all(described.coordinates().as_slice());
    all(jacobian.as_slice());
    for (joint, info) in M::REPORT.joints.iter().enumerate() {
        for place in 0..info.bodies.len() {
            all(&M::joint_point(constants, joint, place));
        }
    }
    if M::REPORT.curved {
        let rest = moving::<S, M>(&described, |_| S::zero());
        let motion = moving::<S, M>(&described, fraction);
        for state in [rest, motion] {
            all(M::gamma(constants, S::zero(), &state).as_slice());
        }
    }
}
