//! Whether the derivatives of a start are those of states that satisfy the constraints.

use core::iter::zip;

use crate::error::{Fault, StartFault};
use crate::forward::Forward;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// What is left of the derivative of a constraint over the sizes of its terms: half of the digits
/// of `f64`, which a start by somebody else's numbers has.
const INEXACT: f64 = 1e-7;

/// How many digits a sum of products loses at most, in units of round-off.
const ROUND_OFF: f64 = 1e3;

/// Refuses a start along which a joint opens, by the joint and the number of the direction.
pub(super) fn check_derivatives<M: Mechanism, const K: usize, S: Real>(
    constants: &M::Constants<Forward<S, K>>,
    time: Forward<S, K>,
    state: &M::State<Forward<S, K>>,
) -> Result<(), Fault> {
    for constraints in [M::constraints, M::constraint_rates] {
        let whole = constraints(constants, time, state);
        let mut standing =
            M::State::from_parts(plain(state.coordinates()), plain(state.velocities()));
        // By the parameters, and by every number of the state alone: what a joint leaves free, it
        // leaves free by terms that cancel each other.
        let mut sizes = sizes_of(&constraints(constants, time, &standing));
        let fixed: M::Constants<Forward<S, K>> = plain(constants);
        for (place, number) in state.coordinates().as_slice().iter().enumerate() {
            replace(standing.coordinates_mut().as_mut_slice(), place, *number);
            add(&mut sizes, &constraints(&fixed, time, &standing));
            replace(
                standing.coordinates_mut().as_mut_slice(),
                place,
                number.plain(),
            );
        }
        for (place, number) in state.velocities().as_slice().iter().enumerate() {
            replace(standing.velocities_mut().as_mut_slice(), place, *number);
            add(&mut sizes, &constraints(&fixed, time, &standing));
            replace(
                standing.velocities_mut().as_mut_slice(),
                place,
                number.plain(),
            );
        }
        // Terms that vanish do so to round-off of the numbers that they are products of.
        let numbers = || {
            let velocities = state.velocities().as_slice();
            state.coordinates().as_slice().iter().chain(velocities)
        };
        let largest = numbers().fold(S::one(), |most, number| most.max(number.value().abs()));
        let fastest = |direction: usize| {
            let all = numbers().chain(constants.as_slice());
            let slopes = all.filter_map(|number| number.derivatives().get(direction).copied());
            slopes.fold(S::zero(), |most, slope| most.max(slope.abs()))
        };
        for (row, (whole, size)) in whole.as_slice().iter().zip(sizes.as_slice()).enumerate() {
            for (direction, (slope, size)) in
                zip(whole.derivatives(), size.derivatives()).enumerate()
            {
                let floor = S::constant(ROUND_OFF) * S::EPSILON * largest * fastest(direction);
                let is_closed = slope.abs() <= S::constant(INEXACT).fused(size, floor);
                // NaN is refused, too.
                if !is_closed {
                    return Err(Fault::Start(StartFault::DirectionOpens {
                        joint: M::REPORT.joint_of(row).unwrap_or_default(),
                        direction,
                        violation: slope.to_f64(),
                    }));
                }
            }
        }
    }
    Ok(())
}

/// Numbers whose derivatives are the sizes of those of others.
fn sizes_of<S: Real, const K: usize, A: Array<Forward<S, K>>>(numbers: &A) -> A {
    let mut sizes = A::zeros();
    add(&mut sizes, numbers);
    sizes
}

/// Adds the sizes of derivatives.
fn add<S: Real, const K: usize, A: Array<Forward<S, K>>>(sizes: &mut A, numbers: &A) {
    for (size, number) in zip(sizes.as_mut_slice(), numbers.as_slice()) {
        *size = *size + Forward::new(S::zero(), number.derivatives().map(S::abs));
    }
}

fn replace<S>(numbers: &mut [S], place: usize, number: S) {
    if let Some(found) = numbers.get_mut(place) {
        *found = number;
    }
}

/// The same numbers, which depend on nothing.
fn plain<S: Real, const K: usize, A: Array<Forward<S, K>>>(numbers: &A) -> A {
    let mut plain = A::zeros();
    for (place, number) in zip(plain.as_mut_slice(), numbers.as_slice()) {
        *place = number.plain();
    }
    plain
}
