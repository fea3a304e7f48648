//! Vectors as plain arrays, and their places in slices.

use crate::math::scalar::{Real, Scalar};

/// `N` elements from a place on; zeros where the slice ends before.
pub(crate) fn read<S: Scalar, const N: usize>(slice: &[S], place: usize) -> [S; N] {
    slice
        .get(place..)
        .and_then(|rest| rest.first_chunk())
        .copied()
        .unwrap_or([S::zero(); N])
}

/// Writes `N` elements from a place on; none where the slice ends before. At once, as a loop over
/// elements from a place that is not known costs a comparison for each.
#[inline]
pub(crate) fn write<S: Scalar, const N: usize>(slice: &mut [S], place: usize, values: [S; N]) {
    let rest = slice.get_mut(place..);
    if let Some(elements) = rest.and_then(|rest| rest.first_chunk_mut()) {
        *elements = values;
    }
}

/// `a x b`.
pub(crate) fn cross<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1]
}

/// `a + b`.
pub(crate) fn plus<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a1 + b1, a2 + b2, a3 + b3]
}

/// `a - b`.
pub(crate) fn minus<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a1 - b1, a2 - b2, a3 - b3]
}

/// `factor v`. A loop, as `map` of an array becomes much code where nothing is optimised.
pub(crate) fn times<S: Scalar, const N: usize>(v: &[S; N], factor: S) -> [S; N] {
    let mut result = *v;
    let mut k = 0;
    while k < N {
        result[k] = v[k] * factor;
        k += 1;
    }
    result
}

/// `v / divisor`.
pub(crate) fn over<S: Real, const N: usize>(v: &[S; N], divisor: S) -> [S; N] {
    let mut result = *v;
    let mut k = 0;
    while k < N {
        result[k] = v[k].quotient(divisor);
        k += 1;
    }
    result
}

/// `a . b`.
pub(crate) fn dot<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> S {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    a1 * b1 + a2 * b2 + a3 * b3
}

/// The sum of squares.
pub(crate) fn square<S: Scalar>(elements: &[S]) -> S {
    elements.iter().fold(S::zero(), |sum, &x| x.fused(x, sum))
}

/// The Euclidean norm, without a square out of the range of numbers.
pub(crate) fn norm<S: Real>(vector: &[S]) -> S {
    let sum = square(vector);
    if sum * S::EPSILON > S::smallest() && sum.is_finite() {
        return sum.sqrt();
    }
    let most = vector.iter().fold(S::zero(), |most, x| most.max(x.abs()));
    if most > S::zero() {
        let sum = vector.iter().fold(S::zero(), |sum, x| {
            let part = x.quotient(most);
            part.fused(part, sum)
        });
        sum.sqrt() * most
    } else {
        most
    }
}
