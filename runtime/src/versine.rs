//! Sine and versine, of which a turn by an angle is made.
//!
//! `1 - cos` by itself keeps the digits of small angles: a turn adds a small increment, which is rounded once.

use crate::scalar::Scalar;

/// Angles (rad) for which the series of each type of numbers leave nothing beyond round-off.
pub(crate) const SMALL: f64 = 0.5;

/// `-1/3!, 1/5!, ..`: the first six go to `a^13`, what follows is `a^15/15!`, 4.7e-17 of `a` at [`SMALL`]; the first three to `a^7`, 1.1e-8.
pub(crate) const SINE: [f64; 6] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
];

/// `-1/4!, 1/6!, ..`: the first six go to `a^14`, what follows is `a^16/16!`, 7.3e-19 at [`SMALL`]; the first three to `a^8`, 2.7e-10.
pub(crate) const VERSINE: [f64; 6] = [
    -1.0 / 24.0,
    1.0 / 720.0,
    -1.0 / 40_320.0,
    1.0 / 3_628_800.0,
    -1.0 / 479_001_600.0,
    1.0 / 87_178_291_200.0,
];

/// `[sin a, 1 - cos a]` of any angle (rad), by the functions of half the angle: both keep their digits.
#[inline]
pub(crate) fn of<S: Scalar>(angle: S) -> [S; 2] {
    let half = S::constant(0.5) * angle;
    let sine = half.sin();
    let twice = sine + sine;
    [twice * half.cos(), twice * sine]
}

/// `[sin a, 1 - cos a]` of a small angle (rad), by as many terms of [`SINE`] and [`VERSINE`] as the slices have.
#[inline(always)]
pub(crate) fn of_small<S: Scalar>(angle: S, sine: &[f64], versine: &[f64]) -> [S; 2] {
    let square = angle * angle;
    let fourth = square * square;
    [
        polynomial(square, fourth, sine).fused(square * angle, angle),
        polynomial(square, fourth, versine).fused(fourth, S::constant(0.5) * square),
    ]
}

/// A polynomial in `x`, by pairs of terms, which do not wait for each other.
#[inline(always)]
fn polynomial<S: Scalar>(x: S, square: S, coefficients: &[f64]) -> S {
    let pairs = coefficients.chunks(2).map(|pair| match *pair {
        [even, odd] => S::constant(odd).fused(x, S::constant(even)),
        [even] => S::constant(even),
        _ => S::zero(),
    });
    pairs
        .rev()
        .reduce(|higher, pair| higher.fused(square, pair))
        .unwrap_or(S::zero())
}
