//! The angles of joints that leave two turns.

use core::borrow::Borrow;

use crate::math::scalar::Scalar;
use crate::measure::view::View;
use crate::mechanism::handle::{HasTwoAngles, JointHandle};
use crate::mechanism::kernels::Mechanism;

/// The first angle is that about the axis of the first body. The second is that about the axis of
/// the second body, which the first turn carries. Both are right-handed turns of the second body
/// against the first, and zero in the reference configuration.
impl<S: Scalar, M: Mechanism, K: Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// Both angles of a joint (rad), from `-pi` to `pi`, where they jump.
    #[must_use]
    pub fn angles<J: HasTwoAngles>(&self, joint: JointHandle<M, J>) -> [S; 2] {
        let parts = M::joint_angles(self.constants(), self.state(), joint.index());
        parts.map(|parts| parts.sine.atan2(parts.cosine))
    }

    /// The rates of both angles (rad/s), with the signs of [`View::angles`].
    #[must_use]
    pub fn angle_rates<J: HasTwoAngles>(&self, joint: JointHandle<M, J>) -> [S; 2] {
        let parts = M::joint_angles(self.constants(), self.state(), joint.index());
        parts.map(|parts| parts.rate)
    }
}
