//! The Jacobian of the rates in joint coordinates, by the kernel that `kernels = [derivatives]`
//! asks for.

use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates, JointMotion, JointParts as _};
use crate::state::vector::{Array, Vector};

/// Whether the kernel has all of it: of a tree whose coordinates are angles and displacements.
const fn is_complete<M: JointCoordinates>() -> bool {
    let report = &M::JOINT_REPORT;
    M::DERIVED_BY.is_some()
        && report.closing.is_empty()
        && report.euler_parameters.is_empty()
        && report.auxiliaries == 0
        && report.states.is_empty()
}

/// The columns of a state, by elements.
type Columns<M, S> = <<M as JointCoordinates>::JointState<S> as Vector<S>>::Each<
    <M as JointCoordinates>::JointState<S>,
>;

/// Writes the columns. Whether it could: where the kernel is there and has all of them.
pub(super) fn written<M: JointCoordinates, S: Real>(
    constants: &M::JointConstants<S>,
    time: S,
    state: &M::JointState<S>,
    columns: &mut Columns<M, S>,
) -> bool {
    if const { !is_complete::<M>() } {
        return false;
    }
    let numbers = M::derivatives(constants, time, state);
    let numbers = numbers.as_slice();
    let count = M::JOINT_REPORT.motions.len();
    let nothing = state.zip(state, |_, _| S::zero());
    for element in 0..state.length() {
        columns[element] = nothing;
    }
    let (turns, first) = (2 * state.pairs_slice().len(), state.coordinate_count());
    for (number, motion) in M::JOINT_REPORT.motions.iter().enumerate() {
        let coordinate = match motion.freedom {
            Freedom::Turn { .. } => 2 * motion.coordinate,
            _ => turns + motion.coordinate,
        };
        for (element, part) in [(coordinate, 0), (first + motion.velocity, count)] {
            let accelerations = along::<M, S>(numbers, number, part);
            let column = &mut columns[element];
            for (place, &acceleration) in accelerations.as_slice().iter().enumerate() {
                column.set_element(first + place, acceleration);
            }
        }
        columns[first + motion.velocity].set_element(coordinate, S::one());
    }
    true
}

/// The rates of the velocities of a state along one of its coordinates, or of its velocities. Both
/// are sums along runs of parallel axes, while the kernel has those of joints.
fn along<M: JointCoordinates, S: Scalar>(
    numbers: &[S],
    number: usize,
    part: usize,
) -> M::JointVelocities<S> {
    let motions = M::JOINT_REPORT.motions;
    let count = motions.len();
    let signed = |motion: &JointMotion, value: S| {
        if motion.is_reversed() { -value } else { value }
    };
    let mut sum = M::JointVelocities::<S>::zeros();
    for (other, motion) in motions.iter().enumerate() {
        let factor = if other == number {
            S::one()
        } else if motion.against == Some(number) {
            -S::one()
        } else {
            continue;
        };
        let factor = signed(motion, factor);
        let column = numbers.iter().skip(count * (1 + part + motion.velocity));
        let places = sum.as_mut_slice().iter_mut().zip(column);
        places.for_each(|(place, &entry)| *place = entry.fused(factor, *place));
    }
    let mut velocities = M::JointVelocities::<S>::zeros();
    let at = |numbers: &M::JointVelocities<S>, place: usize| {
        numbers.as_slice().get(place).copied().unwrap_or(S::zero())
    };
    // What carries a motion stands before it.
    for motion in motions {
        let own = signed(motion, at(&sum, motion.velocity));
        let against = motion.against.and_then(|against| motions.get(against));
        let carried = against.map_or(S::zero(), |against| at(&velocities, against.velocity));
        if let Some(place) = velocities.as_mut_slice().get_mut(motion.velocity) {
            *place = own + carried;
        }
    }
    velocities
}
