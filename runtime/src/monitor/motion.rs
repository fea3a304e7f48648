//! How fast a mechanism moves, in radians.

use crate::constraints::row_units::characteristic_length;
use crate::constraints::rows::Rows;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::math::vec3::{read, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// The lengths (m) by which bodies move in a radian.
pub(super) struct MotionMeasure<S: Scalar, M: Mechanism> {
    /// Of each body in the place of its first velocity; in that of the second what the square of a
    /// speed is to be multiplied by (1/m^2).
    lengths: M::Velocities<S>,
    /// Velocities at the start.
    first: M::Velocities<S>,
}

/// How bodies move at the end of a step, and have moved until then.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<S> {
    /// The rate of the fastest body (rad/s).
    pub(super) rate: S,
    /// The squares of the largest speed (m^2/s^2) and angular velocity (rad^2/s^2).
    pub(super) speed: S,
    pub(super) spin: S,
    /// Radians of motion of the step, and of the run so far.
    pub(super) turned: S,
    pub(super) travel: S,
    /// The place of the velocity of the body whose translation is fastest; `None` where a rotation
    /// is faster.
    pub(super) translation: Option<usize>,
}

copied!([S: Scalar, M: Mechanism] MotionMeasure<S, M>);

impl<S: Real, M: Mechanism> MotionMeasure<S, M> {
    /// Of a mechanism of an extent (m), with its rows at the start of a run.
    pub(super) fn at(rows: &Rows<S, M>, state: &M::State<S>, extent: S) -> Self {
        let mut lengths = M::Velocities::<S>::zeros();
        for (body, info) in M::REPORT.bodies.iter().enumerate() {
            // The rotation of a rigid body tells of it. A particle has none, and may be a small
            // part of a mechanism that is large.
            let length = match info.kind {
                BodyKind::Rigid => extent,
                BodyKind::Particle => rows.length_of(body).map_or(extent, |own| own.min(extent)),
            };
            let factor = (length * length).reciprocal();
            write(lengths.as_mut_slice(), info.velocity, [length, factor]);
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
        let ([rate, ..], _) = self.rates(state);
        rate
    }

    /// The rate of the fastest body (rad/s), and the squares of the largest speed (m^2/s^2) and
    /// angular velocity (rad^2/s^2), with the place of the velocity of the fastest translation, if
    /// no rotation is faster. Squares are compared, so that there is one root.
    #[inline]
    pub(super) fn rates(&self, state: &M::State<S>) -> ([S; 3], Option<usize>) {
        let velocities = state.velocities().as_slice();
        let (mut rate, mut speed, mut spin) = (S::zero(), S::zero(), S::zero());
        let mut fastest = 0;
        for body in M::REPORT.bodies {
            let here = square(&read::<S, 3>(velocities, body.velocity));
            let [_, factor] = read(self.lengths.as_slice(), body.velocity);
            speed = speed.max(here);
            let here = here * factor;
            if here > rate {
                fastest = body.velocity;
            }
            rate = rate.max(here);
            if body.kind == BodyKind::Rigid {
                spin = spin.max(square(&read::<S, 3>(velocities, body.velocity + 3)));
            }
        }
        let translation = (rate > spin).then_some(fastest);
        ([rate.max(spin).sqrt(), speed, spin], translation)
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

/// How fast something turns at the most, or moves by lengths of the mechanism (rad/s).
pub(crate) fn fastest<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    state: &M::State<S>,
) -> S {
    let velocities = state.velocities().as_slice();
    let (mut speed, mut spin) = (S::zero(), S::zero());
    for body in M::REPORT.bodies {
        speed = speed.max(square(&read::<S, 3>(velocities, body.velocity)));
        if body.kind == BodyKind::Rigid {
            spin = spin.max(square(&read::<S, 3>(velocities, body.velocity + 3)));
        }
    }
    let (speed, spin) = (speed.sqrt(), spin.sqrt());
    // Lengths of the description: bodies may be anywhere by now.
    let described = M::initial_state(constants);
    spin.max(speed.quotient(characteristic_length::<S, M>(constants, &described)))
}
