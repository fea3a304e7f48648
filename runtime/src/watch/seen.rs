//! What evaluations leave behind on the way of an integration.

use crate::array::Array;
use crate::mechanism::{Mechanism, Pivot};
use crate::scalar::{Real, Scalar};

/// Kept by [`Dynamics`](crate::Dynamics) at every evaluation, for the watch to read at the end of a step.
pub(crate) struct Seen<S: Scalar, M: Mechanism> {
    /// The smallest relative pivot of the evaluations since it was read, and the time of it.
    pub(crate) least: Nearest<S>,
    /// The relative pivot of the last evaluation.
    pub(crate) last: Pivot<S>,
    /// The multipliers of the last evaluation, of a mechanism with drivers or a formulation that yields.
    pub(crate) multipliers: M::Multipliers<S>,
    /// The accelerations of the last evaluation, of a formulation that yields.
    pub(crate) accelerations: M::Velocities<S>,
    /// The power (W) of forces from a closure in the last evaluation.
    pub(crate) applied_power: S,
    /// The largest `| |p| - 1 |` at the end of a step, before it was mended.
    pub(crate) stretch: S,
}

/// A relative pivot, its joint and its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest<S> {
    pub(crate) pivot: Pivot<S>,
    pub(crate) time: S,
}

impl<S: Scalar> Nearest<S> {
    pub(crate) fn none() -> Self {
        Self {
            pivot: Pivot {
                relative: S::constant(f64::INFINITY),
                joint: S::zero(),
            },
            time: S::zero(),
        }
    }
}

impl<S: Real, M: Mechanism> Seen<S, M> {
    pub(crate) fn nothing() -> Self {
        Self {
            least: Nearest::none(),
            last: Pivot::unchecked(),
            multipliers: M::Multipliers::<S>::zeros(),
            accelerations: M::Velocities::<S>::zeros(),
            applied_power: S::zero(),
            stretch: S::zero(),
        }
    }

    #[inline(always)]
    pub(crate) fn pivot(&mut self, pivot: Pivot<S>, time: S) {
        self.last = pivot;
        if pivot.relative < self.least.pivot.relative {
            self.least = Nearest { pivot, time };
        }
    }

    /// The smallest relative pivot since this was called last.
    pub(crate) fn take_least(&mut self) -> Nearest<S> {
        core::mem::replace(&mut self.least, Nearest::none())
    }
}
