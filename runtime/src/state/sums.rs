//! Sums over the elements of a part of a state.

use crate::math::scalar::{Real, Scalar};

/// [`Vector::plus`] of a part of a state.
#[inline(always)]
pub(crate) fn plus<S: Scalar, X, const N: usize>(
    from: &[S; N],
    terms: &[(S, &X)],
    part: impl Fn(&X) -> &[S; N],
) -> [S; N] {
    let mut result = *from;
    set_plus(&mut result, from, terms, part);
    result
}

/// The same, written.
#[inline(always)]
pub(crate) fn set_plus<S: Scalar, X, const N: usize>(
    to: &mut [S; N],
    from: &[S; N],
    terms: &[(S, &X)],
    part: impl Fn(&X) -> &[S; N],
) {
    if S::IS_WIDE && N > 1 {
        for place in 0..N {
            add_apart(to, from, place, terms, &part);
        }
        return;
    }
    *to = *from;
    for (factor, direction) in terms {
        for (element, slope) in to.iter_mut().zip(part(direction)) {
            *element = slope.fused(*factor, *element);
        }
    }
}

/// One of several: see [`Scalar::IS_WIDE`].
#[inline(never)]
fn add_apart<S: Scalar, X, const N: usize>(
    to: &mut [S; N],
    from: &[S; N],
    place: usize,
    terms: &[(S, &X)],
    part: &impl Fn(&X) -> &[S; N],
) {
    let (Some(to), Some(&from)) = (to.get_mut(place), from.get(place)) else {
        return;
    };
    let mut sum = from;
    for (factor, direction) in terms {
        if let Some(slope) = part(direction).get(place) {
            sum = slope.fused(*factor, sum);
        }
    }
    *to = sum;
}

/// [`Vector::weighted_norm`] of a part of a state.
#[inline(always)]
pub(crate) fn weighted_norm<S: Real, X, const N: usize>(
    [from, to]: [&[S; N]; 2],
    floor: S,
    terms: &[(S, &X)],
    part: impl Fn(&X) -> &[S; N],
) -> S {
    let mut ratio = plus(&[S::zero(); N], terms, part);
    for ((ratio, x), y) in ratio.iter_mut().zip(from).zip(to) {
        let scale = greater(greater(x.abs(), y.abs()), floor);
        *ratio = ratio.abs().quotient(scale);
    }
    greatest(&ratio)
}

/// Of a part of a state what [`Real::largest_share`] takes.
pub(crate) fn shares<S: Real, const N: usize>(
    [from, to]: [&[S; N]; 2],
    increments: [S; N],
) -> impl Iterator<Item = [S; 3]> + Clone {
    let ends = from.iter().zip(to);
    increments
        .into_iter()
        .zip(ends)
        .map(|(increment, (&x, &y))| [increment, x, y])
}

/// The greater of two numbers; the first if either is NaN.
#[inline(always)]
pub(crate) fn greater<S: Real>(a: S, b: S) -> S {
    if a < b { b } else { a }
}

/// The greatest of non-negative numbers; NaN if one is NaN.
///
/// Four places at once, and NaN looked for apart, so that the comparisons do not wait for each
/// other.
#[inline(always)]
pub(crate) fn greatest<S: Real>(elements: &[S]) -> S {
    let mut lanes = [S::zero(); 4];
    let mut ordered = true;
    for chunk in elements.chunks(4) {
        for (lane, &element) in lanes.iter_mut().zip(chunk) {
            ordered &= element >= S::zero();
            *lane = greater(*lane, element);
        }
    }
    let [a, b, c, d] = lanes;
    if ordered {
        greater(greater(a, b), greater(c, d))
    } else {
        S::constant(f64::NAN)
    }
}

/// The sum of the sizes of all elements, by two sums that do not wait for each other.
#[inline(always)]
pub(crate) fn sum_of_sizes<S: Scalar>(elements: &[S]) -> S {
    let mut lanes = [S::zero(); 2];
    for chunk in elements.chunks(2) {
        for (lane, element) in lanes.iter_mut().zip(chunk) {
            *lane = *lane + element.abs();
        }
    }
    let [a, b] = lanes;
    a + b
}

/// The same of all elements of two states.
#[inline(always)]
pub(crate) fn sum_of_sizes_in_both<S: Scalar>(from: &[S], to: &[S]) -> S {
    sum_of_sizes(from) + sum_of_sizes(to)
}

/// A sum and -0 times all elements: the sum where these are finite, else NaN, as is -0 times any
/// other number, and every sum with NaN. A comparison for each would be more.
///
/// By -0, because what is known to be +0 then changes no sum that begins with -0, and costs
/// nothing.
#[inline(always)]
pub(crate) fn zero_if_finite_after<S: Scalar>(sum: S, elements: &[S]) -> S {
    let add = |sum, element: &S| element.fused(-S::zero(), sum);
    elements.iter().fold(sum, add)
}

/// The same from -0 on, of many four places at once, as in `greatest`; for few, one sum after the
/// other is less than to bring four together.
#[inline(always)]
pub fn zero_if_finite<S: Scalar>(elements: &[S]) -> S {
    if elements.len() <= 4 {
        return zero_if_finite_after(-S::zero(), elements);
    }
    let mut lanes = [-S::zero(); 4];
    for chunk in elements.chunks(4) {
        for (lane, element) in lanes.iter_mut().zip(chunk) {
            *lane = element.fused(-S::zero(), *lane);
        }
    }
    let [a, b, c, d] = lanes;
    (a + b) + (c + d)
}
