//! On which side of its equations a joint is.

use crate::constraints::frames::{axes_of, carrier_of, point_of};
use crate::error::AssemblyFault;
use crate::math::quaternion::{conjugate, from_rotation_vector, normalised, product, rotate};
use crate::math::scalar::Real;
use crate::math::vec3::norm;
use crate::math::vec3::{minus, over, read, times, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// Refuses a state in which a joint is on a side that is not meant.
pub(crate) fn check_sides<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
) -> Result<(), AssemblyFault> {
    match wrong::<S, M>(constants, state, 0) {
        None => Ok(()),
        Some(joint) => Err(AssemblyFault::WrongSide {
            joint: M::REPORT.joints.get(joint).map_or("", |info| info.name),
        }),
    }
}

/// The first joint, from one on, that is on a side that is not meant. Round-off tells no side.
pub(crate) fn wrong<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    from: usize,
) -> Option<usize> {
    let is_wrong = |&joint: &usize| M::joint_side(constants, state, joint) < -S::EPSILON.sqrt();
    (from..M::REPORT.joints.len()).find(is_wrong)
}

/// The state with what joints carry turned over, where these are not well on the side that is
/// meant; as in another state, where no turn about an axis leads over.
pub(crate) fn righted<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    from: &M::State<S>,
) -> M::State<S> {
    /// From here on a correction may lead to the other side.
    const UNDECIDED: f64 = 0.5;
    let mut state = *state;
    for joint in 0..M::REPORT.joints.len() {
        let side = |state: &M::State<S>| M::joint_side(constants, state, joint);
        let wanted = (S::constant(UNDECIDED) * side(from)).max(S::zero());
        if side(&state) > wanted {
            continue;
        }
        let Some(body) = moved_by::<M>(joint) else {
            continue;
        };
        state = turned_over::<S, M>(constants, state, joint, body);
        // Where several vectors are wrong at once, that may end on a ridge.
        if side(&state) <= wanted {
            let rotation = back::<S, M>(&state, from, body);
            state = turned::<S, M>(constants, &state, (joint, body), &rotation);
        }
    }
    state
}

/// The body that a joint carries; the last one of a joint that carries none.
fn moved_by<M: Mechanism>(joint: usize) -> Option<usize> {
    let mut carriers = M::REPORT.carriers.iter();
    let carried = carriers.position(|carrier| carrier.joint == Some(joint));
    let bodies = M::REPORT
        .joints
        .get(joint)
        .map_or(&[][..], |info| info.bodies);
    carried.or_else(|| bodies.iter().rev().copied().flatten().next())
}

/// The rotation (global) that lets a body stand against what carries it as in another state.
fn back<S: Real, M: Mechanism>(state: &M::State<S>, from: &M::State<S>, body: usize) -> [S; 4] {
    let base = |state| axes_of::<S, M>(state, carrier_of::<M>(body));
    let own = |state| axes_of::<S, M>(state, Some(body));
    let relative = product(&conjugate(&base(from)), &own(from));
    product(&product(&base(state), &relative), &conjugate(&own(state)))
}

/// Turns what hangs on a joint up the gradient of its side.
fn turned_over<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    mut state: M::State<S>,
    joint: usize,
    body: usize,
) -> M::State<S> {
    /// Turns, and the angle (rad) of the first ones.
    const TURNS: usize = 60;
    const TURN: f64 = 0.25;
    /// A turn that is less leads to the top as well as none.
    const LEAST: f64 = 1e-3;
    let side = |state: &M::State<S>| M::joint_side(constants, state, joint);
    let by = |state: &M::State<S>, vector: &[S; 3]| {
        let rotation = from_rotation_vector(vector);
        turned::<S, M>(constants, state, (joint, body), &rotation)
    };
    let trial = S::EPSILON.sqrt().sqrt();
    let mut turn = S::constant(TURN);
    for _ in 0..TURNS {
        let now = side(&state);
        let along = |k: usize| {
            let shifted = |size: S| {
                let mut vector = [S::zero(); 3];
                write(&mut vector, k, [size]);
                side(&by(&state, &vector))
            };
            shifted(trial) - shifted(-trial)
        };
        let gradient = [along(0), along(1), along(2)];
        let size = norm(&gradient);
        let is_steep = size > trial * trial;
        if turn < S::constant(LEAST) || !is_steep && now > S::zero() {
            break;
        }
        let direction = if is_steep {
            over(&gradient, size)
        } else {
            // At its lowest a side has no gradient: any way may lead up.
            [0.6, -0.6, 0.5].map(S::constant)
        };
        let next = by(&state, &times(&direction, turn));
        if !is_steep || side(&next) > now {
            state = next;
        } else {
            turn = turn * S::constant(0.5);
        }
    }
    state
}

/// The state with all that hangs on a joint turned about its point (global Euler parameters).
fn turned<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
    (joint, carried): (usize, usize),
    rotation: &[S; 4],
) -> M::State<S> {
    let point = point_of::<S, M>(constants, state, joint, carried);
    let mut moved = *state;
    for (place, body) in M::REPORT.bodies.iter().enumerate() {
        if !hangs::<M>(place, carried) {
            continue;
        }
        let coordinates = moved.coordinates_mut().as_mut_slice();
        let [x, y, z] = rotate(
            rotation,
            &minus(&read(coordinates, body.coordinate), &point),
        );
        let [a, b, c] = point;
        write(coordinates, body.coordinate, [a + x, b + y, c + z]);
        if body.kind == BodyKind::Rigid {
            let p = product(rotation, &read(coordinates, body.coordinate + 3));
            write(coordinates, body.coordinate + 3, normalised(&p));
        }
    }
    M::rewrap(constants, &mut moved);
    moved
}

/// Whether a body is another one, or hangs on it in the spanning tree.
fn hangs<M: Mechanism>(body: usize, on: usize) -> bool {
    let mut place = Some(body);
    // No way is longer than there are bodies.
    for _ in M::REPORT.bodies {
        match place {
            Some(found) if found == on => return true,
            Some(found) => {
                let carrier = M::REPORT.carriers.get(found);
                place = carrier.and_then(|carrier| carrier.body);
            }
            None => return false,
        }
    }
    false
}
