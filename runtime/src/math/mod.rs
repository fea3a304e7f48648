//! Scalars, vectors and Euler parameters: nothing here knows a mechanism.
//!
//! `Scalar` has what kernels need, and no comparison but `select`. `Real` adds what integrators
//! need. The time of a stepper is a sum of two numbers (`clock.rs`): one holds what the last digits
//! of the other leave over. `versine.rs` turns pairs by increments. `angles.rs` reads rotations as
//! three angles. `spline` has functions from tables. `side.rs` is what laws that switch are made
//! of. `without_bounds.rs` has what `derive` would ask too much for.

pub(crate) mod angles;
pub(crate) mod clock;
pub(crate) mod names;
pub(crate) mod quaternion;
pub(crate) mod scalar;
pub(crate) mod side;
pub(crate) mod spline;
pub(crate) mod vec3;
pub(crate) mod versine;
pub(crate) mod without_bounds;
