//! The choice of step and order, from estimates of errors.

use super::coefficients::HIGHEST;
use crate::math::scalar::Real;

/// The coefficients of the errors at orders 1 to 13, of Moulton's formulas: Shampine and Gordon,
/// subroutine STEP, to the digits given there.
const ERRORS: [f64; 13] = [
    0.5, 0.0833, 0.0417, 0.0264, 0.0188, 0.0143, 0.0114, 0.009_36, 0.007_89, 0.006_79, 0.005_92,
    0.005_24, 0.004_68,
];

/// The coefficient of the error at an order.
pub(super) fn coefficient<S: Real>(order: usize) -> S {
    let coefficient = ERRORS.get(order.wrapping_sub(1)).copied();
    S::constant(coefficient.unwrap_or(f64::NAN))
}

/// What the errors of a trial say.
#[derive(Clone, Copy)]
pub(super) struct Errors<S> {
    /// Of the trial at its order, and at one order less.
    pub(super) here: S,
    pub(super) below: S,
    /// Whether one order less would do.
    pub(super) lowers: bool,
}

/// Order and step after an accepted step of that order and size: block 4 of STEP, without its
/// beginning. `above` is the error at one order more, where steps are equal so that it is known.
pub(super) fn chosen<S: Real>(
    (order, step): (usize, S),
    allowed: S,
    errors: Errors<S>,
    above: Option<S>,
) -> (usize, S) {
    let Errors {
        here,
        below,
        lowers,
    } = errors;
    let (order, error) = match above {
        _ if lowers => (order - 1, below),
        Some(above) if order > 1 && below <= here.min(above) => (order - 1, below),
        Some(above) if order == 1 && above < S::constant(0.5) * here => (2, above),
        Some(above) if (2..HIGHEST).contains(&order) && above < here => (order + 1, above),
        _ => (order, here),
    };
    let power = order + 1;
    let doubled = error * S::constant((1_u32 << power) as f64);
    let step = if allowed >= doubled {
        step + step
    } else if allowed >= error {
        step
    } else {
        let factor = allowed.quotient(error).powf(1.0 / power as f64);
        step * S::constant(0.5).max(factor.min(S::constant(0.9)))
    };
    (order, step)
}
