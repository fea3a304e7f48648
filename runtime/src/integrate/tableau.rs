//! Sums of slopes with constant weights.

use crate::math::names::is_same;
use crate::math::scalar::Scalar;

/// A Butcher tableau of an explicit Runge-Kutta method: `y_i = y + h sum of a_ij k_j`, and the end
/// `y + h sum of b_j k_j`. The slope 0 is that at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Tableau {
    /// Of each stage after the start, the slopes `j` with their weights `a_ij`.
    pub stages: &'static [&'static [(usize, f64)]],
    /// The slopes `j` with their weights `b_j`.
    pub result: &'static [(usize, f64)],
}

/// The place of a name, which stands among these.
pub(super) const fn place(names: &[&str], name: &str) -> usize {
    let mut place = 0;
    while !is_same(names[place], name) {
        place += 1;
    }
    place
}

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
