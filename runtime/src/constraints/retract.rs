//! Motion of a state by a finite displacement.

use crate::math::quaternion::{from_rotation_vector, normalised, product};
use crate::math::scalar::Real;
use crate::math::vec3::{read, times, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The state moved by `factor d`: positions by addition, orientations by a rotation along body
/// axes; angles that count turns follow.
pub(crate) fn displaced<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    step: &M::Velocities<S>,
    factor: S,
) -> M::State<S> {
    let mut moved = *state;
    if M::REPORT.auxiliaries > 0 {
        let along = M::State::from_parts(*state.coordinates(), *step);
        advance_auxiliaries::<S, M>(constants, &along, factor, &mut moved);
    }
    let coordinates = moved.coordinates_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        let scaled = |place| times(&read::<S, 3>(step.as_slice(), place), factor);
        let [x, y, z] = read(coordinates, body.coordinate);
        let [dx, dy, dz] = scaled(body.velocity);
        write(coordinates, body.coordinate, [x + dx, y + dy, z + dz]);
        if body.kind == BodyKind::Rigid {
            let turn = from_rotation_vector(&scaled(body.velocity + 3));
            let p = product(&read(coordinates, body.coordinate + 3), &turn);
            write(coordinates, body.coordinate + 3, normalised(&p));
        }
    }
    M::rewrap(constants, &mut moved);
    moved
}

/// Moves the auxiliary variables by `factor` times their rates in another state: without it, a turn
/// by more than half a revolution would be counted as one the other way.
fn advance_auxiliaries<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    along: &M::State<S>,
    factor: S,
    moved: &mut M::State<S>,
) {
    let rates = M::coordinate_rates(constants, along);
    let coordinates = moved.coordinates_mut().as_mut_slice();
    let places = coordinates.iter_mut().zip(rates.as_slice());
    for (auxiliary, &rate) in places.skip(M::REPORT.coordinates) {
        *auxiliary = rate.fused(factor, *auxiliary);
    }
}

/// The state after a time, at constant accelerations: to second order in the time.
pub(crate) fn advanced<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    accelerations: &M::Velocities<S>,
    time: S,
) -> M::State<S> {
    let after = |time: S| {
        let mut velocities = *state.velocities();
        let places = velocities.as_mut_slice().iter_mut();
        for (velocity, &acceleration) in places.zip(accelerations.as_slice()) {
            *velocity = acceleration.fused(time, *velocity);
        }
        velocities
    };
    let mut moved = displaced::<S, M>(constants, state, &after(S::constant(0.5) * time), time);
    *moved.velocities_mut() = after(time);
    moved
}
