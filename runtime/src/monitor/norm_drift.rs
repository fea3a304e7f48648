//! Orientation: what Euler parameters lost of their length in all steps, as the angles that are off
//! with it.
//!
//! A step that turns to and fro is off to and fro: what was lost counts along the angular velocity.
//! It costs a product a body and step, in absolute coordinates alone. Only it finds that a spin
//! beside which nothing moves is off by small amounts that add up:
//! `tests/tests/sound/orientation.rs`.

use super::limits::{self, above};
use super::record::{MonitoredStep, RunFacts};
use super::warning::Warning;
use crate::integrate::ErrorModel;
use crate::math::scalar::Real;
use crate::math::vec3::{read, square};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// `| |p| - 1 |` in a step: twice that is what a rotation matrix is off by where `p` is read as it
/// is, and about what an angle is off by in one step elsewhere.
const LENGTH: f64 = 1e-3;

/// What was lost at the most, and in all steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct NormDrift<S> {
    /// How the errors of the method grow.
    model: ErrorModel,
    /// The largest `| |p| - 1 |` of a step.
    largest: S,
    /// What was lost in the steps in which one body turned fastest, along its angular velocity, and
    /// in the steps before.
    along: [S; 3],
    before: S,
    /// The place of the velocity of that body.
    body: usize,
}

impl<S: Real> NormDrift<S> {
    pub(super) fn none() -> Self {
        Self {
            model: ErrorModel::default(),
            largest: S::zero(),
            along: [S::zero(); 3],
            before: S::zero(),
            body: 0,
        }
    }

    /// Of a run with a method whose errors grow like that.
    pub(super) fn over(mut self, model: ErrorModel) -> Self {
        self.model = model;
        self
    }

    #[inline]
    pub(super) fn step<M: Mechanism>(&mut self, step: &MonitoredStep<'_, S, M>) {
        self.largest = self.largest.max(step.norm_drift);
        if step.is_normalised {
            self.add::<M>(step.state, step.norm_drift);
        }
    }

    /// Adds what was lost in a step that has led to a state.
    #[inline]
    fn add<M: Mechanism>(&mut self, state: &M::State<S>, drift: S) {
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
            self.before = self.sum();
            self.along = [S::zero(); 3];
            self.body = body;
        }
        if size > S::zero() {
            let part = (drift - round_off).quotient(size.sqrt());
            for (sum, x) in self.along.iter_mut().zip(spin) {
                *sum = x.fused(part, *sum);
            }
        }
    }

    fn sum(&self) -> S {
        self.before + square(&self.along).sqrt()
    }

    /// The largest `| |p| - 1 |` of a step.
    pub(super) fn largest(&self) -> S {
        self.largest
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        // On average over the steps; those that turn further drift more, and are off by less of
        // it.
        let half = S::constant(0.5) * run.travel.quotient(S::constant(run.steps as f64));
        let error = S::constant(self.model.angle_error);
        let of_short = S::constant(self.model.angle_error_of_short_steps).quotient(half);
        let error = if half > S::zero() {
            error.max(of_short)
        } else {
            error
        };
        let shift = self.sum() * error;
        let warned = above(self.largest, LENGTH) || above(shift, limits::PHASE);
        warned.then(|| Warning::Orientation {
            drift: self.largest.to_f64(),
            shift: shift.to_f64(),
        })
    }
}
