//! What integrators and kernels ask of arrays and states.

use core::ops::IndexMut;

use crate::math::scalar::{Real, Scalar};
use crate::state::sealed::Sealed;

/// A fixed-size array of scalars: multipliers, accelerations, blocks of the Jacobian.
pub trait Array<S: Scalar>: Copy + core::fmt::Debug + PartialEq + Sealed {
    /// The array with zero in every place.
    fn zeros() -> Self;

    /// The elements.
    fn as_slice(&self) -> &[S];

    /// The elements, to be written.
    fn as_mut_slice(&mut self) -> &mut [S];
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

    /// Whether [`Vector::set_plus_beside`] goes on from the sum that is known.
    const USES_NEAR: bool = false;

    /// `f(self[k], other[k])` for every element.
    #[must_use]
    fn zip(&self, other: &Self, f: impl FnMut(S, S) -> S) -> Self;

    /// Room for another vector of this kind: zeros, which cost less than a copy where one is
    /// written. What no integrator moves is as here.
    #[must_use]
    fn room(&self) -> Self {
        self.zip(self, |_, _| S::zero())
    }

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

    /// The elements behind the coordinates, where they stand in one slice; empty where they do not.
    ///
    /// Implicit methods then solve for these alone, where the rates of coordinates are velocities.
    #[must_use]
    fn velocities_slice(&self) -> &[S] {
        &[]
    }

    /// These elements, to be written.
    fn velocities_slice_mut(&mut self) -> &mut [S] {
        &mut []
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

    /// Writes [`Vector::plus`] of another vector here: numbers that are arrays make states large,
    /// and each is then written once. What no integrator moves, see [`Vector::turns`], has to be
    /// the same in both, as [`Vector::room`] makes it.
    fn set_plus<const N: usize>(&mut self, from: &Self, terms: [(S, &Self); N]) {
        *self = from.plus(terms);
    }

    /// Writes [`Vector::plus_once_and_twice`], the one here. The latter is for
    /// [`Vector::set_plus_beside`] alone: nothing is written there where [`Vector::USES_NEAR`] is
    /// not said.
    fn set_plus_once_and_twice(
        &mut self,
        twice: &mut Self,
        from: &Self,
        (factor, direction): (S, &Self),
    ) {
        self.set_plus(from, [(factor, direction)]);
        if Self::USES_NEAR {
            twice.set_plus(from, [(factor + factor, direction)]);
        }
    }

    /// Writes [`Vector::plus_beside`] of another vector here.
    fn set_plus_beside<const N: usize>(
        &mut self,
        (from, near): (&Self, &Self),
        along: (S, &Self),
        terms: [(S, &Self); N],
    ) {
        let _ = (near, along);
        self.set_plus(from, terms);
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

/// A state with velocities, in whatever coordinates. Its slope has the same type.
pub trait MovingState<S: Scalar>: Vector<S> + Copy + core::fmt::Debug + PartialEq + Sealed {
    /// The state with zero in every place.
    fn zeros() -> Self;

    /// The velocities; of a slope, the accelerations.
    fn rates_slice(&self) -> &[S];

    /// The velocities, to be written.
    fn rates_slice_mut(&mut self) -> &mut [S];
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
