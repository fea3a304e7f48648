//! The state of a mechanism in joint coordinates, whose angles are pairs on a circle.

#[cfg(test)]
mod tests;
mod turning;

use self::turning::{
    LITTLE, turn_a_little_apart, turn_apart, turn_once_and_twice_apart, turned, turned_a_little,
    turned_beside, turned_once_and_twice,
};
use crate::math::scalar::{Real, Scalar};
use crate::state::each::EachOfJoints;
use crate::state::sums::{
    greater, greatest, plus, set_plus, shares, weighted_norm, zero_if_finite, zero_if_finite_after,
};
use crate::state::vector::{Vector, are_of_one_turn};

/// The state of a mechanism in joint coordinates: a pair (cosine, sine) for the angle of every
/// turning joint, further coordinates, rates.
///
/// A kernel reads cosines and sines as they are and calls no function. Pairs have length 1; `rest`
/// (displacements, say) and `rates`, of which there may be as many as the system needs, are plain
/// numbers. The same type holds the slope of a state: there a pair is
/// `[rate of the angle (rad/s), 0]`, and the second element has no part in anything.
///
/// # How an integrator moves it
///
/// - [`Vector::plus`] *turns* a pair by the sum of its increments: what a method does with the
///   angle it does with the pair, up to round-off, at the stages too, because turns about one axis
///   commute. Pairs whose elements are integrated as numbers lose an order of magnitude in
///   accuracy. The sine and cosine of an increment are exact to round-off for every size; below 0.9
///   rad a turn calls no function in `f64` and `f32` ([`Scalar::sines_and_versines`]). Every turn
///   takes back what round-off did to the length before: it does not drift. A pair that was given
///   with an error `e` in its length has `1.5 e^2` after a turn; what is off by a tenth or more is
///   no angle.
/// - [`Vector::set_plus_beside`], of which [`Rk4`](crate::Rk4) makes the later stages of a step and
///   its end, turns a few pairs on from ones that are known by what the slopes differ by, where
///   that is 0.0125 rad at most: a short series, so that the next evaluation waits less.
///   [`Vector::set_plus_once_and_twice`], which leads to the first stage, does so with a pair that
///   stands alone. The sums are the same, up to round-off; of an error of the length the latter
///   leaves half a square of the angle times as much beside the above.
/// - [`Vector::weighted_norm`] measures the increment of an angle in radians, against
///   `max(1, floor)`. Angles on a circle have no size, so a relative tolerance is one in radians,
///   and an absolute one counts if it is greater.
/// - [`Vector::towards`] goes along the circle, by the turn nearest to the given way.
/// - [`Vector::zip`] and [`Vector::for_each`] see plain numbers: both elements of every pair,
///   `rest`, `rates`.
///
/// ```
/// use holonom::{Fault, Rk4, integrate::{OneStep, System}, state::JointState};
///
/// /// A pendulum of 1 m: angle from the vertical, `angle'' = -9.81 sin(angle)`.
/// struct Pendulum;
///
/// impl System<f64> for Pendulum {
///     type State = JointState<f64, 1, 0, 1>;
///     fn rates(&mut self, _time: f64, state: &Self::State) -> Result<Self::State, Fault> {
///         let ([[_, sine]], [rate]) = (*state.pairs(), *state.rates());
///         Ok(JointState::from_parts([[rate, 0.0]], [], [-9.81 * sine]))
///     }
/// }
///
/// let start = 1.0_f64;
/// let mut state = JointState::from_parts([[start.cos(), start.sin()]], [], [0.0]);
/// for step in 0..1000 {
///     Rk4.step(&mut Pendulum, 0.01 * f64::from(step), &mut state, 0.01)?;
/// }
/// let ([[cosine, _]], [rate]) = (*state.pairs(), *state.rates());
/// assert!((0.5 * rate * rate - 9.81 * (cosine - start.cos())).abs() < 1e-6);
/// # Ok::<(), Fault>(())
/// ```
///
/// Beside these, the state of a mechanism counts the turns of joints that have an angle: `A`
/// numbers, see [`Vector::turns`].
#[derive(Copy, Debug)]
pub struct JointState<
    S,
    const TURNS: usize,
    const REST: usize,
    const RATES: usize,
    const A: usize = 0,
> {
    pub(crate) pairs: [[S; 2]; TURNS],
    pub(crate) rest: [S; REST],
    pub(crate) rates: [S; RATES],
    pub(crate) turns: [S; A],
}

/// At once, not part by part.
impl<S: Copy, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize> Clone
    for JointState<S, TURNS, REST, RATES, A>
{
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

/// Equal numbers, and no joint that is a turn further on.
impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize> PartialEq
    for JointState<S, TURNS, REST, RATES, A>
{
    fn eq(&self, other: &Self) -> bool {
        self.pairs == other.pairs
            && self.rest == other.rest
            && self.rates == other.rates
            && are_of_one_turn(&self.turns, &other.turns)
    }
}

impl<S, const TURNS: usize, const REST: usize, const RATES: usize>
    JointState<S, TURNS, REST, RATES>
{
    /// A state of its parts that counts no angle. Pairs are taken as they are: their length should
    /// be 1.
    #[inline(always)]
    #[must_use]
    pub const fn from_parts(pairs: [[S; 2]; TURNS], rest: [S; REST], rates: [S; RATES]) -> Self {
        let turns = [];
        Self {
            pairs,
            rest,
            rates,
            turns,
        }
    }
}

impl<S, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize>
    JointState<S, TURNS, REST, RATES, A>
{
    /// The same for any account of angles, which begins at zero.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    pub fn of_parts(pairs: [[S; 2]; TURNS], rest: [S; REST], rates: [S; RATES]) -> Self
    where
        S: Scalar,
    {
        let turns = [S::zero(); A];
        Self {
            pairs,
            rest,
            rates,
            turns,
        }
    }

    /// Cosine and sine of the angle of every turning joint; of a slope, the rate of the angle
    /// (rad/s) and zero.
    #[inline(always)]
    #[must_use]
    pub const fn pairs(&self) -> &[[S; 2]; TURNS] {
        &self.pairs
    }

    /// The pairs, to be written.
    #[inline(always)]
    #[must_use]
    pub const fn pairs_mut(&mut self) -> &mut [[S; 2]; TURNS] {
        &mut self.pairs
    }

    /// The coordinates that are no angles on a circle.
    #[inline(always)]
    #[must_use]
    pub const fn rest(&self) -> &[S; REST] {
        &self.rest
    }

    /// These coordinates, to be written.
    #[inline(always)]
    #[must_use]
    pub const fn rest_mut(&mut self) -> &mut [S; REST] {
        &mut self.rest
    }

    /// The rates; of a slope, the rates of these.
    #[inline(always)]
    #[must_use]
    pub const fn rates(&self) -> &[S; RATES] {
        &self.rates
    }

    /// The rates, to be written.
    #[inline(always)]
    #[must_use]
    pub const fn rates_mut(&mut self) -> &mut [S; RATES] {
        &mut self.rates
    }
}

/// The increments of the angles (rad): the sums of factor times slope.
#[inline(always)]
fn increments<
    S: Scalar,
    const P: usize,
    const Q: usize,
    const U: usize,
    const A: usize,
    const K: usize,
>(
    terms: &[(S, &JointState<S, P, Q, U, A>); K],
) -> [S; P] {
    // Adding to -0 changes no number, and so costs nothing.
    more_increments([-S::zero(); P], terms)
}

#[inline(always)]
fn more_increments<
    S: Scalar,
    const P: usize,
    const Q: usize,
    const U: usize,
    const A: usize,
    const K: usize,
>(
    mut sums: [S; P],
    terms: &[(S, &JointState<S, P, Q, U, A>); K],
) -> [S; P] {
    for (factor, slope) in terms {
        for (sum, [rate, _]) in sums.iter_mut().zip(&slope.pairs) {
            *sum = rate.fused(*factor, *sum);
        }
    }
    sums
}

/// One, with the derivatives of the angle of a pair.
fn a_radian<S: Real>([c, s]: [S; 2]) -> S {
    S::one() + (s * c.plain() - c * s.plain())
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize>
    JointState<S, TURNS, REST, RATES, A>
{
    /// Whether each of several pairs is called for: see [`Scalar::IS_WIDE`].
    const IS_APART: bool = S::IS_WIDE && TURNS > 1;

    /// Writes what is no pair of a sum.
    #[inline(always)]
    fn set_others<const K: usize>(&mut self, from: &Self, terms: [(S, &Self); K]) {
        set_plus(&mut self.rest, &from.rest, &terms, |x| &x.rest);
        set_plus(&mut self.rates, &from.rates, &terms, |x| &x.rates);
    }

    /// The sum, of which the pairs are known.
    #[inline(always)]
    fn plus_with<const K: usize>(&self, pairs: [[S; 2]; TURNS], terms: [(S, &Self); K]) -> Self {
        Self {
            pairs,
            rest: plus(&self.rest, &terms, |x| &x.rest),
            rates: plus(&self.rates, &terms, |x| &x.rates),
            turns: self.turns,
        }
    }
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize> Vector<S>
    for JointState<S, TURNS, REST, RATES, A>
{
    const PLUS_IS_COSTLY: bool = TURNS > 0;

    /// Of many the operations count: the turns of a stage do not wait for each other. Measured, see
    /// docs/decisions/006-turns-in-a-step.md.
    const USES_NEAR: bool = TURNS > 0 && TURNS <= if S::SEVEN_DIGITS { 12 } else { 5 };

    type Each<T: Clone> = EachOfJoints<T, TURNS, REST, RATES>;

    fn each<T: Clone>(&self, value: T) -> EachOfJoints<T, TURNS, REST, RATES> {
        EachOfJoints::new(value)
    }

    #[inline(always)]
    fn room(&self) -> Self {
        let zero = S::zero();
        Self {
            pairs: [[zero; 2]; TURNS],
            rest: [zero; REST],
            rates: [zero; RATES],
            turns: self.turns,
        }
    }

    fn length(&self) -> usize {
        2 * TURNS + REST + RATES
    }

    #[inline(always)]
    fn coordinate_count(&self) -> usize {
        2 * TURNS + REST
    }

    #[inline(always)]
    fn velocities_slice(&self) -> &[S] {
        &self.rates
    }

    #[inline(always)]
    fn velocities_slice_mut(&mut self) -> &mut [S] {
        &mut self.rates
    }

    #[inline(always)]
    fn element(&self, index: usize) -> S {
        if index < 2 * TURNS {
            self.pairs[index / 2][index % 2]
        } else if index < 2 * TURNS + REST {
            self.rest.element(index - 2 * TURNS)
        } else {
            self.rates.element(index - 2 * TURNS - REST)
        }
    }

    #[inline(always)]
    fn set_element(&mut self, index: usize, value: S) {
        if index < 2 * TURNS {
            self.pairs[index / 2][index % 2] = value;
        } else if index < 2 * TURNS + REST {
            self.rest.set_element(index - 2 * TURNS, value);
        } else {
            self.rates.set_element(index - 2 * TURNS - REST, value);
        }
    }

    #[inline(always)]
    fn zip(&self, other: &Self, mut f: impl FnMut(S, S) -> S) -> Self {
        let mut pairs = self.pairs;
        for (pair, other) in pairs.iter_mut().zip(&other.pairs) {
            *pair = Vector::zip(pair, other, &mut f);
        }
        Self {
            pairs,
            rest: Vector::zip(&self.rest, &other.rest, &mut f),
            rates: Vector::zip(&self.rates, &other.rates, &mut f),
            turns: self.turns,
        }
    }

    #[inline(always)]
    fn for_each(&self, mut f: impl FnMut(S)) {
        for pair in &self.pairs {
            Vector::for_each(pair, &mut f);
        }
        Vector::for_each(&self.rest, &mut f);
        Vector::for_each(&self.rates, &mut f);
    }

    /// The second element of a pair has none.
    fn is_independent(&self, index: usize) -> bool {
        index >= 2 * TURNS || index.is_multiple_of(2)
    }

    #[inline(always)]
    fn plus<const K: usize>(&self, terms: [(S, &Self); K]) -> Self {
        if Self::IS_APART {
            let mut sum = *self;
            sum.set_plus(self, terms);
            return sum;
        }
        self.plus_with(turned(&self.pairs, &increments(&terms)), terms)
    }

    #[inline(always)]
    fn set_plus<const K: usize>(&mut self, from: &Self, terms: [(S, &Self); K]) {
        if !Self::IS_APART {
            *self = from.plus(terms);
            return;
        }
        let turning = terms.map(|(factor, slope)| (factor, &slope.pairs));
        for place in 0..TURNS {
            turn_apart(&mut self.pairs, &from.pairs, place, &turning);
        }
        self.set_others(from, terms);
    }

    #[inline(always)]
    fn set_plus_once_and_twice(
        &mut self,
        twice: &mut Self,
        from: &Self,
        (factor, direction): (S, &Self),
    ) {
        if !Self::USES_NEAR {
            self.set_plus(from, [(factor, direction)]);
            return;
        }
        if !Self::IS_APART {
            [*self, *twice] = from.plus_once_and_twice(factor, direction);
            return;
        }
        for place in 0..TURNS {
            let to = [&mut self.pairs, &mut twice.pairs];
            turn_once_and_twice_apart(to, &from.pairs, place, (factor, &direction.pairs));
        }
        self.set_others(from, [(factor, direction)]);
        twice.set_others(from, [(factor + factor, direction)]);
    }

    #[inline(always)]
    fn set_plus_beside<const K: usize>(
        &mut self,
        (from, near): (&Self, &Self),
        along: (S, &Self),
        terms: [(S, &Self); K],
    ) {
        if Self::USES_NEAR {
            *self = from.plus_beside(near, along, terms);
        } else {
            self.set_plus(from, terms);
        }
    }

    #[inline(always)]
    fn plus_once_and_twice(&self, factor: S, direction: &Self) -> [Self; 2] {
        let angles = increments(&[(factor, direction)]);
        let [once, twice] = turned_once_and_twice(&self.pairs, &angles);
        [
            self.plus_with(once, [(factor, direction)]),
            self.plus_with(twice, [(factor + factor, direction)]),
        ]
    }

    /// Pairs go on from those that are known by little angles: that is less to compute, and what
    /// waits for the last slope is short.
    #[inline(always)]
    fn plus_beside<const K: usize>(
        &self,
        near: &Self,
        along: (S, &Self),
        terms: [(S, &Self); K],
    ) -> Self {
        if !Self::USES_NEAR {
            return self.plus(terms);
        }
        let (factor, slope) = along;
        let angles = more_increments(increments(&[(-factor, slope)]), &terms);
        let mut pairs = near.pairs;
        if S::are_within(&angles, LITTLE) {
            for (pair, angle) in pairs.iter_mut().zip(&angles) {
                if Self::IS_APART {
                    turn_a_little_apart(pair, angle);
                } else {
                    *pair = turned_a_little(*pair, *angle);
                }
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

    #[inline(always)]
    fn towards<const W: usize, const K: usize>(
        &self,
        to: &Self,
        weight: S,
        way: [(S, &Self); W],
        terms: [(S, &Self); K],
    ) -> Self {
        let mut angles = increments(&terms);
        let way = increments(&way);
        let there = turned(&self.pairs, &way);
        for (((angle, way), [c, s]), [to_c, to_s]) in
            angles.iter_mut().zip(way).zip(there).zip(to.pairs)
        {
            let missing = c.fused(to_s, -(s * to_c));
            let turn = way + missing.atan2(c.fused(to_c, s * to_s));
            *angle = turn.fused(weight, *angle);
        }
        let rest = terms.map(|(factor, x)| (factor, &x.rest));
        let rates = terms.map(|(factor, x)| (factor, &x.rates));
        Self {
            pairs: turned(&self.pairs, &angles),
            rest: self.rest.towards(&to.rest, weight, [], rest),
            rates: self.rates.towards(&to.rates, weight, [], rates),
            turns: self.turns,
        }
    }

    #[inline(always)]
    fn weighted_norm<const K: usize>(&self, other: &Self, floor: S, terms: [(S, &Self); K]) -> S
    where
        S: Real,
    {
        let mut angles = increments(&terms);
        let rest = [&self.rest, &other.rest];
        let rates = [&self.rates, &other.rates];
        if S::CARRIES_DERIVATIVES {
            let ends = self.pairs.iter().zip(&other.pairs);
            let angles = angles.into_iter().zip(ends);
            let angles = angles.map(|(angle, (&x, &y))| [angle, a_radian(x), a_radian(y)]);
            let rest = shares(rest, plus(&[S::zero(); REST], &terms, |x: &Self| &x.rest));
            let rates = shares(
                rates,
                plus(&[S::zero(); RATES], &terms, |x: &Self| &x.rates),
            );
            return S::largest_share(angles.chain(rest).chain(rates), floor);
        }
        let scale = greater(S::one(), floor);
        for angle in &mut angles {
            *angle = angle.abs().quotient(scale);
        }
        greatest(&angles)
            .max(weighted_norm(rest, floor, &terms, |x: &Self| &x.rest))
            .max(weighted_norm(rates, floor, &terms, |x: &Self| &x.rates))
    }

    #[inline(always)]
    fn is_finite(&self) -> bool
    where
        S: Real,
    {
        // Of few elements one sum is the least to do, and a kernel of few operations feels it; of
        // more, they would wait for each other.
        let few = 2 * TURNS + REST + RATES <= 6;
        let pairs = self.pairs.as_flattened();
        let zero = if few {
            let pairs = zero_if_finite_after(-S::zero(), pairs);
            zero_if_finite_after(zero_if_finite_after(pairs, &self.rest), &self.rates)
        } else {
            zero_if_finite(pairs) + zero_if_finite(&self.rest) + zero_if_finite(&self.rates)
        };
        zero == S::zero()
    }

    #[inline(always)]
    fn turns(&self) -> &[S] {
        &self.turns
    }

    #[inline(always)]
    fn turns_mut(&mut self) -> &mut [S] {
        &mut self.turns
    }
}
