//! Scalars, vectors and Euler parameters: nothing here knows a mechanism.

pub(crate) mod clock;
pub(crate) mod quaternion;
pub(crate) mod scalar;
pub(crate) mod vec3;
pub(crate) mod versine;
