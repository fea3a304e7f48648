//! The worst violation of every joint.
//!
//! A look costs `Phi` and `Phi'`. Only it finds a joint that opens slowly while the energy is
//! right: `tests/tests/alarms.rs`, an upright rod by joints.

use super::{Violation, exceeds};
use crate::constraints::row_units::RowUnits;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::JointInfo;
use crate::state::vector::Array;

/// The largest size of every row, as a length or an angle, and when.
pub(super) struct Worst<S: Scalar, M: Mechanism> {
    size: M::Multipliers<S>,
    time: M::Multipliers<S>,
}

impl<S: Scalar, M: Mechanism> Clone for Worst<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Worst<S, M> {}

impl<S: Real, M: Mechanism> Worst<S, M> {
    pub(super) fn none(start: S) -> Self {
        let mut time = M::Multipliers::<S>::zeros();
        time.as_mut_slice().fill(start);
        Self {
            size: M::Multipliers::<S>::zeros(),
            time,
        }
    }

    #[inline]
    pub(super) fn take(&mut self, rows: &[S], factors: &[S], now: S) {
        let places = self.size.as_mut_slice().iter_mut();
        let places = places.zip(self.time.as_mut_slice());
        for ((size, time), (&row, &factor)) in places.zip(rows.iter().zip(factors)) {
            let here = row.abs() * factor;
            if exceeds(here, *size) {
                (*size, *time) = (here, now);
            }
        }
    }

    pub(super) fn of(&self, rows: &RowUnits<S, M>, joint: &JointInfo) -> Violation<S> {
        let mut violation = Violation {
            length: S::zero(),
            angle: S::zero(),
            time: S::zero(),
        };
        let mut largest = -S::one();
        let sizes = self.size.as_slice().iter().zip(self.time.as_slice());
        let own = sizes.enumerate().skip(joint.row).take(joint.rows);
        for (row, (&size, &time)) in own {
            let kind = if rows.is_length(row) {
                &mut violation.length
            } else {
                &mut violation.angle
            };
            *kind = kind.max(size);
            if size > largest {
                (largest, violation.time) = (size, time);
            }
        }
        violation
    }
}
