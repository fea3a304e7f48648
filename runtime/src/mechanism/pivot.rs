//! What a factorisation tells of its pivots.

use crate::math::scalar::Scalar;

/// The smallest relative pivot of a factorisation and its joint, per lane.
///
/// A relative pivot is the pivot of a row over what it would be without the other rows: 1 for a row
/// that is orthogonal to the others (in the metric of the inverse mass matrix), 0 for a row that
/// depends on them. Where two rows determine two components of an angular acceleration, it is their
/// determinant over that of the reference configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pivot<S> {
    /// About 1 or less; 1 where no pivot had to be checked.
    pub relative: S,
    /// The index of the joint, as a number.
    pub joint: S,
}

impl<S: Scalar> Pivot<S> {
    /// No pivot needed a check.
    #[must_use]
    pub fn unchecked() -> Self {
        Self {
            relative: S::one(),
            joint: S::zero(),
        }
    }

    /// Takes a pivot into account from which nothing was subtracted: only zero is bad.
    #[inline(always)]
    #[must_use]
    pub fn and_nonzero(self, pivot: S, joint: usize) -> Self {
        /// The least normal number of single precision: the reciprocal of a smaller one is out of
        /// its range. No unit leads there, as a bound between large and small would have to know.
        const LEAST: f64 = f32::MIN_POSITIVE as f64;
        let least = S::constant(LEAST);
        self.and(pivot.abs().select(least, S::zero(), S::one()), joint)
    }

    /// Takes another relative pivot into account.
    #[inline(always)]
    #[must_use]
    pub fn and(self, relative: S, joint: usize) -> Self {
        // Zero over zero is a row that vanishes.
        let relative = relative.select(S::constant(f64::INFINITY), relative, S::zero());
        Self {
            relative: relative.select(self.relative, relative, self.relative),
            joint: relative.select(self.relative, S::constant(joint as f64), self.joint),
        }
    }
}
