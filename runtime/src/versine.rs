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

/// `[sin a, 1 - cos a]` of a small angle (rad), by as many terms of [`SINE`] and [`VERSINE`] as a polynomial takes: [`three`] or [`six`].
#[inline(always)]
pub(crate) fn of_small<S: Scalar>(angle: S, polynomial: impl Fn(S, S, &[f64; 6]) -> S) -> [S; 2] {
    let square = angle * angle;
    let fourth = square * square;
    [
        polynomial(square, fourth, &SINE).fused(square * angle, angle),
        polynomial(square, fourth, &VERSINE).fused(fourth, S::constant(0.5) * square),
    ]
}

/// A polynomial in `x` by the first three coefficients.
#[inline(always)]
pub(crate) fn three<S: Scalar>(x: S, square: S, &[a, b, c, ..]: &[f64; 6]) -> S {
    S::constant(c).fused(square, pair(x, a, b))
}

/// A polynomial in `x` by pairs of terms, which do not wait for each other. Written out: a loop over the coefficients is called where much is compiled together, and takes
/// three times as long.
#[inline(always)]
pub(crate) fn six<S: Scalar>(x: S, square: S, &[a, b, c, d, e, f]: &[f64; 6]) -> S {
    pair(x, e, f)
        .fused(square, pair(x, c, d))
        .fused(square, pair(x, a, b))
}

#[inline(always)]
fn pair<S: Scalar>(x: S, even: f64, odd: f64) -> S {
    S::constant(odd).fused(x, S::constant(even))
}
