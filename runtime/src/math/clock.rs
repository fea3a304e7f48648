//! Time that is summed step by step.

use crate::math::scalar::Real;

/// A time and what its last digits leave over: steps add up without a growing error, however many
/// there are and however short.
///
/// The sum of two numbers with its rounding error, after Knuth, *The Art of Computer Programming*
/// 2, section 4.2.2, theorem B.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Clock<S> {
    time: S,
    rest: S,
}

impl<S: Real> Clock<S> {
    pub(crate) fn at(time: S) -> Self {
        Self {
            time,
            rest: S::zero(),
        }
    }

    /// The time, to the last of its digits.
    pub(crate) fn time(&self) -> S {
        self.time
    }

    #[must_use]
    pub(crate) fn after(&self, step: S) -> Self {
        let increment = step + self.rest;
        let time = self.time + increment;
        let added = time - self.time;
        let rest = (self.time - (time - added)) + (increment - added);
        Self { time, rest }
    }
}
