//! What a step control allows of the errors of derivatives.
//!
//! As CVODES has it (Serban and Hindmarsh, *CVODES: the sensitivity-enabled ODE solver in
//! SUNDIALS*, 2005): a derivative is held to the relative tolerance of values, and to their
//! absolute one over the scale of its direction, a change that counts. Two things are added. A
//! scale is at most one over the largest derivative, so that where a parameter is far from what it
//! is to be, as a stiff spring that an input stretches, its derivatives keep their digits. And
//! errors of round-off are none: where what counts cancels, a control would make steps shorter in
//! vain.

use core::array::from_fn;

use super::Forward;
use crate::math::scalar::Real;
use crate::state::sums::greater;

/// How many units of round-off of the largest derivative the error of one may be made of. So many
/// of an element is the least relative tolerance of a control.
const ROUND_OFF: f64 = 100.0;

/// The largest share of [`Real::largest_share`], of values and of derivatives. The derivatives of
/// the floor are the floors of derivatives; zero counts as that of values.
pub(super) fn largest<S: Real, const N: usize>(
    elements: impl Iterator<Item = [Forward<S, N>; 3]> + Clone,
    floor: Forward<S, N>,
) -> S {
    let mut sizes = [S::zero(); N];
    for number in elements.clone().flatten() {
        for (size, slope) in sizes.iter_mut().zip(number.derivatives) {
            *size = greater(*size, slope.abs());
        }
    }
    let allowed: [_; N] = from_fn(|k| Allowed::of(floor, k, sizes[k]));
    elements.fold(S::zero(), |most, [increment, x, y]| {
        let scale = x.value.abs().max(y.value.abs()).max(floor.value);
        let most = most.max(increment.value.abs().quotient(scale));
        allowed.iter().enumerate().fold(most, |most, (k, allowed)| {
            let slopes = [increment, x, y].map(|number| number.derivatives[k]);
            most.max(allowed.share(slopes))
        })
    })
}

/// What is allowed along a direction.
struct Allowed<S> {
    /// What counts as round-off.
    round_off: S,
    /// The derivative below which the absolute tolerance counts.
    floor: S,
}

impl<S: Real> Allowed<S> {
    /// Along a direction, with the largest derivative of an element.
    fn of<const N: usize>(floor: Forward<S, N>, direction: usize, size: S) -> Self {
        let own = floor.derivatives[direction];
        // One over the scale of the direction.
        let unit = if own > S::zero() {
            own.quotient(floor.value)
        } else {
            S::one()
        };
        Self {
            round_off: S::constant(ROUND_OFF) * S::EPSILON * greater(size, unit),
            floor: floor.value * unit.min(size),
        }
    }

    fn share(&self, [increment, x, y]: [S; 3]) -> S {
        let error = increment.abs();
        if error <= S::zero() {
            return error;
        }
        // Next to nothing, but more where the error is more: orders are chosen by it.
        let hardly = error * S::EPSILON * S::EPSILON;
        let beyond = hardly.max(error - self.round_off);
        beyond.quotient(x.abs().max(y.abs()).max(self.floor))
    }
}
