//! A state of the bodies, to be read over any numbers.

use crate::math::scalar::Scalar;
use crate::mechanism::kernels::Mechanism;

/// Where and how a mechanism is, to be read.
pub(crate) struct Scene<'a, S: Scalar, M: Mechanism> {
    pub(crate) constants: &'a M::Constants<S>,
    pub(crate) time: S,
    pub(crate) bodies: &'a M::State<S>,
}

impl<S: Scalar, M: Mechanism> Clone for Scene<'_, S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Scene<'_, S, M> {}
