//! How far two states of a mechanism are apart, and how far a displacement leads.

use crate::math::quaternion::{conjugate, normalised, product};
use crate::math::scalar::Real;
use crate::math::vec3::norm;
use crate::math::vec3::{minus, read};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The largest movement of a body: radians, and lengths (m).
#[derive(Clone, Copy)]
pub(crate) struct Apart<S> {
    /// Radians, or lengths of the mechanism, whichever is more.
    pub(crate) size: S,
    /// The place of that body.
    pub(crate) body: usize,
    /// Its rotation (rad).
    pub(crate) angle: S,
    /// The movement of its centre of mass (m).
    pub(crate) length: S,
}

/// Of two states: the body that stands furthest from where it stands in the other one.
pub(crate) fn apart<S: Real, M: Mechanism>(
    from: &M::State<S>,
    to: &M::State<S>,
    length: S,
) -> Apart<S> {
    let (a, b) = (from.coordinates().as_slice(), to.coordinates().as_slice());
    farthest::<S, M>(length, |body| {
        let place = M::REPORT.bodies.get(body).map_or(0, |info| info.coordinate);
        let moved = norm(&minus(&read(b, place), &read(a, place)));
        let (p, q) = (read(a, place + 3), read(b, place + 3));
        (moved, angle_between(&p, &q))
    })
}

/// The largest change (rad) of an angle that counts turns: a whole turn leads to where it began.
pub(crate) fn counted_apart<S: Real, M: Mechanism>(from: &M::State<S>, to: &M::State<S>) -> S {
    let angles = |state: &M::State<S>| *state.coordinates();
    let (from, to) = (angles(from), angles(to));
    let pairs = from.as_slice().iter().zip(to.as_slice());
    let pairs = pairs.skip(M::REPORT.coordinates);
    let changes = pairs.take(M::REPORT.auxiliaries);
    changes.fold(S::zero(), |most, (&a, &b)| most.max((b - a).abs()))
}

/// The same of a displacement, or of velocities, of all bodies.
pub(crate) fn reach<S: Real, M: Mechanism>(step: &M::Velocities<S>, length: S) -> Apart<S> {
    let step = step.as_slice();
    farthest::<S, M>(length, |body| {
        let place = M::REPORT.bodies.get(body).map_or(0, |info| info.velocity);
        let moved = norm(&read::<S, 3>(step, place));
        (moved, norm(&read::<S, 3>(step, place + 3)))
    })
}

fn farthest<S: Real, M: Mechanism>(length: S, movement: impl Fn(usize) -> (S, S)) -> Apart<S> {
    let mut most = Apart {
        size: S::zero(),
        body: 0,
        angle: S::zero(),
        length: S::zero(),
    };
    for (body, info) in M::REPORT.bodies.iter().enumerate() {
        let (moved, turned) = movement(body);
        let angle = match info.kind {
            BodyKind::Rigid => turned,
            BodyKind::Particle => S::zero(),
        };
        let size = angle.max(moved.quotient(length));
        // What is no number is farther than anything.
        let is_less = size <= most.size;
        if !is_less {
            most = Apart {
                size,
                body,
                angle,
                length: moved,
            };
        }
    }
    most
}

/// The angle (rad, at most half a turn) of the rotation between two orientations.
pub(crate) fn angle_between<S: Real>(p: &[S; 4], q: &[S; 4]) -> S {
    let [e0, e1, e2, e3] = product(&conjugate(&normalised(p)), &normalised(q));
    let sine = norm(&[e1, e2, e3]);
    S::constant(2.0) * sine.atan2(e0.abs())
}
