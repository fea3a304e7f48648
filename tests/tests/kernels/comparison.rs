//! What two computations of one thing may differ by.

use holonom::Real;
use nalgebra::DVector;

/// What kernels that compute one thing in two ways may differ by in double precision, relative to the norm of a block.
pub(crate) const DOUBLE: f64 = 1e-12;

/// What solutions may differ by in double precision, times the condition number of the saddle system: 45 units of round-off, for
/// two factorisations and two right-hand sides of some hundred operations.
pub(crate) const SOLUTION: f64 = 1e-14;

/// A tolerance of double precision for a number type: times `2^29` in single precision, whose digits are 29 bits fewer.
pub(crate) fn tolerance<S: Real>(double: f64) -> f64 {
    double * (S::EPSILON.to_f64() / f64::EPSILON)
}

/// Euclidean distance over the norm of the reference; over 1 where the reference is smaller and `floor` says so, because
/// what is zero but for cancelling numbers of the size 1 (m, m/s) is known to that size only.
pub(crate) fn distance(computed: &[f64], reference: &[f64], floor: f64) -> f64 {
    assert_eq!(computed.len(), reference.len());
    let reference = DVector::from_column_slice(reference);
    let error = (DVector::from_column_slice(computed) - &reference).norm();
    let ratio = error / reference.norm().max(floor);
    match () {
        () if error == 0.0 => 0.0,
        () if ratio.is_nan() => f64::INFINITY,
        () => ratio,
    }
}

/// The largest deviation of a comparison so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Worst(pub f64);

impl Worst {
    /// Takes a deviation into account, and refuses it above the tolerance.
    #[track_caller]
    pub(crate) fn take(&mut self, what: &str, deviation: f64, tolerance: f64) {
        assert!(
            deviation <= tolerance,
            "{what}: deviation {deviation:e} above {tolerance:e}"
        );
        self.0 = self.0.max(deviation);
    }
}
