//! Whether the tolerance of a step control suits the mechanism and the number of steps.
//!
//! It costs a sum a step. Only it finds an absolute tolerance that is large beside the mechanism
//! (`tests/tests/sound/told.rs`), and errors that add up where forces leave no balance of energy
//! (`tests/tests/alarms.rs`).

use super::limits::{self, above};
use super::record::{MonitoredStep, RunFacts};
use super::warning::Warning;
use crate::integrate::{ErrorModel, Method};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// Errors of single steps, as the step control estimates them, added up over a run of which no
/// balance of energy tells more. Errors of an undamped, forced oscillation are a half to a fourth
/// of that.
const ADDED_UP: f64 = 4e-2;

/// A step control, and what it estimated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Control<S> {
    /// The tolerance, relative and absolute, of a method that controls its steps.
    tolerance: Option<(S, S)>,
    /// How the errors of the method grow.
    model: ErrorModel,
    /// The sum of the errors that were estimated, relative to the state.
    estimated: S,
    /// Whether points passed each other closely, where many short steps err alike.
    passes: bool,
}

impl<S: Real> Control<S> {
    pub(super) fn none() -> Self {
        Self {
            tolerance: None,
            model: ErrorModel::default(),
            estimated: S::zero(),
            passes: false,
        }
    }

    /// Of a run with this method.
    pub(super) fn over<I: Method<S>>(mut self, integrator: &I) -> Self {
        let tolerance = integrator.tolerance();
        self.tolerance = tolerance.map(|tolerance| (tolerance.relative, tolerance.absolute));
        self.model = integrator.error_model();
        self
    }

    /// Whether there is one.
    pub(super) fn is_there(&self) -> bool {
        self.tolerance.is_some()
    }

    /// The absolute tolerance, of a step control.
    pub(super) fn absolute(&self) -> Option<S> {
        self.tolerance.map(|(_, absolute)| absolute)
    }

    /// The error (m) that it allows of a position so far from the origin.
    pub(super) fn allowed(&self, reach: S) -> S {
        match self.tolerance {
            Some((relative, absolute)) => relative.fused(reach, absolute),
            None => S::zero(),
        }
    }

    #[inline]
    pub(super) fn step<M: Mechanism>(&mut self, step: &MonitoredStep<'_, S, M>) {
        if let Some(estimate) = step.estimate {
            self.estimated = self.estimated + estimate;
        }
    }

    /// Takes note that points pass each other closely.
    pub(super) fn passes(&mut self) {
        self.passes = true;
    }

    /// Only where there is no balance of energy that tells more.
    pub(super) fn many_steps(&self, run: &RunFacts<S>) -> Option<Warning> {
        if run.rests || run.has_balance && !self.passes {
            return None;
        }
        self.tolerance?;
        let steps = S::constant(run.steps as f64);
        let ErrorModel {
            estimate_power,
            estimate_share,
            ..
        } = self.model;
        let mean = self.estimated.quotient(steps).powf(estimate_power);
        let sum = S::constant(estimate_share) * mean * steps;
        // Energies are off by twice the part that states are, and shift the phase from then on by
        // half of theirs.
        let grown = run.travel * run.part_of_vibrations;
        let is_late = self.passes && above((sum * grown).quotient(run.lives), limits::PHASE);
        let sum = sum.quotient(run.lives);
        (is_late || above(sum, ADDED_UP)).then(|| Warning::ManySteps {
            steps: run.steps,
            error: (if is_late { sum * grown } else { sum }).to_f64(),
        })
    }

    pub(super) fn verdict<M: Mechanism>(&self, run: &RunFacts<S>) -> Option<Warning> {
        let (_, absolute) = self.tolerance?;
        let moved = run.travel > S::zero() && !run.rests;
        let moved = moved && !M::REPORT.bodies.is_empty();
        let coarse = absolute > S::constant(limits::COARSE) * run.length;
        (coarse && moved).then(|| Warning::CoarseTolerance {
            absolute: absolute.to_f64(),
            size: run.length.to_f64(),
        })
    }
}
