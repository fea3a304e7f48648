//! What two computations of one thing may differ by.

use nalgebra::DVector;

/// What kernels that compute one thing in two ways may differ by, relative to the norm of a block.
pub(crate) const ROUND_OFF: f64 = 1e-12;

/// Euclidean distance over the norm of the reference, or over `floor` where the reference is smaller: what is zero but for cancelling
/// numbers of that size is known to that size only.
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
