//! How numbers are compared: corrected relative error and the tolerances of the two float types.

use nalgebra::DVector;

/// What kernels that compute the same thing in two ways may differ by in double precision, as
/// corrected relative error.
pub const DOUBLE: f64 = 1e-12;

/// The same in single precision.
pub const SINGLE: f64 = 1e-4;

/// Corrected relative error: `|a - b| / max(1, |a|, |b|)`. Relative for large numbers, absolute for
/// small ones; infinite if one of them is not a number.
#[must_use]
pub fn relative_error(a: f64, b: f64) -> f64 {
    scaled_error(a, b, 1.0)
}

/// `|a - b| / max(scale, |a|, |b|)`: `scale` is the size below which a number of this kind counts
/// as small. Infinite if one of the two is not a number; zero if they are equal.
#[must_use]
pub fn scaled_error(a: f64, b: f64, scale: f64) -> f64 {
    let error = (a - b).abs() / scale.max(a.abs()).max(b.abs());
    if a == b {
        0.0
    } else if error.is_nan() {
        f64::INFINITY
    } else {
        error
    }
}

/// The largest error of two rows of numbers, all measured on the scale of the largest number in
/// both (at least 1); so an entry that cancels is not held to more digits than the entries it was
/// made of.
///
/// # Panics
/// If they have different lengths.
#[must_use]
pub fn largest_error(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "rows of different lengths");
    let scale = a
        .iter()
        .chain(b)
        .fold(1.0, |scale: f64, x| scale.max(x.abs()));
    a.iter()
        .zip(b)
        .map(|(a, b)| scaled_error(*a, *b, scale))
        .fold(0.0, f64::max)
}

/// Asserts that [`largest_error`] is within a tolerance, and says where it is not.
///
/// # Panics
/// If it is not, or the lengths differ.
#[track_caller]
pub fn assert_close(what: &str, a: &[f64], b: &[f64], tolerance: f64) {
    let error = largest_error(a, b);
    assert!(
        error <= tolerance,
        "{what}: error {error:e} above {tolerance:e}\n left {a:?}\nright {b:?}"
    );
}

/// Euclidean distance over the norm of the reference, or over `floor` where the reference is
/// smaller: what is zero but for cancelling numbers of that size is known to that size only.
/// Infinite if a number is none.
///
/// # Panics
/// If they have different lengths.
#[must_use]
pub fn distance(computed: &[f64], reference: &[f64], floor: f64) -> f64 {
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
pub struct Worst(pub f64);

impl Worst {
    /// Takes a deviation into account, and refuses it above the tolerance.
    ///
    /// # Panics
    /// Above the tolerance.
    #[track_caller]
    pub fn take(&mut self, what: &str, deviation: f64, tolerance: f64) {
        assert!(
            deviation <= tolerance,
            "{what}: deviation {deviation:e} above {tolerance:e}"
        );
        self.0 = self.0.max(deviation);
    }
}
