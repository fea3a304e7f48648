//! A time, with the bodies at it.

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// Where a motion is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct At<S, B> {
    /// The time (s).
    pub(crate) time: S,
    /// The state of the bodies.
    pub(crate) bodies: B,
}

/// Where the motion of a mechanism is.
pub(crate) type StateAt<S, M> = At<S, <M as Mechanism>::State<S>>;

impl<S: Real, B> At<S, B> {
    /// The same, borrowed.
    pub(crate) fn borrowed(&self) -> (S, &B) {
        (self.time, &self.bodies)
    }
}

/// Bodies at a time (s).
pub(crate) fn at<S, B>(time: S, bodies: B) -> At<S, B> {
    At { time, bodies }
}
