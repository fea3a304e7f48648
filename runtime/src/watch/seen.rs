//! What evaluations leave behind on the way of an integration.

use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::Array;

/// Kept by [`Dynamics`](crate::dynamics::Dynamics) at every evaluation, for the watch to read at
/// the end of a step.
pub(crate) struct Seen<S: Scalar, M: Mechanism> {
    /// The smallest relative pivot of the last evaluation, without its joint: to find that costs
    /// more than to look again at the end of a run.
    pub(crate) pivot: S,
    /// The multipliers of the last evaluation, of a mechanism with drivers.
    pub(crate) multipliers: M::Multipliers<S>,
    /// The power (W) of forces from a closure in the last evaluation.
    pub(crate) applied_power: S,
    /// The largest `| |p| - 1 |` of a body at the end of the last step, before it was mended.
    pub(crate) stretch: S,
}

impl<S: Scalar, M: Mechanism> Clone for Seen<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Seen<S, M> {}

impl<S: Real, M: Mechanism> Seen<S, M> {
    pub(crate) fn nothing() -> Self {
        Self {
            pivot: S::one(),
            multipliers: M::Multipliers::<S>::zeros(),
            applied_power: S::zero(),
            stretch: S::zero(),
        }
    }
}
