//! What Euler parameters lost of their length in all steps, as the angles that are off with it.
//!
//! A step that turns to and fro is off to and fro: what was lost counts along the angular velocity.
//! It costs a product a body and step, in absolute coordinates alone. Only it finds that a spin
//! beside which nothing moves is off by small amounts that add up:
//! `tests/tests/sound/orientation.rs`.

use crate::math::scalar::Real;
use crate::math::vec3::{read, square};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What was lost in the steps in which one body turned fastest, along its angular velocity, and in
/// the steps before.
#[derive(Clone, Copy, Debug)]
pub(super) struct NormDrift<S> {
    before: S,
    along: [S; 3],
    /// The place of the velocity of that body.
    body: usize,
}

impl<S: Real> NormDrift<S> {
    pub(super) fn none() -> Self {
        Self {
            before: S::zero(),
            along: [S::zero(); 3],
            body: 0,
        }
    }

    /// Adds what was lost in a step that has led to a state.
    #[inline]
    pub(super) fn add<M: Mechanism>(&mut self, state: &M::State<S>, drift: S) {
        let round_off = S::constant(4.0) * S::EPSILON;
        if drift <= round_off {
            return;
        }
        let velocities = state.velocities().as_slice();
        let mut fastest = (S::zero(), 0, [S::zero(); 3]);
        for body in M::REPORT.bodies {
            if body.kind == BodyKind::Rigid {
                let spin = read(velocities, body.velocity + 3);
                let size = square(&spin);
                if size > fastest.0 {
                    fastest = (size, body.velocity, spin);
                }
            }
        }
        let (size, body, spin) = fastest;
        if body != self.body {
            *self = Self {
                before: self.sum(),
                along: [S::zero(); 3],
                body,
            };
        }
        if size > S::zero() {
            let part = (drift - round_off).quotient(size.sqrt());
            for (sum, x) in self.along.iter_mut().zip(spin) {
                *sum = x.fused(part, *sum);
            }
        }
    }

    pub(super) fn sum(&self) -> S {
        self.before + square(&self.along).sqrt()
    }
}
