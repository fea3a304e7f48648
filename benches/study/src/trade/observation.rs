//! What runs start from, and what is read of them.

use holonom::{Mechanism, Real, StateParts, state::Array as _};

use super::problem::Problem;
use crate::error::StudyError;

/// A state in `f64`: coordinates, then velocities, as [`Mechanism::State`] has them.
#[derive(Clone, Debug, PartialEq)]
pub struct Start(pub Vec<f64>);

/// What was read of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Evaluations of the equations of motion.
    pub evaluations: u64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    /// The reporting times (s).
    pub times: Vec<f64>,
    /// What [`Problem::read`] says at these.
    pub values: Vec<Vec<f64>>,
    /// `|Phi|` at these, all rows together, in m and rad.
    pub violations: Vec<f64>,
    /// Kinetic and potential energy (J) at these.
    pub energies: Vec<f64>,
    /// The largest change of energy (J) that no force accounts for.
    pub energy_drift: f64,
    /// What the run's monitor warns of, in words.
    pub warnings: Vec<String>,
}

pub(super) fn stopped<P: Problem>(problem: &P, reason: &dyn std::fmt::Display) -> StudyError {
    StudyError::Run {
        name: problem.name().into(),
        reason: reason.to_string(),
    }
}

pub(super) fn flat<M: Mechanism>(state: &M::State<f64>) -> Start {
    let (q, u) = (state.coordinates(), state.velocities());
    Start(q.as_slice().iter().chain(u.as_slice()).copied().collect())
}

pub(super) fn state<S: Real, M: Mechanism>(start: &Start) -> M::State<S> {
    let mut state = M::State::<S>::from_parts(
        holonom::state::Array::zeros(),
        holonom::state::Array::zeros(),
    );
    let mut numbers = start.0.iter();
    for place in state.coordinates_mut().as_mut_slice() {
        *place = S::constant(numbers.next().copied().unwrap_or(f64::NAN));
    }
    for place in state.velocities_mut().as_mut_slice() {
        *place = S::constant(numbers.next().copied().unwrap_or(f64::NAN));
    }
    state
}
