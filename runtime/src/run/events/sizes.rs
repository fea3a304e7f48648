//! What counts as nothing beside a reading or a motion, with the size that each is a part of.
//!
//! A reading has any unit. So its round-off is seen: by what it changes where every number of the
//! state is changed in its last digits. A little of a motion is a part of the length of the
//! mechanism, of a radian, or of the time in which it goes that far.

use crate::constraints::extent::{extent, farthest, largest};
use crate::constraints::row_units::characteristic_length;
use crate::math::scalar::Real;
use crate::math::vec3::{norm, read};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// A reading below so many times its round-off is at zero, at a start and after a handler.
const AT_ZERO: f64 = 8.0;

/// The part of a length, or of a radian, by which a motion is looked at ahead; at least so many
/// `EPSILON` of it.
const AHEAD: [f64; 2] = [1e-6, 1e3];

/// A state of the user's own may change by this part of itself, or of what it gains in a step.
pub(super) fn ahead<S: Real>() -> S {
    let [part, digits] = AHEAD.map(S::constant);
    part.max(digits * S::EPSILON)
}

/// Down to where a reading is at zero, from what it is here and where all numbers are changed in
/// their last digits, one way and the other. A jump between both is no round-off.
pub(super) fn round_off<S: Real>(here: S, beside: [S; 2]) -> S {
    let [one, other] = beside.map(|reading| (reading - here).abs());
    let change = one.min(other);
    let digits = S::constant(AT_ZERO) * change;
    if digits.is_finite() {
        digits.max(S::smallest())
    } else {
        S::smallest()
    }
}

/// A time and a state with every number changed in its last digits, by as much as the largest of
/// its kind lets it, and without a pattern that a mechanism could share; `way` is 1 or -1. A
/// position near zero is a sum of lengths.
pub(super) fn shaken<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
    way: f64,
) -> (S, M::State<S>) {
    let mut shaken = *state;
    let coordinates = state.coordinates().as_slice();
    let velocities = state.velocities().as_slice();
    let (mut speed, mut spin) = (S::zero(), S::zero());
    for body in M::REPORT.bodies {
        speed = speed.max(largest(&read::<S, 3>(velocities, body.velocity)));
        if body.kind == BodyKind::Rigid {
            spin = spin.max(largest(&read::<S, 3>(velocities, body.velocity + 3)));
        }
    }
    let extent = extent::<S, M>(constants, state);
    let position = extent.max(farthest(M::REPORT.bodies, coordinates));
    let speed = speed.max(spin * extent);
    let places = shaken.coordinates_mut().as_mut_slice();
    for (place, x) in places.iter_mut().enumerate() {
        let size = M::REPORT.bodies.iter().find_map(|body| match body.kind {
            _ if (body.coordinate..body.coordinate + 3).contains(&place) => Some(position),
            BodyKind::Rigid if (body.coordinate + 3..body.coordinate + 7).contains(&place) => {
                Some(S::constant(0.5))
            }
            _ => None,
        });
        *x = changed(*x, size.unwrap_or(S::zero()), place, way);
    }
    let places = shaken.velocities_mut().as_mut_slice();
    for (place, x) in places.iter_mut().enumerate() {
        let size = M::REPORT.bodies.iter().find_map(|body| match body.kind {
            _ if (body.velocity..body.velocity + 3).contains(&place) => Some(speed),
            BodyKind::Rigid if (body.velocity + 3..body.velocity + 6).contains(&place) => {
                Some(spin)
            }
            _ => None,
        });
        *x = changed(*x, size.unwrap_or(S::zero()), place + 1, way);
    }
    (time + S::constant(way) * time.ulp(), shaken)
}

/// A number with a half to one and a half `EPSILON` of a size more or less.
fn changed<S: Real>(x: S, size: S, place: usize, way: f64) -> S {
    // Multiples of the golden section: neither signs nor sizes repeat.
    let golden = (place + 1) as f64 * 0.618_033_988_749_895 % 1.0;
    let part = if golden < 0.5 {
        golden + 0.5
    } else {
        -golden - 0.5
    };
    S::constant(way * part).fused(S::EPSILON * x.abs().max(size), x)
}

/// The rate (1/s) at which bodies turn by a radian or go the length of the mechanism, by their
/// velocities and by their accelerations, and at which a state of the user's own goes as far as it
/// is from zero, or as it gets in a time (s).
pub(super) fn rate<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (state, rates): (&M::State<S>, &M::State<S>),
    longest: S,
) -> S {
    let length = characteristic_length::<S, M>(constants, state);
    let turning = |velocities: &M::Velocities<S>| {
        let velocities = velocities.as_slice();
        M::REPORT.bodies.iter().fold(S::zero(), |most, body| {
            let most = most.max(norm(&read::<S, 3>(velocities, body.velocity)).quotient(length));
            match body.kind {
                BodyKind::Rigid => most.max(norm(&read::<S, 3>(velocities, body.velocity + 3))),
                BodyKind::Particle => most,
            }
        })
    };
    let by_motion = turning(state.velocities()).max(turning(rates.velocities()).sqrt());
    M::REPORT.states.iter().fold(by_motion, |most, info| {
        let [x] = read::<S, 1>(state.coordinates().as_slice(), info.coordinate);
        let [rate] = read::<S, 1>(rates.coordinates().as_slice(), info.coordinate);
        let size = x.abs().max(rate.abs() * longest);
        if size > S::zero() {
            most.max(rate.abs().quotient(size))
        } else {
            most
        }
    })
}
