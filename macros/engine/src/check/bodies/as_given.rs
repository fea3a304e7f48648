//! Masses and inertias that no body has, taken as they are given.

use super::reader::AS_GIVEN;
use crate::diag::{Faults, list};
use crate::model::{Body, Coordinates, Model};

/// Refuses bodies whose mass or moments are not positive where the equations of the bodies are
/// solved.
pub(in crate::check) fn coordinates(
    bodies: &[Option<Body>],
    coordinates: Coordinates,
    faults: &mut Faults,
) {
    if coordinates == Coordinates::Joints {
        return;
    }
    for body in bodies.iter().flatten().filter(|body| !body.has_inertia()) {
        let name = &body.name;
        faults.at_name(
            name,
            format!(
                "`{name}` is `{AS_GIVEN}` and has a mass or a moment of inertia that is not positive: such a body has no equations of \
                 its own; write `#[mechanism(coordinates = \"joints\")]`"
            ),
        );
    }
}

/// Refuses bodies that are as given where a motion of the whole has no kinetic energy by them.
/// `definite` says whether all motions have, as far as it is known.
pub fn judged(model: &Model, definite: Option<bool>, faults: &mut Faults) {
    if definite == Some(true) {
        return;
    }
    let given = || model.bodies.iter().filter(|body| body.as_given);
    let names = list(given().map(|body| &body.name));
    let Some(first) = given().next() else { return };
    let (found, instead) = match definite {
        Some(_) => (
            "the mass matrix of the mechanism is not positive definite",
            "; a motion without kinetic energy, or with a negative one, follows from no forces",
        ),
        None => (
            "the macro cannot see whether the mass matrix of the mechanism is positive definite",
            "; give numbers, or `#[param(like = ..)]`",
        ),
    };
    faults.at_name(
        &first.name,
        format!("with {names} `{AS_GIVEN}`, {found}{instead}"),
    );
}
