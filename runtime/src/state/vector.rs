//! Fixed-size arrays of scalars, and the state of a mechanism.

use crate::math::scalar::{Real, Scalar};
use crate::state::each::EachOfState;
use crate::state::sealed::Sealed;
use crate::state::sums::{plus, shares, weighted_norm, zero_if_finite};

pub use crate::state::traits::{Array, MovingState, StateParts, Vector};

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
    fn velocities_slice(&self) -> &[S] {
        self
    }

    #[inline(always)]
    fn velocities_slice_mut(&mut self) -> &mut [S] {
        self
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
#[derive(Copy, Debug)]
pub struct State<S, const Q: usize, const U: usize, const A: usize = 0> {
    coordinates: [S; Q],
    velocities: [S; U],
    turns: [S; A],
}

/// At once, not part by part.
impl<S: Copy, const Q: usize, const U: usize, const A: usize> Clone for State<S, Q, U, A> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
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

    #[inline(always)]
    fn coordinate_count(&self) -> usize {
        Q
    }

    #[inline(always)]
    fn velocities_slice(&self) -> &[S] {
        &self.velocities
    }

    #[inline(always)]
    fn velocities_slice_mut(&mut self) -> &mut [S] {
        &mut self.velocities
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

impl<S, const Q: usize, const U: usize, const A: usize> Sealed for State<S, Q, U, A> {}

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
