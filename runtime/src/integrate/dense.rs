//! The state within a step.

use super::StepRecord;
use crate::math::scalar::Scalar;
use crate::state::vector::Vector;

/// The cubic through states and slopes at both ends, with an error of order `h^4`.
///
/// `y(theta) = (1 - c) y0 + c y1 + h theta (1 - theta)^2 f0 - h theta^2 (1 - theta) f1`,
/// `c = theta^2 (3 - 2 theta)` (Hairer, Norsett and Wanner, *Solving Ordinary Differential
/// Equations I*, II.6).
pub(super) fn cubic<S: Scalar, X: Vector<S>, K>(record: &StepRecord<'_, S, X, K>, theta: S) -> X {
    let rest = S::one() - theta;
    let weight = theta * theta * (S::constant(3.0) - theta - theta);
    let bend = record.step * theta * rest;
    // About what the step has added: the trapezoidal rule.
    let half = S::constant(0.5) * record.step;
    record.from.towards(
        record.to,
        weight,
        [(half, record.first), (half, record.last)],
        [(bend * rest, record.first), (-(bend * theta), record.last)],
    )
}

/// A polynomial without a constant term at the fraction `theta` of a step, times `step`: the weight
/// of a slope. `row` has its coefficients from `theta` on.
pub(super) fn polynomial<S: Scalar, const N: usize>(row: [f64; N], step: S, theta: S) -> S {
    let mut coefficients = row.into_iter().rev().map(S::constant);
    let highest = coefficients.next().unwrap_or(S::zero());
    step * theta * coefficients.fold(highest, |sum, lower| sum.fused(theta, lower))
}
