//! Euler parameters and vectors as plain arrays.
//!
//! Euler parameters are `(e0, e1, e2, e3)`, scalar first; `A(p)` takes components along body axes
//! to components along global axes. Nikravesh, *Computer-Aided Analysis of Mechanical Systems*
//! (1988), chapter 6.

use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, read, square};

/// `A(p) s = (e0^2 - e.e) s + 2 (e.s) e + 2 e0 e x s`.
pub(crate) fn rotate<S: Scalar>(p: &[S; 4], s: &[S; 3]) -> [S; 3] {
    let [e0, e1, e2, e3] = *p;
    let [s1, s2, s3] = *s;
    let along = e1 * s1 + e2 * s2 + e3 * s3;
    let direct = e0 * e0 - (e1 * e1 + e2 * e2 + e3 * e3);
    let [c1, c2, c3] = cross(&[e1, e2, e3], s);
    let component = |s: S, e: S, c: S| {
        let half = along * e + e0 * c;
        direct.fused(s, half + half)
    };
    [
        component(s1, e1, c1),
        component(s2, e2, c2),
        component(s3, e3, c3),
    ]
}

/// `A(p)^T s`.
pub(crate) fn rotate_back<S: Scalar>(p: &[S; 4], s: &[S; 3]) -> [S; 3] {
    rotate(&conjugate(p), s)
}

/// The opposite rotation, `(e0, -e1, -e2, -e3)`.
pub(crate) fn conjugate<S: Scalar>(p: &[S; 4]) -> [S; 4] {
    let [e0, e1, e2, e3] = *p;
    [e0, -e1, -e2, -e3]
}

/// The product `p q` with `A(p q) = A(p) A(q)`.
pub(crate) fn product<S: Scalar>(p: &[S; 4], q: &[S; 4]) -> [S; 4] {
    let [a0, a1, a2, a3] = *p;
    let [b0, b1, b2, b3] = *q;
    [
        a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3,
        a0 * b1 + a1 * b0 + a2 * b3 - a3 * b2,
        a0 * b2 - a1 * b3 + a2 * b0 + a3 * b1,
        a0 * b3 + a1 * b2 - a2 * b1 + a3 * b0,
    ]
}

/// Euler parameters of a rotation, given row by row: from the largest of the four (Shepperd 1978,
/// J. Guidance and Control 1), of length 1.
pub(crate) fn from_matrix<S: Real>(rows: &[[S; 3]; 3]) -> [S; 4] {
    let [[a11, a12, a13], [a21, a22, a23], [a31, a32, a33]] = *rows;
    let one = S::one();
    // Four times the squares.
    let squares = [
        one + a11 + a22 + a33,
        one + a11 - a22 - a33,
        one - a11 + a22 - a33,
        one - a11 - a22 + a33,
    ];
    let [e0, e1, e2, e3] = squares;
    let p = if e0 >= e1 && e0 >= e2 && e0 >= e3 {
        [e0, a32 - a23, a13 - a31, a21 - a12]
    } else if e1 >= e2 && e1 >= e3 {
        [a32 - a23, e1, a21 + a12, a13 + a31]
    } else if e2 >= e3 {
        [a13 - a31, a21 + a12, e2, a32 + a23]
    } else {
        [a21 - a12, a13 + a31, a32 + a23, e3]
    };
    normalised(&p)
}

/// The same of numbers that cannot be compared: all four ways, of which one is taken.
pub(crate) fn from_matrix_by_selection<S: Scalar>(rows: &[[S; 3]; 3]) -> [S; 4] {
    let [[a11, a12, a13], [a21, a22, a23], [a31, a32, a33]] = *rows;
    let one = S::one();
    let [e0, e1, e2, e3] = [
        one + a11 + a22 + a33,
        one + a11 - a22 - a33,
        one - a11 + a22 - a33,
        one - a11 - a22 + a33,
    ];
    let [x, y, z] = [a32 - a23, a13 - a31, a21 - a12];
    let [xy, xz, yz] = [a21 + a12, a13 + a31, a32 + a23];
    let ways = [
        [e0, x, y, z],
        [x, e1, xy, xz],
        [y, xy, e2, yz],
        [z, xz, yz, e3],
    ];
    // The last way that is beaten by none before it, from behind: the first of equal ones.
    let [first, second, third, mut p] = ways;
    let mut most = e3;
    for (square, way) in [(e2, third), (e1, second), (e0, first)] {
        for (element, other) in p.iter_mut().zip(way) {
            *element = square.select(most, *element, other);
        }
        most = square.select(most, most, square);
    }
    normalised(&p)
}

/// `p / |p|`.
pub(crate) fn normalised<S: Scalar>(p: &[S; 4]) -> [S; 4] {
    let [e0, e1, e2, e3] = *p;
    let scale = (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3).sqrt().reciprocal();
    [e0 * scale, e1 * scale, e2 * scale, e3 * scale]
}

/// `p / |p|`, and `p` as it is where its length is zero, which [`check_state`] refuses.
pub(crate) fn normalised_or_zero<S: Scalar>(p: &[S; 4]) -> [S; 4] {
    let [e0, e1, e2, e3] = *p;
    let square = e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3;
    let scale = S::zero().select(square, square.sqrt().reciprocal(), S::one());
    [e0 * scale, e1 * scale, e2 * scale, e3 * scale]
}

/// The Euler parameters of a rotation vector (rad): a turn about its direction by its length.
pub(crate) fn from_rotation_vector<S: Real>(vector: &[S; 3]) -> [S; 4] {
    let [x, y, z] = *vector;
    let angle = (x * x + y * y + z * z).sqrt();
    let half = S::constant(0.5) * angle;
    let (sine, cosine) = (half.sin(), half.cos());
    let factor = if angle > S::zero() {
        sine.quotient(angle)
    } else {
        S::constant(0.5)
    };
    [cosine, x * factor, y * factor, z * factor]
}

/// Where `p.p - 1` is below this, a series gives `1 / |p|`: after a step of any accuracy there is
/// no need of a root.
const NEAR: f64 = 1e-5;

/// `1 / sqrt(1 + x)`, by its series.
#[inline(always)]
fn by_series<S: Scalar>(excess: S) -> S {
    let (half, three_eighths) = (S::constant(-0.5), S::constant(0.375));
    excess.fused(three_eighths, half).fused(excess, S::one())
}

/// `| |p| - 1 |` and the factor `1 / |p|`; none where there is no such number: those stay what they
/// are, for whoever uses them to refuse.
#[inline(always)]
pub(crate) fn to_unit_length<S: Real>(p: &[S; 4]) -> (S, Option<S>) {
    let excess = norm(p) - S::one();
    if excess.abs() < S::constant(NEAR) {
        let drift = S::constant(0.5) * excess.abs();
        return (drift, Some(by_series(excess)));
    }
    let length = length(p);
    let is_some = length.is_finite() && length > S::zero();
    (
        (length - S::one()).abs(),
        is_some.then(|| length.reciprocal()),
    )
}

/// Scales the four Euler parameters at a place as [`to_unit_length`] says, of numbers that cannot
/// be compared; `None` where their length is not known to be near 1.
#[inline(always)]
pub(crate) fn scale_near_unit_length<S: Scalar>(coordinates: &mut [S], place: usize) -> Option<()> {
    let excess = norm(&read(coordinates, place)) - S::one();
    let is_near = S::are_within(&[excess], 0.9 * NEAR);
    is_near.then(|| scale(coordinates, place, by_series(excess)))
}

/// The factor of [`to_unit_length`], of numbers that cannot be compared; one where there is none.
pub(crate) fn unit_factor<S: Scalar>(p: &[S; 4]) -> S {
    let excess = norm(p) - S::one();
    let length = length(p);
    let is_finite = length.select(S::constant(f64::INFINITY), length.reciprocal(), S::one());
    let root = S::zero().select(length, is_finite, S::one());
    excess
        .abs()
        .select(S::constant(NEAR), by_series(excess), root)
}

/// `p.p`, summed as generated kernels do, so that the compiler sees the same sum.
#[inline(always)]
fn norm<S: Scalar>(p: &[S; 4]) -> S {
    let [e0, e1, e2, e3] = p.map(|e| e * e);
    (e0 + e1) + (e2 + e3)
}

/// The angle (rad), from 0 to `pi`, of the rotation between two orientations; the lengths of the
/// Euler parameters do not matter.
pub(crate) fn angle_between<S: Real>(p: &[S; 4], q: &[S; 4]) -> S {
    let [cosine, axis @ ..] = product(&conjugate(p), q);
    let half = square(&axis).sqrt().atan2(cosine.abs());
    half + half
}

/// `|p|`.
#[inline(always)]
pub(crate) fn length<S: Scalar>(p: &[S; 4]) -> S {
    norm(p).sqrt()
}

/// Multiplies the four Euler parameters at a place.
#[inline(always)]
pub(crate) fn scale<S: Scalar>(coordinates: &mut [S], place: usize, factor: S) {
    for e in coordinates.iter_mut().skip(place).take(4) {
        *e = *e * factor;
    }
}
