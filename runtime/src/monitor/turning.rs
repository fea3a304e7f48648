//! How far velocities have turned: the radians of a motion that goes round something.
//!
//! A path over a length counts too many radians of a long vibration, and as many of an orbit as its
//! start happens to be near. The direction of the velocity turns by a full turn a round of every
//! orbit. What goes to and fro turns it back.
//!
//! It costs three products in steps in which a translation is what moves fastest, and a root where
//! that has turned noticeably. Only by it a small change of energy tells the phase of an orbit:
//! `tests/tests/sound/orbits.rs`.

use super::motion::Motion;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{cross, dot, read, square};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// The square of the cosine of a turn that is added up: of 0.05 rad.
const NOTICEABLE: f64 = 0.9975;

/// The turn of the velocity of the body whose translation is fastest.
pub(super) struct Turning<S: Scalar, M: Mechanism> {
    /// Velocities at the end of the last step, or of one since which they have hardly turned.
    before: M::Velocities<S>,
    /// The sum, with its axis (rad): less than it is in steps of a radian or more.
    turned: [S; 3],
    /// The way (rad) of steps in which a translation was fastest.
    way: S,
}

copied!([S: Scalar, M: Mechanism] Turning<S, M>);

impl<S: Real, M: Mechanism> Turning<S, M> {
    pub(super) fn from(start: &M::State<S>) -> Self {
        Self {
            before: *start.velocities(),
            turned: [S::zero(); 3],
            way: S::zero(),
        }
    }

    /// Takes the velocities at the end of a step.
    #[inline]
    pub(super) fn step(&mut self, state: &M::State<S>, motion: &Motion<S>) {
        if M::REPORT.time.constraints {
            return;
        }
        if let Some(place) = motion.translation {
            self.way = self.way + motion.turned;
            let from: [S; 3] = read(self.before.as_slice(), place);
            let to: [S; 3] = read(state.velocities().as_slice(), place);
            let (along, sizes) = (dot(&from, &to), square(&from) * square(&to));
            if along > S::zero() && along * along >= S::constant(NOTICEABLE) * sizes {
                return;
            }
            self.add([&from, &to], sizes);
        }
        self.before = *state.velocities();
    }

    /// Adds the turn from one velocity to another, with the product of their squares.
    fn add(&mut self, [from, to]: [&[S; 3]; 2], sizes: S) {
        if sizes > S::zero() {
            let part = sizes.sqrt().reciprocal();
            for (sum, turn) in self.turned.iter_mut().zip(cross(from, to)) {
                *sum = turn.fused(part, *sum);
            }
        }
    }

    /// By how much the velocity has turned in one direction (rad); zero where a driver may lead
    /// it, which is never late.
    pub(super) fn round(&self) -> S {
        square(&self.turned).sqrt()
    }

    /// The part of the way (rad) of translations that goes round: one of a circle of the length of
    /// the body.
    pub(super) fn part_that_goes_round(&self) -> S {
        if self.way > S::zero() {
            self.round().quotient(self.way).min(S::one())
        } else {
            S::zero()
        }
    }
}
