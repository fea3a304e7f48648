//! Rotations as three angles, from Euler parameters.
//!
//! Angles are halves of sums and differences of two `atan2` (Bernardes and Viollet, *Quaternion to
//! Euler angles conversion: a direct, general and computationally efficient method*, PLoS ONE 17
//! (2022), e0276302): no digits are lost near a singular configuration but those that the first and
//! the third angle have not. The length of the Euler parameters does not matter.

use core::f64::consts::{PI, TAU};

use crate::math::quaternion::{conjugate, product};
use crate::math::scalar::Real;

/// Three angles (rad), and the sine of the angle between the first and the third axis: both angles
/// about these are known to the digits of the numbers over it.
pub(crate) type Angles<S> = ([S; 3], S);

/// Euler angles: `A(p) = Z(first) X(second) Z(third)`. The second is from 0 to `pi`, the others
/// from `-pi` to `pi`.
pub(crate) fn zxz<S: Real>(p: &[S; 4]) -> Angles<S> {
    let [e0, e1, e2, e3] = *p;
    let (sum, difference) = (e3.atan2(e0), e2.atan2(e1));
    let (cosine, sine) = (length(e0, e3), length(e1, e2));
    let half = sine.atan2(cosine);
    let angles = [
        within(sum + difference),
        half + half,
        within(sum - difference),
    ];
    (angles, between(cosine, sine))
}

/// Bryant angles: `A(p) = X(first) Y(second) Z(third)`. The second is from `-pi / 2` to `pi / 2`,
/// the others from `-pi` to `pi`.
///
/// `Z(c) = Y(pi / 2) X(-c) Y(-pi / 2)`: after a quarter turn about y these are the angles of
/// `X(a) Y(b + pi / 2) X(-c)`, whose first and third axis are the same.
pub(crate) fn xyz<S: Real>(p: &[S; 4]) -> Angles<S> {
    let [e0, e1, e2, e3] = *p;
    let [q0, q1, q2, q3] = [e0 - e2, e1 - e3, e2 + e0, e3 + e1];
    let (sum, difference) = (q1.atan2(q0), q3.atan2(q2));
    let (cosine, sine) = (length(q0, q1), length(q2, q3));
    // Not the angle of the pair less a quarter turn, in which small angles lose their digits.
    let double = S::constant(2.0);
    let second = (double * (e0 * e2 + e1 * e3)).atan2(cosine * sine);
    let angles = [within(sum + difference), second, within(difference - sum)];
    (angles, between(cosine, sine))
}

/// Roll, pitch and yaw: `A(p) = Z(third) Y(second) X(first)`. They are the negatives of the Bryant
/// angles of the opposite rotation.
pub(crate) fn rpy<S: Real>(p: &[S; 4]) -> Angles<S> {
    let (angles, sine) = xyz(&conjugate(p));
    (angles.map(|angle| -angle), sine)
}

/// Euler parameters of turns about axes (0 is x), of which the first turns last.
pub(crate) fn of_turns<S: Real>(turns: [(usize, S); 3]) -> [S; 4] {
    let one = |(axis, angle): (usize, S)| {
        let half = S::constant(0.5) * angle;
        let sine = |k| if k == axis { half.sin() } else { S::zero() };
        [half.cos(), sine(0), sine(1), sine(2)]
    };
    let [first, second, third] = turns.map(one);
    product(&product(&first, &second), &third)
}

/// The sine of twice the angle whose cosine and sine are in this ratio.
fn between<S: Real>(cosine: S, sine: S) -> S {
    (cosine + cosine).quotient(cosine * cosine + sine * sine) * sine
}

fn length<S: Real>(x: S, y: S) -> S {
    (x * x + y * y).sqrt()
}

/// An angle of at most two turns, from `-pi` to `pi`.
fn within<S: Real>(angle: S) -> S {
    if angle > S::constant(PI) {
        angle - S::constant(TAU)
    } else if angle < S::constant(-PI) {
        angle + S::constant(TAU)
    } else {
        angle
    }
}
