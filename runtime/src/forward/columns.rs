//! Columns of a Jacobian by forward numbers.

use super::Forward;
use crate::math::scalar::increment;
use crate::math::scalar::{Real, Scalar};
use crate::state::vector::{Array, Vector};

/// The columns that one evaluation takes.
const LANES: usize = 4;

/// The numbers of such an evaluation.
pub(crate) type Lifted<S> = Forward<S, LANES>;

/// The same numbers, which depend on nothing.
pub(crate) fn lifted<S, const N: usize, A, B>(numbers: &A) -> B
where
    S: Scalar,
    A: Array<S>,
    B: Array<Forward<S, N>>,
{
    let mut lifted = B::zeros();
    let pairs = lifted.as_mut_slice().iter_mut().zip(numbers.as_slice());
    pairs.for_each(|(place, &number)| *place = Forward::fixed(number));
    lifted
}

/// The Jacobian of the rates by forward numbers, [`LANES`] columns by each evaluation; `like` is
/// any state of such numbers. `evaluate` is told which columns it takes. Returns how many there
/// were; `None` where one is not finite: there may be no derivative, and differences all the same.
///
/// A column is the derivative along [`Vector::plus`].
pub(crate) fn by_forward_numbers<S: Real, X: Vector<S>, Y: Vector<Lifted<S>>>(
    state: &X,
    like: &Y,
    columns: &mut X::Each<X>,
    mut evaluate: impl FnMut(&Y, &mut Y, &[usize]),
) -> Option<usize> {
    let length = state.length();
    let zeros = like.zip(like, |_, _| Forward::zero());
    let mut here = zeros.clone();
    for index in 0..length {
        here.set_element(index, Forward::fixed(state.element(index)));
    }
    let counted = here.turns_mut().iter_mut();
    for (place, &number) in counted.zip(state.turns()) {
        *place = Forward::fixed(number);
    }
    let mut rates = zeros.clone();
    let mut direction = zeros;
    let (mut next, mut whole) = (0, 0);
    while next < length {
        let mut taken = [0; LANES];
        let mut count = 0;
        while next < length && count < LANES {
            if state.is_independent(next) {
                let mut along = [S::zero(); LANES];
                along[count] = S::one();
                direction.set_element(next, Forward::new(S::zero(), along));
                taken[count] = next;
                count += 1;
            } else {
                columns[next] = state.zip(state, |_, _| S::zero());
            }
            next += 1;
        }
        let taken = &taken[..count];
        evaluate(
            &here.plus([(Forward::one(), &direction)]),
            &mut rates,
            taken,
        );
        let mut row = 0;
        rates.for_each(|rate| {
            for (&column, &slope) in taken.iter().zip(&rate.derivatives) {
                columns[column].set_element(row, slope);
            }
            row += 1;
        });
        for &column in taken {
            if !columns[column].is_finite() {
                return None;
            }
            direction.set_element(column, Forward::zero());
        }
        whole += count;
    }
    Some(whole)
}

/// Numbers at a state that only plain numbers give, as a closure does: their derivatives along some
/// columns by differences.
pub(crate) fn with_differences<S: Real, X: Vector<S>, A: Array<S>, B: Array<Lifted<S>>>(
    state: &X,
    columns: &[usize],
    numbers: &A,
    evaluate: impl Fn(&X) -> A,
) -> B {
    let mut lifted: B = lifted(numbers);
    let mut direction = state.zip(state, |_, _| S::zero());
    for (lane, &column) in columns.iter().enumerate() {
        let increment = increment(state.element(column));
        direction.set_element(column, increment);
        let there = evaluate(&state.plus([(S::one(), &direction)]));
        direction.set_element(column, S::zero());
        let places = lifted.as_mut_slice().iter_mut();
        let numbers = there.as_slice().iter().zip(numbers.as_slice());
        for (place, (&there, &here)) in places.zip(numbers) {
            if let Some(slope) = place.derivatives.get_mut(lane) {
                *slope = (there - here).quotient(increment);
            }
        }
    }
    lifted
}
