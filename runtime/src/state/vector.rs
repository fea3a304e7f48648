//! Fixed-size arrays of scalars, and the state of a mechanism.

use core::ops::IndexMut;

use crate::math::scalar::{Real, Scalar};
use crate::state::each::EachOfState;

/// A fixed-size array of scalars: multipliers, accelerations, blocks of the Jacobian.
pub trait Array<S: Scalar>: Copy + core::fmt::Debug + PartialEq {
    /// The array with zero in every place.
    fn zeros() -> Self;

    /// The elements.
    fn as_slice(&self) -> &[S];

    /// The elements, to be written.
    fn as_mut_slice(&mut self) -> &mut [S];
}

impl<S: Scalar, const N: usize> Array<S> for [S; N] {
    #[inline(always)]
    fn zeros() -> Self {
        [S::zero(); N]
    }

    #[inline(always)]
    fn as_slice(&self) -> &[S] {
        self
    }

    #[inline(always)]
    fn as_mut_slice(&mut self) -> &mut [S] {
        self
    }
}

/// What an integrator moves: a vector with addition and scaling, element by element.
///
/// The derivative of a state has the same type. What explicit integrators need has a default body,
/// so that a vector of another kind (on the heap, say) has three functions to write. A state that
/// is no vector throughout, such as [`crate::state::JointState`], replaces what adds to it and what
/// measures an increment.
pub trait Vector<S: Scalar>: Clone {
    /// One thing for every element: an implicit method keeps the columns of a matrix in it.
    type Each<T: Clone>: Clone + IndexMut<usize, Output = T>;

    /// Whether [`Vector::plus`] costs more than to keep a slope: a method then adds its slopes at
    /// once.
    const PLUS_IS_COSTLY: bool = false;

    /// `f(self[k], other[k])` for every element.
    #[must_use]
    fn zip(&self, other: &Self, f: impl FnMut(S, S) -> S) -> Self;

    /// Calls `f` with every element, in order.
    fn for_each(&self, f: impl FnMut(S));

    /// The same thing for every element.
    fn each<T: Clone>(&self, value: T) -> Self::Each<T>;

    /// How many elements there are.
    #[must_use]
    fn length(&self) -> usize {
        let mut length = 0;
        self.for_each(|_| length += 1);
        length
    }

    /// The element at a place in the order of [`Vector::for_each`]; zero where there is none.
    #[must_use]
    fn element(&self, index: usize) -> S {
        let (mut place, mut found) = (0, S::zero());
        self.for_each(|element| {
            if place == index {
                found = element;
            }
            place += 1;
        });
        found
    }

    /// Writes the element at a place, if there is one.
    fn set_element(&mut self, index: usize, value: S) {
        let mut place = 0;
        *self = self.zip(self, |element, _| {
            place += 1;
            if place == index + 1 { value } else { element }
        });
    }

    /// How many elements, the first ones, are coordinates: numbers whose rates are made of the
    /// velocities behind them. Zero where nothing of that kind is known.
    ///
    /// Implicit methods eliminate these first, in equations that then couple few of them.
    #[must_use]
    fn coordinate_count(&self) -> usize {
        0
    }

    /// Whether an increment of the element at a place has a part in [`Vector::plus`]: implicit
    /// methods need no derivative for one that has none.
    #[must_use]
    fn is_independent(&self, index: usize) -> bool {
        let _ = index;
        true
    }

    /// `self + sum of factor * direction`, element by element.
    #[must_use]
    fn plus<const N: usize>(&self, terms: [(S, &Self); N]) -> Self {
        let mut result = self.clone();
        for (factor, direction) in terms {
            result = result.zip(direction, |x, slope| slope.fused(factor, x));
        }
        result
    }

    /// [`Vector::plus`] of one direction, by a factor and by twice that factor: what these have in
    /// common is computed once.
    #[must_use]
    fn plus_once_and_twice(&self, factor: S, direction: &Self) -> [Self; 2] {
        [factor, factor + factor].map(|factor| self.plus([(factor, direction)]))
    }

    /// [`Vector::plus`] of directions that hardly differ from one for which the sum is known:
    /// `near` is `self.plus([along])`. Where that helps, the result is `near` and what the
    /// increments differ by.
    #[must_use]
    fn plus_beside<const N: usize>(
        &self,
        near: &Self,
        along: (S, &Self),
        terms: [(S, &Self); N],
    ) -> Self {
        let _ = (near, along);
        self.plus(terms)
    }

    /// `self + weight * (to - self) + sum of factor * direction`: on the way to another state, and
    /// beside it.
    ///
    /// `way` is the increment, in its sum, that leads to the other state or nearly so. It counts
    /// where many increments lead there: an angle goes on by any number of turns.
    #[must_use]
    fn towards<const W: usize, const N: usize>(
        &self,
        to: &Self,
        weight: S,
        way: [(S, &Self); W],
        terms: [(S, &Self); N],
    ) -> Self {
        let _ = way;
        self.plus([(-weight, self), (weight, to)]).plus(terms)
    }

    /// `max over k of |sum of factor * direction[k]| / max(|self[k]|, |other[k]|, floor)`: an
    /// increment, relative to the larger of two vectors. NaN if any element is NaN.
    #[must_use]
    fn weighted_norm<const N: usize>(&self, other: &Self, floor: S, terms: [(S, &Self); N]) -> S
    where
        S: Real,
    {
        let increment = self.zip(self, |_, _| S::zero()).plus(terms);
        if S::CARRIES_DERIVATIVES {
            let elements = (0..self.length()).map(|place| {
                let of = |vector: &Self| vector.element(place);
                [of(&increment), of(self), of(other)]
            });
            return S::largest_share(elements, floor);
        }
        let scale = self.zip(other, |x, y| x.abs().max(y.abs()).max(floor));
        let mut norm = S::zero();
        let ratio = increment.zip(&scale, |x, scale| x.abs().quotient(scale));
        ratio.for_each(|ratio| norm = norm.max(ratio));
        norm
    }

    /// The account of angles over many turns: the angle (rad) of every joint that has one, in their
    /// order, as it was counted last, and behind these how far (rad) any may have turned since.
    /// Zeros where nothing was counted: the described configuration. Empty for a mechanism without
    /// such joints.
    ///
    /// An angle that is read is the one of all with its sine and cosine that is nearest to this.
    /// Runs and steppers count on, and setting an angle sets it; no integrator moves it.
    #[must_use]
    fn turns(&self) -> &[S] {
        &[]
    }

    /// The account, to be written.
    fn turns_mut(&mut self) -> &mut [S] {
        &mut []
    }

    /// Whether every element is finite.
    #[must_use]
    fn is_finite(&self) -> bool
    where
        S: Real,
    {
        let mut finite = true;
        self.for_each(|element| finite &= element.is_finite());
        finite
    }
}

impl<S: Scalar, const N: usize> Vector<S> for [S; N] {
    type Each<T: Clone> = [T; N];

    fn each<T: Clone>(&self, value: T) -> [T; N] {
        core::array::from_fn(|_| value.clone())
    }

    fn length(&self) -> usize {
        N
    }

    #[inline(always)]
    fn element(&self, index: usize) -> S {
        self.get(index).copied().unwrap_or(S::zero())
    }

    #[inline(always)]
    fn set_element(&mut self, index: usize, value: S) {
        if let Some(element) = self.get_mut(index) {
            *element = value;
        }
    }

    #[inline(always)]
    fn zip(&self, other: &Self, mut f: impl FnMut(S, S) -> S) -> Self {
        let mut result = *self;
        for (element, other) in result.iter_mut().zip(other) {
            *element = f(*element, *other);
        }
        result
    }

    #[inline(always)]
    fn for_each(&self, mut f: impl FnMut(S)) {
        for &element in self {
            f(element);
        }
    }

    #[inline(always)]
    fn plus<const K: usize>(&self, terms: [(S, &Self); K]) -> Self {
        plus(self, &terms, |direction| direction)
    }

    #[inline(always)]
    fn weighted_norm<const K: usize>(&self, other: &Self, floor: S, terms: [(S, &Self); K]) -> S
    where
        S: Real,
    {
        if S::CARRIES_DERIVATIVES {
            let increments = [S::zero(); N].plus(terms);
            return S::largest_share(shares([self, other], increments), floor);
        }
        weighted_norm([self, other], floor, &terms, |direction| direction)
    }

    #[inline(always)]
    fn is_finite(&self) -> bool
    where
        S: Real,
    {
        zero_if_finite(self) == S::zero()
    }
}

/// [`Vector::plus`] of a part of a state.
#[inline(always)]
pub(crate) fn plus<S: Scalar, X, const N: usize>(
    from: &[S; N],
    terms: &[(S, &X)],
    part: impl Fn(&X) -> &[S; N],
) -> [S; N] {
    let mut result = *from;
    for (factor, direction) in terms {
        for (element, slope) in result.iter_mut().zip(part(direction)) {
            *element = slope.fused(*factor, *element);
        }
    }
    result
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

/// A sum and -0 times all elements: the sum where these are finite, else NaN, as is -0 times any
/// other number, and every sum with NaN. A comparison for each would be more.
///
/// By -0, because what is known to be +0 then changes no sum that begins with -0, and costs
/// nothing.
#[inline(always)]
pub(crate) fn zero_if_finite_after<S: Real>(sum: S, elements: &[S]) -> S {
    let add = |sum, element: &S| element.fused(-S::zero(), sum);
    elements.iter().fold(sum, add)
}

/// The same from -0 on, of many four places at once, as in [`greatest`]; for few, one sum after the
/// other is less than to bring four together.
#[inline(always)]
pub(crate) fn zero_if_finite<S: Real>(elements: &[S]) -> S {
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

/// The state of a mechanism: coordinates and velocities of its bodies, and auxiliary variables, in
/// an order that the mechanism knows.
///
/// The elements are read and written by handle, see [`crate::Mechanism`]; the order of the raw
/// arrays is, body by body, `[r (m, global), p (Euler parameters, scalar first, principal axes)]`
/// and `[v (m/s, global), w (rad/s, principal axes)]`; a particle has `r` and `v` only. Behind the
/// coordinates of all bodies stand the auxiliary variables of mechanisms that have some: angles
/// that count turns (rad). The user's own states are behind these. The same type holds the rates of
/// a state.
///
/// Beside these, a state counts the turns of joints that have an angle: `A` numbers, which no
/// integrator moves. See [`Vector::turns`].
#[derive(Clone, Copy, Debug)]
pub struct State<S, const Q: usize, const U: usize, const A: usize = 0> {
    coordinates: [S; Q],
    velocities: [S; U],
    turns: [S; A],
}

impl<S, const Q: usize, const U: usize> State<S, Q, U> {
    /// A state of its parts that counts no angle.
    #[inline(always)]
    #[must_use]
    pub const fn from_parts(coordinates: [S; Q], velocities: [S; U]) -> Self {
        let turns = [];
        Self {
            coordinates,
            velocities,
            turns,
        }
    }
}

impl<S: Scalar, const Q: usize, const U: usize, const A: usize> State<S, Q, U, A> {
    /// The same for any account of angles, which begins at zero.
    #[doc(hidden)]
    #[inline(always)]
    #[must_use]
    pub fn of_parts(coordinates: [S; Q], velocities: [S; U]) -> Self {
        let turns = [S::zero(); A];
        Self {
            coordinates,
            velocities,
            turns,
        }
    }
}

/// Equal numbers, and no joint that is a turn further on.
impl<S: Scalar, const Q: usize, const U: usize, const A: usize> PartialEq for State<S, Q, U, A> {
    fn eq(&self, other: &Self) -> bool {
        self.coordinates == other.coordinates
            && self.velocities == other.velocities
            && are_of_one_turn(&self.turns, &other.turns)
    }
}

/// Whether the same angles are meant by two counts, see [`Vector::turns`].
pub(crate) fn are_of_one_turn<S: Scalar, const T: usize>(a: &[S; T], b: &[S; T]) -> bool {
    let angles = T.saturating_sub(1);
    let turn = S::constant(core::f64::consts::TAU.recip());
    let mut both = a.iter().zip(b).take(angles);
    both.all(|(&a, &b)| ((a - b) * turn).round() == S::zero())
}

impl<S: Scalar, const Q: usize, const U: usize, const A: usize> Vector<S> for State<S, Q, U, A> {
    type Each<T: Clone> = EachOfState<T, Q, U>;

    fn each<T: Clone>(&self, value: T) -> EachOfState<T, Q, U> {
        EachOfState::new(value)
    }

    fn length(&self) -> usize {
        Q + U
    }

    fn coordinate_count(&self) -> usize {
        Q
    }

    #[inline(always)]
    fn element(&self, index: usize) -> S {
        if index < Q {
            self.coordinates.element(index)
        } else {
            self.velocities.element(index - Q)
        }
    }

    #[inline(always)]
    fn set_element(&mut self, index: usize, value: S) {
        if index < Q {
            self.coordinates.set_element(index, value);
        } else {
            self.velocities.set_element(index - Q, value);
        }
    }

    #[inline(always)]
    fn zip(&self, other: &Self, mut f: impl FnMut(S, S) -> S) -> Self {
        Self {
            coordinates: Vector::zip(&self.coordinates, &other.coordinates, &mut f),
            velocities: Vector::zip(&self.velocities, &other.velocities, &mut f),
            turns: self.turns,
        }
    }

    #[inline(always)]
    fn for_each(&self, mut f: impl FnMut(S)) {
        Vector::for_each(&self.coordinates, &mut f);
        Vector::for_each(&self.velocities, &mut f);
    }

    #[inline(always)]
    fn plus<const K: usize>(&self, terms: [(S, &Self); K]) -> Self {
        Self {
            coordinates: plus(&self.coordinates, &terms, |x| &x.coordinates),
            velocities: plus(&self.velocities, &terms, |x| &x.velocities),
            turns: self.turns,
        }
    }

    #[inline(always)]
    fn weighted_norm<const K: usize>(&self, other: &Self, floor: S, terms: [(S, &Self); K]) -> S
    where
        S: Real,
    {
        let coordinates = [&self.coordinates, &other.coordinates];
        let velocities = [&self.velocities, &other.velocities];
        if S::CARRIES_DERIVATIVES {
            let zero = Self::of_parts([S::zero(); Q], [S::zero(); U]);
            let increments = zero.plus(terms);
            let moved = shares(coordinates, increments.coordinates);
            let rates = shares(velocities, increments.velocities);
            return S::largest_share(moved.chain(rates), floor);
        }
        let moved = weighted_norm(coordinates, floor, &terms, |x: &Self| &x.coordinates);
        moved.max(weighted_norm(velocities, floor, &terms, |x: &Self| {
            &x.velocities
        }))
    }

    #[inline(always)]
    fn is_finite(&self) -> bool
    where
        S: Real,
    {
        // Not `&&`, which would branch once more.
        zero_if_finite(&self.coordinates) + zero_if_finite(&self.velocities) == S::zero()
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

/// A state with velocities, in whatever coordinates. Its slope has the same type.
pub trait MovingState<S: Scalar>: Vector<S> + Copy + core::fmt::Debug + PartialEq {
    /// The state with zero in every place.
    fn zeros() -> Self;

    /// The velocities; of a slope, the accelerations.
    fn rates_slice(&self) -> &[S];

    /// The velocities, to be written.
    fn rates_slice_mut(&mut self) -> &mut [S];
}

impl<S: Scalar, const Q: usize, const U: usize, const A: usize> MovingState<S>
    for State<S, Q, U, A>
{
    #[inline(always)]
    fn zeros() -> Self {
        Self {
            coordinates: [S::zero(); Q],
            velocities: [S::zero(); U],
            turns: [S::zero(); A],
        }
    }

    #[inline(always)]
    fn rates_slice(&self) -> &[S] {
        &self.velocities
    }

    #[inline(always)]
    fn rates_slice_mut(&mut self) -> &mut [S] {
        &mut self.velocities
    }
}

/// Access to the two parts of a state, for code that is generic over the mechanism.
pub trait StateParts<S: Scalar>: MovingState<S> {
    /// Coordinates `q` (and auxiliary variables).
    type Coordinates: Array<S>;
    /// Velocities `u`.
    type Velocities: Array<S>;

    /// A state of the two parts, near the described configuration: nothing is counted.
    fn from_parts(coordinates: Self::Coordinates, velocities: Self::Velocities) -> Self;

    /// Coordinates `q` (and auxiliary variables).
    fn coordinates(&self) -> &Self::Coordinates;

    /// Velocities `u`.
    fn velocities(&self) -> &Self::Velocities;

    /// Coordinates `q`, to be written.
    fn coordinates_mut(&mut self) -> &mut Self::Coordinates;

    /// Velocities `u`, to be written.
    fn velocities_mut(&mut self) -> &mut Self::Velocities;
}

impl<S: Scalar, const Q: usize, const U: usize, const A: usize> StateParts<S>
    for State<S, Q, U, A>
{
    type Coordinates = [S; Q];
    type Velocities = [S; U];

    #[inline(always)]
    fn from_parts(coordinates: [S; Q], velocities: [S; U]) -> Self {
        Self::of_parts(coordinates, velocities)
    }

    #[inline(always)]
    fn coordinates(&self) -> &[S; Q] {
        &self.coordinates
    }

    #[inline(always)]
    fn velocities(&self) -> &[S; U] {
        &self.velocities
    }

    #[inline(always)]
    fn coordinates_mut(&mut self) -> &mut [S; Q] {
        &mut self.coordinates
    }

    #[inline(always)]
    fn velocities_mut(&mut self) -> &mut [S; U] {
        &mut self.velocities
    }
}

#[cfg(test)]
mod tests {
    use super::{State, Vector};
    use crate::math::scalar::Real;

    fn all_places<S: Real, const N: usize>(largest: S) {
        let sound = [largest, -largest, S::zero(), S::smallest(), S::one()];
        let elements = core::array::from_fn(|place| sound[place % sound.len()]);
        assert!(Vector::is_finite(&elements));
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY].map(S::constant) {
            for place in 0..N {
                let mut elements: [S; N] = elements;
                elements[place] = bad;
                assert!(!Vector::is_finite(&elements));
                let (sound, all) = ([S::one(); 6], [bad; N]);
                assert!(!State::from_parts(elements, sound).is_finite());
                assert!(!State::from_parts(sound, elements).is_finite());
                assert!(!State::from_parts(sound, all).is_finite());
            }
        }
    }

    #[test]
    fn what_is_not_finite_is_found_in_every_place() {
        all_places::<f64, 1>(f64::MAX);
        all_places::<f64, 7>(f64::MAX);
        all_places::<f64, 21>(f64::MAX);
        all_places::<f32, 13>(f32::MAX);
        assert!(Vector::is_finite(&[0.0_f64; 0]));
    }
}
