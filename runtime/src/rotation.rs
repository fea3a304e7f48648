//! Euler parameters and vectors as plain arrays.
//!
//! Euler parameters are `(e0, e1, e2, e3)`, scalar first; `A(p)` takes components along body axes to components along global
//! axes. Nikravesh, *Computer-Aided Analysis of Mechanical Systems* (1988), chapter 6.

use crate::array::{Array, StateParts, Vector};
use crate::error::Fault;
use crate::mechanism::Mechanism;
use crate::report::BodyKind;
use crate::scalar::{Real, Scalar};
use crate::view::square;

/// `N` elements from a place on; zeros where the slice ends before.
pub(crate) fn read<S: Scalar, const N: usize>(slice: &[S], place: usize) -> [S; N] {
    slice
        .get(place..)
        .and_then(|rest| rest.first_chunk())
        .copied()
        .unwrap_or([S::zero(); N])
}

/// Writes `N` elements from a place on, as far as the slice goes.
pub(crate) fn write<S: Scalar, const N: usize>(slice: &mut [S], place: usize, values: [S; N]) {
    for (element, value) in slice.iter_mut().skip(place).zip(values) {
        *element = value;
    }
}

/// `a x b`.
pub(crate) fn cross<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1]
}

/// `a - b`.
pub(crate) fn minus<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let [a1, a2, a3] = *a;
    let [b1, b2, b3] = *b;
    [a1 - b1, a2 - b2, a3 - b3]
}

/// `factor v`. A plain loop: `map` of an array is a page of code in a build that is not optimised.
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

/// Euler parameters of a rotation, given row by row: from the largest of the four (Shepperd 1978, J. Guidance and Control 1), of length 1.
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

/// Refuses a state that holds a number that is not finite, or Euler parameters that are zero.
pub(crate) fn check_state<S: Real, M: Mechanism>(state: &M::State<S>) -> Result<(), Fault> {
    if !state.is_finite() {
        return Err(Fault::StateNotFinite);
    }
    let coordinates = state.coordinates().as_slice();
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let p: [S; 4] = read(coordinates, body.coordinate + 3);
            if square(&p) == S::zero() {
                return Err(Fault::ZeroOrientation { body: body.name });
            }
        }
    }
    Ok(())
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

/// The state with the Euler parameters of every body scaled to length 1.
pub(crate) fn with_unit_orientations<S: Scalar, M: Mechanism>(state: &M::State<S>) -> M::State<S> {
    let mut unit = *state;
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let slice = unit.coordinates_mut().as_mut_slice();
            let p = normalised(&read(slice, place));
            write(slice, place, p);
        }
    }
    unit
}

/// `| |p| - 1 |` and the factor `1 / |p|`; none where there is no such number: those stay what they are, for whoever uses them to refuse.
#[inline(always)]
pub(crate) fn to_unit_length<S: Real>(p: &[S; 4]) -> (S, Option<S>) {
    let excess = norm(p) - S::one();
    // `1 / sqrt(1 + x)` by its series: after a step of any accuracy there is no need of a root.
    if excess.abs() < S::constant(1e-5) {
        let (half, three_eighths) = (S::constant(-0.5), S::constant(0.375));
        let factor = excess.fused(three_eighths, half).fused(excess, S::one());
        return (half.abs() * excess.abs(), Some(factor));
    }
    let length = length(p);
    let is_some = length.is_finite() && length > S::zero();
    (
        (length - S::one()).abs(),
        is_some.then(|| length.reciprocal()),
    )
}

/// Scales the Euler parameters of every body to length 1, and their rates, which are linear in them, by the same factors. Returns the largest
/// `| |p| - 1 |` that they had.
#[inline]
pub(crate) fn bring_to_unit_length<S: Real, M: Mechanism>(
    state: &mut M::State<S>,
    mut rates: Option<&mut M::State<S>>,
) -> S {
    let mut stretch = S::zero();
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let p: [S; 4] = read(state.coordinates().as_slice(), place);
            let (off, factor) = to_unit_length(&p);
            stretch = stretch.max(off);
            let Some(factor) = factor else { continue };
            scale(state.coordinates_mut().as_mut_slice(), place, factor);
            if let Some(rates) = rates.as_deref_mut() {
                scale(rates.coordinates_mut().as_mut_slice(), place, factor);
            }
        }
    }
    stretch
}

/// The largest `| |p| - 1 |` of the Euler parameters of a state.
pub(crate) fn stretch<S: Real, M: Mechanism>(state: &M::State<S>) -> S {
    let rigid = M::REPORT.bodies.iter();
    let rigid = rigid.filter(|body| body.kind == BodyKind::Rigid);
    let lengths = rigid.map(|body| {
        let p: [S; 4] = read(state.coordinates().as_slice(), body.coordinate + 3);
        length(&p)
    });
    lengths.fold(S::zero(), |most, length| {
        most.max((length - S::one()).abs())
    })
}

/// Multiplies the rates `1/2 L(p)^T w` of Euler parameters by a function of their length in a state: they are linear in `p`.
#[inline]
pub(crate) fn scale_euler_rates<S: Scalar, M: Mechanism>(
    rates: &mut <M::State<S> as StateParts<S>>::Coordinates,
    state: &M::State<S>,
    factor: impl Fn(S) -> S,
) {
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let p: [S; 4] = read(state.coordinates().as_slice(), place);
            scale(rates.as_mut_slice(), place, factor(length(&p)));
        }
    }
}

/// `p.p`, summed as generated kernels do, so that the compiler sees the same sum.
#[inline(always)]
fn norm<S: Scalar>(p: &[S; 4]) -> S {
    let [e0, e1, e2, e3] = p.map(|e| e * e);
    (e0 + e1) + (e2 + e3)
}

/// `|p|`.
#[inline(always)]
fn length<S: Scalar>(p: &[S; 4]) -> S {
    norm(p).sqrt()
}

/// Multiplies the four Euler parameters at a place.
#[inline(always)]
pub(crate) fn scale<S: Scalar>(coordinates: &mut [S], place: usize, factor: S) {
    for e in coordinates.iter_mut().skip(place).take(4) {
        *e = *e * factor;
    }
}
