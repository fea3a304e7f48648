//! A step of the classical Runge-Kutta method that shares turns. Measured, see
//! `docs/decisions/006-turns-in-a-step.md`.

use super::{JointState, increments, more_increments, stretch, turned, turned_by};
use crate::math::scalar::Scalar;
use crate::math::versine;
use crate::state::vector::Vector;

/// A pair that is near, turned on by its angle if that is little, or else the one where all began
/// by the whole angle: the same for a pair, whatever stands beside it.
#[cold]
#[inline(never)]
fn turned_beside<S: Scalar>((near, angle): ([S; 2], S), (from, whole): ([S; 2], S)) -> [S; 2] {
    if S::are_within(&[angle], LITTLE) {
        return turned_a_little(near, angle);
    }
    let [pair] = turned(&[from], &[whole]);
    pair
}

/// Angles (rad) for which six powers leave 9.5e-18 of a turn, and three leave 1.0e-9.
const LITTLE: f64 = 0.0125;

/// A pair of length 1, turned by an angle of at most [`LITTLE`].
#[inline(always)]
fn turned_a_little<S: Scalar>(pair: [S; 2], angle: S) -> [S; 2] {
    let [[c, s], [way_c, way_s]] = [pair, way(pair, angle)];
    [angle.fused(way_c, c), angle.fused(way_s, s)]
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

/// Pairs, turned by angles and by twice these angles.
#[inline(always)]
fn turned_once_and_twice<S: Scalar, const T: usize>(
    pairs: &[[S; 2]; T],
    angles: &[S; T],
) -> [[[S; 2]; T]; 2] {
    let (mut once, mut twice) = (*pairs, *pairs);
    // Of a pair that stands alone the next evaluation does nothing but wait. What is missing of its
    // length is not turned with it: that would be known later.
    if T == 1 && S::are_within(angles, LITTLE) {
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
        return [once, twice];
    }
    let mut turns = S::sines_and_versines(angles);
    once = turned_by(pairs, &turns);
    // A loop, because `map` is called where much is compiled together.
    for turn in &mut turns {
        *turn = versine::doubled(*turn);
    }
    twice = turned_by(pairs, &turns);
    [once, twice]
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize>
    JointState<S, TURNS, REST, RATES>
{
    /// [`Vector::classical_step`], with sums that go on from each other.
    #[inline(always)]
    pub(super) fn step_by_turns<E>(
        &self,
        first: &Self,
        step: S,
        mut slope_after: impl FnMut(S, &Self, &mut Self) -> Result<(), E>,
    ) -> Result<Self, E> {
        let half = S::constant(0.5) * step;
        let sixth = S::constant(1.0 / 6.0) * step;
        let third = sixth + sixth;
        let (mut second, mut penultimate, mut last) = (*self, *self, *self);
        let [midway, end] = self.plus_once_and_twice(half, first);
        slope_after(half, &midway, &mut second)?;
        let at = self.plus_beside(&midway, (half, first), [(half, &second)]);
        slope_after(half, &at, &mut penultimate)?;
        let at = self.plus_beside(&end, (step, first), [(step, &penultimate)]);
        slope_after(step, &at, &mut last)?;
        let terms = [
            (sixth, first),
            (third, &second),
            (third, &penultimate),
            (sixth, &last),
        ];
        Ok(self.plus_beside(&end, (step, first), terms))
    }

    /// The sum with one direction, by a factor and by twice that factor: what these have in common
    /// is computed once.
    #[inline(always)]
    pub(super) fn plus_once_and_twice(&self, factor: S, direction: &Self) -> [Self; 2] {
        let angles = increments(&[(factor, direction)]);
        let [once, twice] = turned_once_and_twice(&self.pairs, &angles);
        [
            self.plus_with(once, [(factor, direction)]),
            self.plus_with(twice, [(factor + factor, direction)]),
        ]
    }

    /// The sum with directions that hardly differ from one for which it is known: `near` is
    /// `self.plus([along])`. Pairs go on from those that are known by little angles: that is less
    /// to compute, and what waits for the last slope is short.
    #[inline(always)]
    pub(super) fn plus_beside<const K: usize>(
        &self,
        near: &Self,
        along: (S, &Self),
        terms: [(S, &Self); K],
    ) -> Self {
        // Of many the operations count: the turns of a stage do not wait for each other. Measured,
        // see docs/decisions/006-turns-in-a-step.md.
        let few = if S::SEVEN_DIGITS { 12 } else { 5 };
        if TURNS > few {
            return self.plus(terms);
        }
        let (factor, slope) = along;
        let angles = more_increments(increments(&[(-factor, slope)]), &terms);
        let mut pairs = near.pairs;
        if S::are_within(&angles, LITTLE) {
            for (pair, &angle) in pairs.iter_mut().zip(&angles) {
                *pair = turned_a_little(*pair, angle);
            }
        } else {
            let whole = increments(&terms);
            let (from, angles) = (self.pairs.iter().zip(&whole), &angles);
            for ((pair, (&from, &whole)), &angle) in pairs.iter_mut().zip(from).zip(angles) {
                *pair = turned_beside((*pair, angle), (from, whole));
            }
        }
        self.plus_with(pairs, terms)
    }
}
