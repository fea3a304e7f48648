//! What was accepted although it did not converge.
//!
//! It costs a comparison a step: corrections and formulations count by themselves. Only it finds
//! that an augmented Lagrangian did not converge, whose motion looks right:
//! `tests/tests/sound/told.rs`.

use super::warning::Warning;
use crate::math::scalar::Real;

/// What was accepted although it did not converge, near a singular configuration or after one
/// application of a pseudo-inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Unconverged<S> {
    /// Corrections of a [`Projection`](crate::Projection), or of another
    /// [`PostStabilisation`](crate::run::PostStabilisation) that left more than its tolerance.
    pub corrections: usize,
    /// Evaluations of the augmented Lagrangian.
    pub evaluations: usize,
    /// The time (s) of the first.
    pub since: Option<S>,
}

impl<S: Real> Unconverged<S> {
    pub(super) fn none() -> Self {
        Self {
            corrections: 0,
            evaluations: 0,
            since: None,
        }
    }

    /// Counts a correction.
    pub(super) fn correction(&mut self, time: S) {
        self.corrections = self.corrections.saturating_add(1);
        self.since.get_or_insert(time);
    }

    /// Takes how many evaluations of the run there were up to a time.
    #[inline]
    pub(super) fn evaluations(&mut self, evaluations: usize, time: S) {
        if evaluations > self.evaluations {
            self.evaluations = evaluations;
            self.since.get_or_insert(time);
        }
    }

    pub(super) fn verdict(&self) -> Option<Warning> {
        let time = self.since?;
        Some(Warning::Unconverged {
            corrections: self.corrections,
            evaluations: self.evaluations,
            time: time.to_f64(),
        })
    }
}
