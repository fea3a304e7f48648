//! How fast a mechanism moves, in radians.

use crate::constraints::rows::Rows;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::math::vec3::{read, write};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The lengths (m) by which bodies move in a radian.
pub(super) struct Pace<S: Scalar, M: Mechanism> {
    /// Of each body in the place of its first velocity.
    lengths: M::Velocities<S>,
    /// Velocities at the start.
    first: M::Velocities<S>,
}

impl<S: Scalar, M: Mechanism> Clone for Pace<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Pace<S, M> {}

impl<S: Real, M: Mechanism> Pace<S, M> {
    /// Of a mechanism of an extent (m) at the start of a run.
    pub(super) fn at(
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        extent: S,
    ) -> Self {
        let mut lengths = M::Velocities::<S>::zeros();
        let rows = Rows::<S, M>::at(constants, time, state);
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            // The rotation of a rigid body tells of it. A particle has none, and may be a small
            // part of a mechanism that is large.
            let length = match info.kind {
                BodyKind::Rigid => extent,
                BodyKind::Particle => rows.length_of(body).map_or(extent, |own| own.min(extent)),
            };
            write(lengths.as_mut_slice(), info.velocity, [length]);
        }
        Self {
            lengths,
            first: *state.velocities(),
        }
    }

    /// The length by which a body moves in a radian.
    pub(super) fn length_of(&self, body: usize) -> S {
        let place = M::REPORT.bodies.get(body).map_or(0, |info| info.velocity);
        let [length] = read(self.lengths.as_slice(), place);
        length
    }

    /// The rate of the fastest body (rad/s).
    pub(super) fn of(&self, state: &M::State<S>) -> S {
        let velocities = state.velocities().as_slice();
        let mut rate = S::zero();
        for body in M::REPORT.bodies {
            let speed = square(&read::<S, 3>(velocities, body.velocity)).sqrt();
            let [length] = read(self.lengths.as_slice(), body.velocity);
            rate = rate.max(speed.quotient(length));
            if body.kind == BodyKind::Rigid {
                let spin = square(&read::<S, 3>(velocities, body.velocity + 3));
                rate = rate.max(spin.sqrt());
            }
        }
        rate
    }

    /// By how much the rate of a body is another than at the start, at the most (rad/s): of rigid
    /// bodies the size, for a steady turn changes directions; of particles the vector.
    pub(super) fn change(&self, state: &M::State<S>) -> S {
        let (now, first) = (state.velocities().as_slice(), self.first.as_slice());
        let size = |velocities: &[S], place| square(&read::<S, 3>(velocities, place)).sqrt();
        let mut change = S::zero();
        for body in M::REPORT.bodies {
            let place = body.velocity;
            let [length] = read(self.lengths.as_slice(), place);
            let linear = match body.kind {
                BodyKind::Rigid => {
                    let spin = size(now, place + 3) - size(first, place + 3);
                    change = change.max(spin.abs());
                    (size(now, place) - size(first, place)).abs()
                }
                BodyKind::Particle => {
                    let [now, first]: [[S; 3]; 2] = [read(now, place), read(first, place)];
                    let [x, y, z] = now;
                    let [a, b, c] = first;
                    square(&[x - a, y - b, z - c]).sqrt()
                }
            };
            change = change.max(linear.quotient(length));
        }
        change
    }
}
