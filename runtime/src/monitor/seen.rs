//! What evaluations leave behind on the way of an integration.

use crate::math::scalar::Real;

/// Kept by [`Dynamics`](crate::dynamics::Dynamics) at every evaluation, for the monitor to read at
/// the end of a step.
#[derive(Clone, Copy)]
pub(crate) struct Seen<S> {
    /// The smallest relative pivot of the last evaluation, without its joint: to find that costs
    /// more than to look again at the end of a run.
    pub(crate) pivot: S,
    /// The largest `| |p| - 1 |` of a body at the end of the last step, before it was mended.
    pub(crate) drift: S,
}

impl<S: Real> Seen<S> {
    pub(crate) fn nothing() -> Self {
        Self {
            pivot: S::one(),
            drift: S::zero(),
        }
    }
}
