//! The Jacobian of the rates in joint coordinates, by the kernel that `kernels = [derivatives]`
//! asks for.

use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates, JointMotion, JointParts as _};
use crate::mechanism::kernels::Terms;
use crate::state::vector::{Array, Vector};

/// Whether the kernel has all of it: of coordinates that are angles and displacements, without
/// terms of a formulation where loops close.
const fn is_complete<M: JointCoordinates, T: Terms>() -> bool {
    let report = &M::JOINT_REPORT;
    M::DERIVED_BY.is_some()
        && (report.closing.is_empty() || !T::STABILISED && !T::COMPLIANT)
        && report.euler_parameters.is_empty()
        && report.auxiliaries == 0
}

/// The columns of a state, by elements.
type Columns<M, S> = <<M as JointCoordinates>::JointState<S> as Vector<S>>::Each<
    <M as JointCoordinates>::JointState<S>,
>;

/// Writes the columns. Whether it could: where the kernel is there and has all of them.
pub(super) fn written<M: JointCoordinates, S: Real, T: Terms>(
    constants: &M::JointConstants<S>,
    time: S,
    state: &M::JointState<S>,
    columns: &mut Columns<M, S>,
) -> bool {
    if const { !is_complete::<M, T>() } {
        return false;
    }
    let numbers = M::derivatives(constants, time, state);
    let numbers = numbers.as_slice();
    let (motions, states) = (M::JOINT_REPORT.motions, M::JOINT_REPORT.states);
    let (count, height) = (motions.len(), motions.len() + states.len());
    let nothing = state.zip(state, |_, _| S::zero());
    for element in 0..state.length() {
        columns[element] = nothing;
    }
    let (turns, first) = (2 * state.pairs_slice().len(), state.coordinate_count());
    let write = |column: &mut M::JointState<S>, shares: &mut dyn Iterator<Item = (usize, S)>| {
        let mut rates = M::JointVelocities::<S>::zeros();
        for (place, factor) in shares {
            let mut slopes = numbers.iter().skip(height * (1 + place));
            let places = rates.as_mut_slice().iter_mut().zip(&mut slopes);
            places.for_each(|(place, &slope)| *place = slope.fused(factor, *place));
            for (state, &slope) in states.iter().zip(slopes) {
                let place = turns + state.coordinate;
                column.set_element(place, slope.fused(factor, column.element(place)));
            }
        }
        let velocities = velocities::<M, S>(&rates);
        for (place, &acceleration) in velocities.as_slice().iter().enumerate() {
            column.set_element(first + place, acceleration);
        }
    };
    for (number, motion) in motions.iter().enumerate() {
        let coordinate = match motion.freedom {
            Freedom::Turn { .. } => 2 * motion.coordinate,
            _ => turns + motion.coordinate,
        };
        for (element, part) in [(coordinate, 0), (first + motion.velocity, count)] {
            let shares = shares::<S>(motions, number);
            let mut shares = shares.map(|(place, factor)| (part + place, factor));
            write(&mut columns[element], &mut shares);
        }
        columns[first + motion.velocity].set_element(coordinate, S::one());
    }
    for (number, state) in states.iter().enumerate() {
        let mut shares = core::iter::once((2 * count + number, S::one()));
        write(&mut columns[turns + state.coordinate], &mut shares);
    }
    true
}

/// The rates of joints that one coordinate, or one velocity, of a state is, with their factors:
/// those are sums along runs of parallel axes.
fn shares<S: Scalar>(
    motions: &'static [JointMotion],
    number: usize,
) -> impl Iterator<Item = (usize, S)> {
    let motions = motions.iter().enumerate();
    motions.filter_map(move |(other, motion)| {
        let factor = if other == number {
            S::one()
        } else if motion.against == Some(number) {
            -S::one()
        } else {
            return None;
        };
        Some((motion.velocity, signed(motion, factor)))
    })
}

/// The velocities of a state that are made of the rates of joints.
fn velocities<M: JointCoordinates, S: Scalar>(
    rates: &M::JointVelocities<S>,
) -> M::JointVelocities<S> {
    let motions = M::JOINT_REPORT.motions;
    let at = |numbers: &M::JointVelocities<S>, place: usize| {
        numbers.as_slice().get(place).copied().unwrap_or(S::zero())
    };
    let mut velocities = M::JointVelocities::<S>::zeros();
    // What carries a motion stands before it.
    for motion in motions {
        let own = signed(motion, at(rates, motion.velocity));
        let against = motion.against.and_then(|against| motions.get(against));
        let carried = against.map_or(S::zero(), |against| at(&velocities, against.velocity));
        if let Some(place) = velocities.as_mut_slice().get_mut(motion.velocity) {
            *place = own + carried;
        }
    }
    velocities
}

fn signed<S: Scalar>(motion: &JointMotion, value: S) -> S {
    if motion.is_reversed() { -value } else { value }
}
