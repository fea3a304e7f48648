//! Sums of slopes with constant weights.

use crate::math::scalar::Scalar;

/// The terms of a sum: slopes, each with a weight times the step.
#[inline(always)]
pub(super) fn terms<S: Scalar, X, const N: usize>(
    weights: [f64; N],
    step: S,
    slopes: [&X; N],
) -> [(S, &X); N] {
    let mut terms = slopes.map(|slope| (step, slope));
    for ((factor, _), weight) in terms.iter_mut().zip(weights) {
        *factor = S::constant(weight) * step;
    }
    terms
}
