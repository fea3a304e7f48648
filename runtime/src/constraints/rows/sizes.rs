//! What a violation is compared with: what is a size of the row, and what its terms resolve.

use super::REACHED;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array;

/// What a violation is compared with, row by row.
pub(crate) struct Sizes<S: Scalar, M: Mechanism> {
    /// The size of the row's own joint: a length, or one radian.
    pub(super) natural: M::Multipliers<S>,
    /// What the terms of the row resolve: `EPSILON` times the sum of their sizes.
    pub(super) resolution: M::Multipliers<S>,
    /// What that is compared with: where it is no small part, nothing is resolved.
    pub(super) whole: M::Multipliers<S>,
    /// What counts as zero in a row: of velocities, those whose squares have lost digits to the end
    /// of the range of numbers, in the unit of the row. A mechanism that a law brings to rest gets
    /// there.
    pub(super) vanishing: M::Multipliers<S>,
}

copied!([S: Scalar, M: Mechanism] Sizes<S, M>);

/// Up to which multiple it counts as brought to: where the round-off of a solution comes on top,
/// which a further iteration need not lessen.
const RESOLVED: f64 = 32.0;

/// Of what is resolved to less than two digits nothing can be said.
const COARSEST: f64 = 1e-2;

impl<S: Real, M: Mechanism> Sizes<S, M> {
    /// The Euclidean norm of all violations, in sizes of their rows: what the terms of a row do not
    /// resolve at a tolerance adds to its size.
    pub(crate) fn measure(&self, violation: &M::Multipliers<S>, tolerance: S) -> S {
        let relative = self.relative(violation, tolerance);
        relative
            .fold(S::zero(), |sum, relative| relative.fused(relative, sum))
            .sqrt()
    }

    /// The size of a row, and what its terms resolve; `None` where there is no such row.
    pub(crate) fn of_row(&self, row: usize) -> Option<(S, S)> {
        let natural = self.natural.as_slice().get(row)?;
        Some((*natural, *self.resolution.as_slice().get(row)?))
    }

    /// The row of the largest violation, and this in sizes of the row. NaN if a violation is NaN.
    pub(crate) fn worst(&self, violation: &M::Multipliers<S>, tolerance: S) -> (usize, S) {
        let mut worst = (0, S::zero());
        for (row, relative) in self.relative(violation, tolerance).enumerate() {
            if relative.to_f64().is_nan() {
                return (row, relative);
            }
            if relative > worst.1 {
                worst = (row, relative);
            }
        }
        worst
    }

    fn relative<'a>(
        &'a self,
        violation: &'a M::Multipliers<S>,
        tolerance: S,
    ) -> impl Iterator<Item = S> + 'a {
        self.rows(violation)
            .map(move |(violation, natural, resolution, _)| {
                let size = natural + resolution.quotient(tolerance);
                if violation == S::zero() {
                    violation
                } else {
                    violation.quotient(size)
                }
            })
    }

    /// Whether no row is violated by more than its terms resolve, so that no iteration can help.
    pub(crate) fn reached(&self, violation: &M::Multipliers<S>) -> bool {
        let mut rows = self.rows(violation).zip(self.vanishing.as_slice());
        rows.all(|((violation, _, resolution, _), &vanishing)| {
            violation <= (S::constant(REACHED) * resolution).max(vanishing)
        })
    }

    /// Whether every row is violated by no more than a part of its size, or than what its terms
    /// resolve.
    pub(crate) fn within(&self, violation: &M::Multipliers<S>, part: S) -> bool {
        let mut rows = self.rows(violation).zip(self.vanishing.as_slice());
        rows.all(|((violation, natural, resolution, whole), &vanishing)| {
            let resolved = S::constant(RESOLVED) * resolution;
            let resolved = resolved.min(S::constant(COARSEST) * whole);
            violation <= (part * natural).max(resolved).max(vanishing)
        })
    }

    /// Absolute violation, size, resolution and the whole of every row.
    pub(super) fn rows<'a>(
        &'a self,
        violation: &'a M::Multipliers<S>,
    ) -> impl Iterator<Item = (S, S, S, S)> + 'a {
        let violation = violation.as_slice().iter();
        let rows = violation.zip(self.natural.as_slice());
        let rows = rows.zip(self.resolution.as_slice());
        rows.zip(self.whole.as_slice())
            .map(|(((violation, natural), resolution), whole)| {
                (violation.abs(), *natural, *resolution, *whole)
            })
    }
}
