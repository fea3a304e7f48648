//! Sine and versine, of which a turn by an angle is made.
//!
//! `1 - cos` by itself keeps the digits of small angles: a turn adds a small increment, which is
//! rounded once.

use crate::math::scalar::Scalar;

/// Angles (rad) for which the polynomials of each type of numbers leave nothing beyond round-off: a
/// step seldom turns a joint by more.
pub(crate) const SMALL: f64 = 0.9;

/// Of the sine, `(sin a - a) / a^3`, and of the versine, `(1 - cos a - a^2 / 2) / a^4`, as
/// polynomials in `a^2` that make the greatest relative error of sine and versine up to [`SMALL`]
/// as small as it can be (Remez). Six coefficients leave 3.2e-17 and 3.2e-18 of them; Taylor's
/// leave 2.0e-13 and 2.4e-14.
pub(crate) const SIX: [[f64; 6]; 2] = [
    [
        -0.166_666_666_666_664_8,
        0.008_333_333_333_289_275,
        -1.984_126_980_640_911_3e-4,
        2.755_730_651_377_877_4e-6,
        -2.504_976_100_450_707_4e-8,
        1.584_532_200_366_792_7e-10,
    ],
    [
        -0.041_666_666_666_666_55,
        0.001_388_888_888_886_182_5,
        -2.480_158_728_006_007_7e-5,
        2.755_731_134_210_741e-7,
        -2.087_529_638_970_36e-9,
        1.133_740_488_409_046_8e-11,
    ],
];

/// Three coefficients, which leave 1.5e-8 and 4.6e-9 as numbers of `f32`: a quarter of what
/// rounding does.
pub(crate) const THREE: [[f64; 3]; 2] = [
    [
        -0.166_666_392_269_373_45,
        0.008_331_308_585_638_76,
        -1.941_341_452_182_315e-4,
    ],
    [
        -0.041_666_639_666_085_82,
        0.001_388_687_964_266_193,
        -2.437_477_642_821_243e-5,
    ],
];

/// Where loops over so many pairs are cut in two: of what is left over when many have been done
/// side by side, compilers make gathers and scatters, or one after the other, which takes up to
/// four times as long. Eight and up to seven where lanes are wide, else one alone. Measured: see
/// `docs/decisions/006-turns-in-a-step.md`.
pub(crate) const fn cut(pairs: usize) -> usize {
    match pairs {
        9..16 if cfg!(target_feature = "avx") => 8,
        9.. if cfg!(all(target_feature = "sse2", not(target_feature = "avx"))) => pairs - pairs % 2,
        _ => pairs,
    }
}

/// `[sin a, 1 - cos a]` of any angle (rad), by the functions of half the angle: both keep their
/// digits.
#[inline]
pub(crate) fn of<S: Scalar>(angle: S) -> [S; 2] {
    let half = S::constant(0.5) * angle;
    let sine = half.sin();
    let twice = sine + sine;
    [twice * half.cos(), twice * sine]
}

/// A quarter of a turn (rad) in three parts. Of the first two the products with up to 2^13 quarters
/// have no more digits than `f64` has, so that taking them away leaves nothing out.
pub(crate) const QUARTER_BY_FORTY: [f64; 3] = [
    1.570_796_326_794_152_3,
    7.443_547_480_480_255e-13,
    6.368_317_163_510_95e-25,
];

/// The same for `f32` and up to 2^7 quarters.
pub(crate) const QUARTER_BY_SEVENTEEN: [f32; 3] = [1.570_785_5, 1.080_427_3e-5, 6.077_1e-11];

/// `[sin a, 1 - cos a]` of an angle that is so many quarters of a turn ahead of one with these, of
/// which the two lowest bits decide. Neither is a small difference.
#[inline(always)]
pub(crate) fn ahead<S: Scalar>([sine, versine]: [S; 2], quarters: u8) -> [S; 2] {
    let sign = |number: S| if quarters & 2 == 0 { number } else { -number };
    if quarters & 1 == 0 {
        let opposite = S::constant(2.0) - versine;
        [
            sign(sine),
            if quarters & 2 == 0 { versine } else { opposite },
        ]
    } else {
        [sign(S::one() - versine), S::one() + sign(sine)]
    }
}

/// `[sin a, 1 - cos a]` of a small angle (rad), by the coefficients of both and what makes a
/// polynomial of them: [`SIX`] and [`six`], or [`THREE`] and [`three`].
#[inline(always)]
pub(crate) fn of_small<S: Scalar, const N: usize>(
    angle: S,
    [of_sine, of_versine]: &[[f64; N]; 2],
    polynomial: impl Fn(S, S, &[f64; N]) -> S,
) -> [S; 2] {
    let square = angle * angle;
    let fourth = square * square;
    [
        polynomial(square, fourth, of_sine).fused(square * angle, angle),
        polynomial(square, fourth, of_versine).fused(fourth, S::constant(0.5) * square),
    ]
}

/// `[sin a, 1 - cos a]` of an angle of 0.0125 rad at most, with the digits that a turn by it needs:
/// Taylor's series, which leave 9.5e-18 of a turn, and 1.0e-9 in `f32`.
#[inline(always)]
pub(crate) fn of_little<S: Scalar>(angle: S) -> [S; 2] {
    let square = angle * angle;
    let term = |even: f64, odd: f64| S::constant(odd).fused(square, S::constant(even));
    let (of_sine, of_versine) = if S::SEVEN_DIGITS {
        (S::constant(-1.0 / 6.0), S::constant(0.5))
    } else {
        let four = term(-1.0 / 24.0, 1.0 / 720.0);
        let of_versine = four.fused(square, S::constant(0.5));
        (term(-1.0 / 6.0, 1.0 / 120.0), of_versine)
    };
    [of_sine.fused(square * angle, angle), of_versine * square]
}

/// `[sin 2a, 1 - cos 2a]` from `[sin a, 1 - cos a]`.
#[inline(always)]
pub(crate) fn doubled<S: Scalar>([sine, versine]: [S; 2]) -> [S; 2] {
    let twice = sine + sine;
    [twice.fused(-versine, twice), twice * sine]
}

/// A polynomial in `x`.
#[inline(always)]
pub(crate) fn three<S: Scalar>(x: S, square: S, &[a, b, c]: &[f64; 3]) -> S {
    S::constant(c).fused(square, pair(x, a, b))
}

/// A polynomial in `x` by pairs of terms, which do not wait for each other. Written out: a loop
/// over the coefficients is called where much is compiled together, and takes three times as long.
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
