//! What two computations of one thing may differ by.

use holonom::Real;
pub(crate) use holonom_assembler::accuracy::{Worst, distance};

/// What kernels that compute one thing in two ways may differ by in double precision, relative to
/// the norm of a block.
pub(crate) const DOUBLE: f64 = 1e-12;

/// What solutions may differ by in double precision, times the condition number of the saddle
/// system: 45 units of round-off, for two factorisations and two right-hand sides of some hundred
/// operations.
pub(crate) const SOLUTION: f64 = 1e-14;

/// A tolerance of double precision for a number type: times `2^29` in single precision, whose
/// digits are 29 bits fewer.
pub(crate) fn tolerance<S: Real>(double: f64) -> f64 {
    double * (S::EPSILON.to_f64() / f64::EPSILON)
}
