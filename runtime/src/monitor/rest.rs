//! Whether a mechanism is at rest, as far as its numbers tell.
//!
//! It costs two evaluations at the start, and distances a step while rest lasts. Without it what
//! stands still has no warning: `tests/tests/quiet.rs`.
//!
//! Relative measures compare with what the motion itself is. Where nothing moves but round-off, or
//! what a tolerance or a compliance lets move, they compare an error with itself.

use super::limits;
use super::{Monitor, exceeds};
use crate::constraints::extent::farthest;
use crate::math::scalar::Real;
use crate::math::vec3::square;
use crate::math::vec3::{minus, read};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What is known of rest at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest<S> {
    /// What the last digit of the coordinates changes of the accelerations (m/s^2, angles by the
    /// length of the mechanism).
    noise: S,
    /// Whether the run began at rest and has stayed there.
    lasts: bool,
}

impl<S: Real> Rest<S> {
    pub(super) fn unknown() -> Self {
        Self {
            noise: S::zero(),
            lasts: false,
        }
    }
}

/// What the monitor is told before the first step, beside the state.
pub(crate) struct Beginning<'a, S: Real, M: Mechanism> {
    /// Accelerations at the start, and where every coordinate is changed in its last digit.
    pub(crate) accelerations: [&'a M::Velocities<S>; 2],
    /// Forces and moments that act, reactions aside.
    pub(crate) forces: &'a M::Velocities<S>,
    pub(crate) mass: &'a M::Velocities<S>,
    /// By what part of their terms accelerations miss the constraints.
    pub(crate) bias: S,
}

/// A state whose coordinates are changed in their last digit, without a pattern that a mechanism
/// could share.
fn shaken<S: Real, M: Mechanism>(state: &M::State<S>, length: S) -> M::State<S> {
    const SIGNS: u32 = 0b1011_0010_0111_0100_0110_1110_1010_0011;
    let mut shaken = *state;
    let change = |place: usize, x: S, size: S| {
        let change = S::EPSILON * x.abs().max(size);
        let is_up = SIGNS >> (place % 32) & 1 == 1;
        if is_up { x + change } else { x - change }
    };
    let elements = shaken.coordinates_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        let place = body.coordinate;
        let ends = match body.kind {
            BodyKind::Rigid => place + 7,
            BodyKind::Particle => place + 3,
        };
        for k in place..ends {
            let size = if k < place + 3 {
                length
            } else {
                S::constant(0.5)
            };
            if let Some(element) = elements.get_mut(k) {
                *element = change(k + 1, *element, size);
            }
        }
    }
    shaken
}

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// A state whose coordinates are changed in their last digit.
    pub(crate) fn shaken(&self, state: &M::State<S>) -> M::State<S> {
        shaken::<S, M>(state, self.length)
    }

    /// Takes what acts at the start of a run.
    pub(crate) fn begin(&mut self, state: &M::State<S>, beginning: &Beginning<'_, S, M>) {
        let Beginning {
            accelerations: [here, there],
            forces,
            mass,
            bias,
        } = beginning;
        let mut noise = M::Velocities::<S>::zeros();
        let pairs = here.as_slice().iter().zip(there.as_slice());
        for (x, (&a, &b)) in noise.as_mut_slice().iter_mut().zip(pairs) {
            *x = b - a;
        }
        let mut free = M::Velocities::<S>::zeros();
        let pairs = forces.as_slice().iter().zip(mass.as_slice());
        for (x, (&force, &mass)) in free.as_mut_slice().iter_mut().zip(pairs) {
            *x = force.quotient(mass);
        }
        let noise = self.largest(&noise);
        let free = self.largest(&free);
        let round_off = S::constant(limits::DIGITS) * S::EPSILON;
        let slow = round_off * (free * self.length).sqrt();
        let yields = S::constant(limits::ALLOWED) * self.compliance.left + *bias * free;
        let still = S::constant(limits::DIGITS).fused(noise, yields);
        self.rest = Rest {
            noise,
            lasts: !exceeds(self.largest(here), still)
                && !exceeds(self.largest(state.velocities()), slow),
        };
        let reach = self.length + farthest(M::REPORT.bodies, state.coordinates().as_slice());
        self.balance.made_of(self.work_over(forces, reach));
    }

    /// The largest translation (m, of so many derivatives) or rotation, by the length of the
    /// mechanism.
    fn largest(&self, velocities: &M::Velocities<S>) -> S {
        let elements = velocities.as_slice();
        M::REPORT.bodies.iter().fold(S::zero(), |largest, body| {
            let largest = largest.max(square(&read::<S, 3>(elements, body.velocity)).sqrt());
            if body.kind == BodyKind::Rigid {
                let turn = square(&read::<S, 3>(elements, body.velocity + 3)).sqrt();
                largest.max(turn * self.length)
            } else {
                largest
            }
        })
    }

    /// The work (J) of all forces over a length, and of all moments over a radian, whatever their
    /// directions.
    fn work_over(&self, forces: &M::Velocities<S>, length: S) -> S {
        let elements = forces.as_slice();
        M::REPORT.bodies.iter().fold(S::zero(), |sum, body| {
            let force = square(&read::<S, 3>(elements, body.velocity)).sqrt();
            let moment = if body.kind == BodyKind::Rigid {
                square(&read::<S, 3>(elements, body.velocity + 3)).sqrt()
            } else {
                S::zero()
            };
            force.fused(length, moment) + sum
        })
    }

    /// Looks whether a step has led away from rest, in which bodies turned or moved by so many
    /// radians.
    pub(super) fn look_at_rest(&mut self, state: &M::State<S>, turned: S) {
        if !self.rest.lasts {
            return;
        }
        let (now, first) = (state.coordinates(), self.phase_error.first().coordinates());
        let (now, first) = (now.as_slice(), first.as_slice());
        let mut way = S::constant(0.25) * turned * self.length;
        for body in M::REPORT.bodies {
            let place = body.coordinate;
            let [r, r0]: [[S; 3]; 2] = [read(now, place), read(first, place)];
            way = way.max(square(&minus(&r, &r0)).sqrt());
            if body.kind == BodyKind::Rigid {
                let [p, p0]: [[S; 4]; 2] = [read(now, place + 3), read(first, place + 3)];
                let [a, b, c, d] = p;
                let [x, y, z, w] = p0;
                let turn = square(&[a - x, b - y, c - z, d - w]).sqrt();
                way = way.max((turn + turn) * self.length);
            }
        }
        self.rest.lasts = !exceeds(way, self.hardly());
    }

    /// A way (m) that says of no motion: what round-off, the tolerance and the violations so far
    /// account for, as long as that is little.
    fn hardly(&self) -> S {
        let time = self.time - self.start;
        let reach = self.length + self.resolution.quotient(S::EPSILON);
        let fallen = S::constant(0.5) * self.rest.noise * time * time;
        let round_off = S::constant(limits::DIGITS) * S::EPSILON.fused(reach, fallen);
        let allowed = match self.tolerance {
            Some((relative, absolute)) => relative.fused(reach, absolute),
            None => S::zero(),
        };
        let open = self.largest_violation().min(S::constant(limits::SAGS)) * self.length;
        let way = S::constant(limits::ALLOWED).fused(allowed + open, round_off);
        way.min(S::constant(limits::COARSE) * self.length)
    }

    /// Whether the run began at rest and has stayed there, as far as its numbers tell: what moved
    /// since says of nothing.
    pub(super) fn rests(&self) -> bool {
        self.rest.lasts
    }

    /// A speed (m/s) that is round-off: of accelerations, for so long, or by less than a digit of a
    /// position in a step.
    pub(super) fn speed_of_round_off(&self) -> S {
        let of_forces = self.rest.noise * (self.time - self.start);
        let of_positions = if self.longest > S::zero() {
            self.resolution.quotient(self.longest)
        } else {
            S::zero()
        };
        S::constant(limits::DIGITS) * (of_forces + of_positions)
    }
}
