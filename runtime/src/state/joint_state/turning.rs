//! Pairs on a circle, turned by angles.

use crate::math::scalar::Scalar;
use crate::math::versine;

/// Pairs, turned by angles (rad).
///
/// With the versine `v` and the sine `s` of an angle, a pair `p` and its normal `n` go to
/// `p + (s n - v p)`, which is rounded once where the increment is small. They are stretched by
/// `1 + e` on the way, `e = (1 - p.p) / 2`, which takes the length to 1 and is known long before
/// the angle is. `e p` alone would do for small angles; at half a turn it would do the opposite.
#[inline(always)]
pub(super) fn turned<S: Scalar, const T: usize>(
    pairs: &[[S; 2]; T],
    angles: &[S; T],
) -> [[S; 2]; T] {
    turned_by(pairs, &S::sines_and_versines(angles))
}

/// Writes a pair, turned by the sum of the increments of its angle. Of numbers that are several,
/// each pair is called for: see [`Scalar::IS_WIDE`].
#[inline(never)]
pub(super) fn turn_apart<S: Scalar, const T: usize, const K: usize>(
    to: &mut [[S; 2]; T],
    from: &[[S; 2]; T],
    place: usize,
    terms: &[(S, &[[S; 2]; T]); K],
) {
    let (Some(to), Some(from)) = (to.get_mut(place), from.get(place)) else {
        return;
    };
    let mut angle = -S::zero();
    for (factor, slopes) in terms {
        if let Some([rate, _]) = slopes.get(place) {
            angle = rate.fused(*factor, angle);
        }
    }
    let [turn] = S::sines_and_versines(&[angle]);
    turn_one(from, &turn, to);
}

/// Writes a pair, turned by an increment of its angle, and by twice that.
#[inline(never)]
pub(super) fn turn_once_and_twice_apart<S: Scalar, const T: usize>(
    to: [&mut [[S; 2]; T]; 2],
    from: &[[S; 2]; T],
    place: usize,
    (factor, slopes): (S, &[[S; 2]; T]),
) {
    let [once, twice] = to.map(|pairs| pairs.get_mut(place));
    let (Some(once), Some(twice), Some(from)) = (once, twice, from.get(place)) else {
        return;
    };
    let Some([rate, _]) = slopes.get(place) else {
        return;
    };
    let [turn] = S::sines_and_versines(&[rate.fused(factor, -S::zero())]);
    turn_one(from, &turn, once);
    turn_one(from, &versine::doubled(turn), twice);
}

/// A pair that is near, turned on by its angle if that is little, or else the one where all began
/// by the whole angle: the same for a pair, whatever stands beside it.
#[cold]
#[inline(never)]
pub(super) fn turned_beside<S: Scalar>(
    (near, angle): ([S; 2], S),
    (from, whole): ([S; 2], S),
) -> [S; 2] {
    if S::are_within(&[angle], LITTLE) {
        return turned_a_little(near, angle);
    }
    let [pair] = turned(&[from], &[whole]);
    if S::HAS_LANES {
        return where_little(angle, turned_a_little(near, angle), pair);
    }
    pair
}

/// The first pair in lanes whose angle is at most [`LITTLE`], in others the second.
#[inline(always)]
fn where_little<S: Scalar>(angle: S, little: [S; 2], pair: [S; 2]) -> [S; 2] {
    let [size, bound] = [angle.abs(), S::constant(LITTLE)];
    let ([c, s], [little_c, little_s]) = (pair, little);
    [
        bound.select(size, c, little_c),
        bound.select(size, s, little_s),
    ]
}

/// Angles (rad) for which six powers leave 9.5e-18 of a turn, and three leave 1.0e-9.
pub(super) const LITTLE: f64 = 0.0125;

/// A pair of length 1, turned by an angle of at most [`LITTLE`].
#[inline(always)]
pub(super) fn turned_a_little<S: Scalar>(pair: [S; 2], angle: S) -> [S; 2] {
    let [[c, s], [way_c, way_s]] = [pair, way(pair, angle)];
    [angle.fused(way_c, c), angle.fused(way_s, s)]
}

/// As [`turn_apart`].
#[inline(never)]
pub(super) fn turn_a_little_apart<S: Scalar>(pair: &mut [S; 2], angle: &S) {
    *pair = turned_a_little(*pair, *angle);
}

/// Where a pair goes in a turn by an angle of at most [`LITTLE`], over that angle.
///
/// `n - a p / 2 - a^2 n / 6 + a^3 p / 24 + a^4 n / 120 - a^5 p / 720` of a pair `p` and its normal
/// `n`: the factors are known before the angle is, and powers do not wait for each other.
#[inline(always)]
fn way<S: Scalar>([c, s]: [S; 2], angle: S) -> [S; 2] {
    let square = angle * angle;
    let element = |p: S, n: S| {
        let term = |even: f64, odd: f64| angle.fused(p * S::constant(even), n * S::constant(odd));
        let one = angle.fused(p * S::constant(-0.5), n);
        let three = if S::SEVEN_DIGITS {
            n * S::constant(-1.0 / 6.0)
        } else {
            let five = term(-1.0 / 720.0, 1.0 / 120.0);
            square.fused(five, term(1.0 / 24.0, -1.0 / 6.0))
        };
        square.fused(three, one)
    };
    [element(c, -s), element(s, c)]
}

/// What takes the length of a pair to 1.
#[inline(always)]
fn stretch<S: Scalar>([c, s]: [S; 2]) -> [S; 2] {
    let stretch = S::constant(-0.5) * c.fused(c, s.fused(s, -S::one()));
    [stretch * c, stretch * s]
}

/// Pairs, turned by angles of these sines and versines.
#[inline(always)]
fn turned_by<S: Scalar, const T: usize>(pairs: &[[S; 2]; T], turns: &[[S; 2]; T]) -> [[S; 2]; T] {
    let mut result = *pairs;
    let (first, last) = result.split_at_mut(versine::cut(T));
    let (by, last_by) = turns.split_at(versine::cut(T));
    turn(first, by);
    turn(last, last_by);
    result
}

#[inline(always)]
fn turn<S: Scalar>(pairs: &mut [[S; 2]], turns: &[[S; 2]]) {
    for (pair, turn) in pairs.iter_mut().zip(turns) {
        let from = *pair;
        turn_one(&from, turn, pair);
    }
}

#[inline(always)]
fn turn_one<S: Scalar>(from: &[S; 2], &[sine, versine]: &[S; 2], to: &mut [S; 2]) {
    let [[c, s], [more_c, more_s]] = [*from, stretch(*from)];
    let (full_c, full_s) = (c + more_c, s + more_s);
    *to = [
        c + versine.fused(-full_c, sine.fused(-full_s, more_c)),
        s + versine.fused(-full_s, sine.fused(full_c, more_s)),
    ];
}

/// Pairs, turned by angles and by twice these angles.
#[inline(always)]
pub(super) fn turned_once_and_twice<S: Scalar, const T: usize>(
    pairs: &[[S; 2]; T],
    angles: &[S; T],
) -> [[[S; 2]; T]; 2] {
    // Of a pair that stands alone the next evaluation does nothing but wait.
    if T == 1 && S::are_within(angles, LITTLE) {
        return turned_little_and_twice(pairs, angles);
    }
    let mut turns = S::sines_and_versines(angles);
    let mut once = turned_by(pairs, &turns);
    // A loop, because `map` is called where much is compiled together.
    for turn in &mut turns {
        *turn = versine::doubled(*turn);
    }
    let mut twice = turned_by(pairs, &turns);
    if T == 1 && S::HAS_LANES {
        let [little_once, little_twice] = turned_little_and_twice(pairs, angles);
        for ((pair, little), &angle) in once.iter_mut().zip(little_once).zip(angles) {
            *pair = where_little(angle, little, *pair);
        }
        for ((pair, little), &angle) in twice.iter_mut().zip(little_twice).zip(angles) {
            *pair = where_little(angle, little, *pair);
        }
    }
    [once, twice]
}

/// Pairs, turned by angles of at most [`LITTLE`] and by twice these. What is missing of a length is
/// not turned with the pair: that would be known later.
#[inline(always)]
fn turned_little_and_twice<S: Scalar, const T: usize>(
    pairs: &[[S; 2]; T],
    angles: &[S; T],
) -> [[[S; 2]; T]; 2] {
    let (mut once, mut twice) = (*pairs, *pairs);
    for ((once, twice), &angle) in once.iter_mut().zip(&mut twice).zip(angles) {
        let pair = *once;
        let [[way_c, way_s], [more_c, more_s]] = [way(pair, angle), stretch(pair)];
        let [c, s] = pair;
        *once = [
            c + angle.fused(way_c, more_c),
            s + angle.fused(way_s, more_s),
        ];
        [*twice] = turned_by(&[pair], &[versine::doubled(versine::of_little(angle))]);
    }
    [once, twice]
}
