//! The rows of `Phi` as lengths and angles, and how large the mechanism is.

use crate::constraints::extent;
use crate::constraints::rows::Rows;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::read;
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::Array;

/// The factors by which rows of `Phi` become lengths (m) or angles (rad), at a state.
pub(crate) struct RowUnits<S: Scalar, M: Mechanism> {
    factors: M::Multipliers<S>,
    /// One where a row speaks of a length, zero where of an angle.
    lengths: M::Multipliers<S>,
}

copied!([S: Scalar, M: Mechanism] RowUnits<S, M>);

impl<S: Real, M: Mechanism> RowUnits<S, M> {
    pub(crate) fn of(rows: &Rows<S, M>) -> Self {
        let mut units = Self {
            factors: M::Multipliers::<S>::zeros(),
            lengths: M::Multipliers::<S>::zeros(),
        };
        let factors = units.factors.as_mut_slice().iter_mut();
        let places = factors.zip(units.lengths.as_mut_slice());
        for ((factor, length), (size, is_length)) in places.zip(rows.row_units()) {
            *factor = size.reciprocal();
            *length = if is_length { S::one() } else { S::zero() };
        }
        units
    }

    pub(crate) fn factors(&self) -> &[S] {
        self.factors.as_slice()
    }

    pub(crate) fn is_length(&self, row: usize) -> bool {
        let length = self.lengths.as_slice().get(row);
        length.is_some_and(|&length| length > S::zero())
    }
}

/// The length of a mechanism (m): how far its centres of mass and the points of its joints reach,
/// or its largest radius of gyration; 1 where there is neither.
pub(crate) fn characteristic_length<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
) -> S {
    let mut length = extent::extent::<S, M>(constants, state);
    let mass = M::metric(constants);
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let [m, _, _, a, b, c] = read(mass.as_slice(), body.velocity);
            length = length.max(a.max(b).max(c).quotient(m).sqrt());
        }
    }
    if length > S::zero() && length.is_finite() {
        length
    } else {
        S::one()
    }
}
