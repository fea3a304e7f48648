//! What the digits of numbers leave unknown.
//!
//! It costs nothing but an evaluation at the start. Only it finds a millimetre that lies a thousand
//! kilometres away (`tests/tests/sound/outside.rs`), and that the round-off of a million steps may
//! shift a phase (`tests/tests/ranges/long.rs`).

use super::limits::{self, above};
use super::record::RunFacts;
use super::warning::Warning;
use crate::constraints::extent::resolution;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// What round-off changes of the energy in a step, over it and the epsilon of the number type, as
/// one of a random walk's steps: velocities are rounded once or twice by up to half an epsilon,
/// evenly, and the energy goes with their square.
const ROUND_OFF: f64 = 0.5;

/// The round-off of positions and accelerations.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoundOff<S> {
    /// What the digits of the positions resolve at the start (m).
    resolution: S,
    /// What the last digit of the coordinates changes of the accelerations (m/s^2, angles by the
    /// length of the mechanism).
    noise: S,
}

impl<S: Real> RoundOff<S> {
    pub(super) fn of<M: Mechanism>(state: &M::State<S>) -> Self {
        Self {
            resolution: resolution::<S, M>(state),
            noise: S::zero(),
        }
    }

    /// Takes what the last digit of the coordinates changes of the accelerations.
    pub(super) fn begin(&mut self, noise: S) {
        self.noise = noise;
    }

    /// How far a mechanism of such a length reaches from the origin (m).
    pub(super) fn reach(&self, length: S) -> S {
        length + self.resolution.quotient(S::EPSILON)
    }

    /// A way (m) that is round-off, of accelerations for so long, and of positions so far away.
    pub(super) fn way(&self, duration: S, reach: S) -> S {
        let fallen = S::constant(0.5) * self.noise * duration * duration;
        S::constant(limits::DIGITS) * S::EPSILON.fused(reach, fallen)
    }

    /// A speed (m/s) that is round-off: of accelerations, for so long, or by less than a digit of a
    /// position in a step.
    pub(super) fn speed(&self, run: &RunFacts<S>) -> S {
        let of_forces = self.noise * run.duration;
        let of_positions = if run.longest > S::zero() {
            self.resolution.quotient(run.longest)
        } else {
            S::zero()
        };
        S::constant(limits::DIGITS) * (of_forces + of_positions)
    }

    /// Round-off of velocities changes the energy like a random walk, whose end tells little of its
    /// way. Only where next to nothing works on the mechanism: forces and drivers set a
    /// phase of their own.
    pub(super) fn long_run(&self, run: &RunFacts<S>) -> Option<Warning> {
        if !run.is_closed {
            return None;
        }
        let change = S::constant(ROUND_OFF) * S::EPSILON;
        let change = change * S::constant(run.steps as f64).sqrt();
        let shift = S::constant(0.5) * change * run.travel;
        above(shift, limits::PHASE).then(|| Warning::LongRun {
            steps: run.steps,
            travel: run.travel.to_f64(),
            shift: shift.to_f64(),
        })
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        let coarse = self.resolution > S::constant(limits::COARSE) * run.length;
        coarse.then(|| Warning::CoarseNumbers {
            resolution: self.resolution.to_f64(),
            size: run.length.to_f64(),
        })
    }
}
