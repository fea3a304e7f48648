//! The Euler parameters of all bodies of a state.

use crate::error::StepFault;
use crate::math::quaternion::{length, normalised, scale, to_unit_length};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{read, square, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts, Vector};

/// Refuses a state that holds a number that is not finite, or Euler parameters that are zero.
pub(crate) fn check_state<S: Real, M: Mechanism>(state: &M::State<S>) -> Result<(), StepFault> {
    if !state.is_finite() {
        return Err(StepFault::StateNotFinite);
    }
    let coordinates = state.coordinates().as_slice();
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let p: [S; 4] = read(coordinates, body.coordinate + 3);
            if square(&p) == S::zero() {
                return Err(StepFault::ZeroOrientation { body: body.name });
            }
        }
    }
    Ok(())
}

/// The state with the Euler parameters of every body scaled to length 1.
pub(crate) fn with_unit_orientations<S: Scalar, M: Mechanism>(state: &M::State<S>) -> M::State<S> {
    let mut unit = *state;
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let slice = unit.coordinates_mut().as_mut_slice();
            let p = normalised(&read(slice, place));
            write(slice, place, p);
        }
    }
    unit
}

/// Scales the Euler parameters of every body to length 1, and their rates, which are linear in
/// them, by the same factors. Returns the largest `| |p| - 1 |` that they had.
#[inline]
pub(crate) fn bring_to_unit_length<S: Real, M: Mechanism>(
    state: &mut M::State<S>,
    mut rates: Option<&mut M::State<S>>,
) -> S {
    let mut norm_drift = S::zero();
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let p: [S; 4] = read(state.coordinates().as_slice(), place);
            let (off, factor) = to_unit_length(&p);
            norm_drift = norm_drift.max(off);
            let Some(factor) = factor else { continue };
            scale(state.coordinates_mut().as_mut_slice(), place, factor);
            if let Some(rates) = rates.as_deref_mut() {
                scale(rates.coordinates_mut().as_mut_slice(), place, factor);
            }
        }
    }
    norm_drift
}

/// The largest `| |p| - 1 |` of the Euler parameters of a state.
pub(crate) fn norm_drift<S: Real, M: Mechanism>(state: &M::State<S>) -> S {
    let rigid = M::REPORT.bodies.iter();
    let rigid = rigid.filter(|body| body.kind == BodyKind::Rigid);
    let lengths = rigid.map(|body| {
        let p: [S; 4] = read(state.coordinates().as_slice(), body.coordinate + 3);
        length(&p)
    });
    lengths.fold(S::zero(), |most, length| {
        most.max((length - S::one()).abs())
    })
}

/// Multiplies the rates `1/2 L(p)^T w` of Euler parameters by a function of their length in a
/// state: they are linear in `p`.
#[inline]
pub(crate) fn scale_euler_rates<S: Scalar, M: Mechanism>(
    rates: &mut <M::State<S> as StateParts<S>>::Coordinates,
    state: &M::State<S>,
    factor: impl Fn(S) -> S,
) {
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let p: [S; 4] = read(state.coordinates().as_slice(), place);
            scale(rates.as_mut_slice(), place, factor(length(&p)));
        }
    }
}
