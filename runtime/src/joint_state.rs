//! The state of a mechanism in joint coordinates, whose angles are pairs on a circle.

use crate::array::{Vector, greater, greatest, plus, relative_norm, zero_if_finite};
use crate::each::EachOfJoints;
use crate::scalar::{Real, Scalar};

/// The state of a mechanism in joint coordinates: a pair (cosine, sine) for the angle of every turning joint, further coordinates, rates.
///
/// A kernel reads cosines and sines as they are and calls no function. Pairs have length 1; `rest` (displacements, say) and `rates`, of which
/// there may be as many as the system needs, are plain numbers. The same type holds the slope of a state: there a pair is `[rate of the angle
/// (rad/s), 0]`, and the second element has no part in anything.
///
/// # How an integrator moves it
///
/// - [`Vector::plus`] *turns* a pair by the sum of its increments: what a method does with the angle it does with the pair, up to round-off, at
///   the stages too, because turns about one axis commute. Pairs whose elements are integrated as numbers lose an order of magnitude in
///   accuracy. The sine and cosine of an increment are exact to round-off for every size; below 0.9 rad a turn calls no function in `f64` and
///   `f32` ([`Scalar::sines_and_versines`]). Every turn takes back what round-off did to the length before: it does not drift. A pair that was
///   given with an error `e` in its length has `1.5 e^2` after a turn; what is off by a tenth or more is no angle.
/// - [`Vector::relative_norm`] measures the increment of an angle in radians, against `max(1, floor)`. Angles on a circle have no size, so a relative
///   tolerance is one in radians, and an absolute one counts if it is greater.
/// - [`Vector::towards`] goes along the circle, by the turn nearest to the given way.
/// - [`Vector::zip`] and [`Vector::for_each`] see plain numbers: both elements of every pair, `rest`, `rates`.
///
/// ```
/// use holonom::{Fault, JointState, Rk4, Scheme, System};
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState<S, const TURNS: usize, const REST: usize, const RATES: usize> {
    pairs: [[S; 2]; TURNS],
    rest: [S; REST],
    rates: [S; RATES],
}

impl<S, const TURNS: usize, const REST: usize, const RATES: usize>
    JointState<S, TURNS, REST, RATES>
{
    /// A state of its parts. Pairs are taken as they are: their length should be 1.
    #[inline(always)]
    #[must_use]
    pub const fn from_parts(pairs: [[S; 2]; TURNS], rest: [S; REST], rates: [S; RATES]) -> Self {
        Self { pairs, rest, rates }
    }

    /// Cosine and sine of the angle of every turning joint; of a slope, the rate of the angle (rad/s) and zero.
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
fn increments<S: Scalar, const T: usize, const Q: usize, const U: usize, const K: usize>(
    terms: &[(S, &JointState<S, T, Q, U>); K],
) -> [S; T] {
    // Adding to -0 changes no number, and so costs nothing.
    let mut sums = [-S::zero(); T];
    for (factor, slope) in terms {
        for (sum, [rate, _]) in sums.iter_mut().zip(&slope.pairs) {
            *sum = rate.fused(*factor, *sum);
        }
    }
    sums
}

/// Pairs, turned by angles (rad).
///
/// With the versine `v` and the sine `s` of an angle, a pair `p` and its normal `n` go to `p + (s n - v p)`, which is rounded once where the increment is small.
/// They are stretched by `1 + e` on the way, `e = (1 - p.p) / 2`, which takes the length to 1 and is known long before the angle is. `e p` alone would do for small
/// angles; at half a turn it would do the opposite.
#[inline(always)]
fn turned<S: Scalar, const T: usize>(pairs: &[[S; 2]; T], angles: &[S; T]) -> [[S; 2]; T] {
    let mut result = *pairs;
    let turns = S::sines_and_versines(angles);
    for (pair, [sine, versine]) in result.iter_mut().zip(turns) {
        let [c, s] = *pair;
        let stretch = S::constant(-0.5) * c.fused(c, s.fused(s, -S::one()));
        let (more_c, more_s) = (stretch * c, stretch * s);
        let (full_c, full_s) = (c + more_c, s + more_s);
        *pair = [
            c + versine.fused(-full_c, sine.fused(-full_s, more_c)),
            s + versine.fused(-full_s, sine.fused(full_c, more_s)),
        ];
    }
    result
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize> Vector<S>
    for JointState<S, TURNS, REST, RATES>
{
    const PLUS_IS_COSTLY: bool = TURNS > 0;

    type Each<T: Clone> = EachOfJoints<T, TURNS, REST, RATES>;

    fn each<T: Clone>(&self, value: T) -> EachOfJoints<T, TURNS, REST, RATES> {
        EachOfJoints::new(value)
    }

    fn length(&self) -> usize {
        2 * TURNS + REST + RATES
    }

    fn coordinate_count(&self) -> usize {
        2 * TURNS + REST
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
    fn has_part(&self, index: usize) -> bool {
        index >= 2 * TURNS || index.is_multiple_of(2)
    }

    #[inline(always)]
    fn plus<const K: usize>(&self, terms: [(S, &Self); K]) -> Self {
        Self {
            pairs: turned(&self.pairs, &increments(&terms)),
            rest: plus(&self.rest, &terms, |x| &x.rest),
            rates: plus(&self.rates, &terms, |x| &x.rates),
        }
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
        }
    }

    #[inline(always)]
    fn relative_norm<const K: usize>(&self, other: &Self, floor: S, terms: [(S, &Self); K]) -> S
    where
        S: Real,
    {
        let scale = greater(S::one(), floor);
        let mut angles = increments(&terms);
        for angle in &mut angles {
            *angle = angle.abs().quotient(scale);
        }
        let rest = [&self.rest, &other.rest];
        let rates = [&self.rates, &other.rates];
        greatest(&angles)
            .max(relative_norm(rest, floor, &terms, |x: &Self| &x.rest))
            .max(relative_norm(rates, floor, &terms, |x: &Self| &x.rates))
    }

    #[inline(always)]
    fn is_finite(&self) -> bool
    where
        S: Real,
    {
        let pairs = zero_if_finite(self.pairs.as_flattened());
        pairs + zero_if_finite(&self.rest) + zero_if_finite(&self.rates) == S::zero()
    }
}

#[cfg(test)]
mod tests;
