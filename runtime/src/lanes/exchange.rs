//! Numbers that are brought into lanes, and back.

use super::Lanes;
use crate::math::scalar::Real;
use crate::state::vector::{Array, MovingState};

/// Writes an array into a lane.
pub(super) fn put<T: Real, A: Array<T>, B: Array<Lanes<T, L>>, const L: usize>(
    all: &mut B,
    lane: usize,
    numbers: &A,
) {
    let places = all.as_mut_slice().iter_mut();
    for (place, &number) in places.zip(numbers.as_slice()) {
        place.set_lane(lane, number);
    }
}

/// Writes a state into a lane.
pub(super) fn put_state<T: Real, X: MovingState<T>, Y: MovingState<Lanes<T, L>>, const L: usize>(
    all: &mut Y,
    lane: usize,
    state: &X,
) {
    for index in 0..state.length() {
        let mut place = all.element(index);
        place.set_lane(lane, state.element(index));
        all.set_element(index, place);
    }
    let counted = all.turns_mut().iter_mut();
    for (place, &number) in counted.zip(state.turns()) {
        place.set_lane(lane, number);
    }
}

/// The state of a lane; zeros where there is no such lane.
pub(super) fn state_of<T: Real, X: MovingState<T>, Y: MovingState<Lanes<T, L>>, const L: usize>(
    all: &Y,
    lane: usize,
) -> X {
    let mut state = X::zeros();
    for index in 0..state.length() {
        let number = all.element(index).lane(lane);
        state.set_element(index, number.unwrap_or(T::zero()));
    }
    for (place, number) in state.turns_mut().iter_mut().zip(all.turns()) {
        *place = number.lane(lane).unwrap_or(T::zero());
    }
    state
}
