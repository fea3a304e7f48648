//! What a run came to.

use core::fmt;

use crate::dynamics::Iterations;
use crate::error::SimulationError;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::{Monitor, Warnings};
use crate::run::verification::Verification;

/// What a run came to, and whether it can be trusted.
#[non_exhaustive]
pub struct RunReport<S: Real, M: Mechanism> {
    /// Evaluations of the rates by the integrator.
    pub evaluations: usize,
    /// Steps that were accepted.
    pub accepted: usize,
    /// Steps that were tried and rejected.
    pub rejected: usize,
    /// The largest `Phi^T Phi` at a reporting time. Its rows may have different units;
    /// [`RunReport::monitor`] has violations joint by joint, over all steps.
    pub worst_violation: S,
    /// How often the augmented Lagrangian solved its system; zero for other formulations.
    pub iterations: Iterations,
    /// The time (s) of the last state: the end, or the reporting time at which the observer stopped
    /// the run.
    pub time: S,
    /// The last state.
    pub state: M::State<S>,
    /// Whether the observer stopped the run.
    pub stopped: bool,
    /// The estimated errors of a run that is
    /// [`verified`](crate::Simulation::verified); `None` of another,
    /// and with an integrator that knows no companion.
    pub verification: Option<Verification<S, M>>,
    /// What the monitor saw; `None` where it was turned off.
    pub monitor: Option<Monitor<S, M>>,
}

/// The report of a run, or why it could not go on; `E` is another error where the observer may
/// fail, see [`RunError`](crate::RunError).
pub type RunResult<S, M, E = SimulationError<<M as Mechanism>::State<S>>> =
    Result<RunReport<S, M>, E>;

impl<S: Real, M: Mechanism> RunReport<S, M> {
    /// Warnings; empty for a run that can be trusted, as far as its indicators tell.
    ///
    /// They tell a result that is off by more than about a hundredth: joints that open, energy that
    /// comes from nowhere, a singular configuration that was passed, tolerances, steps and
    /// penalties that do not suit the mechanism. Small errors of a chaotic motion, and laws that
    /// are shorter than a step, are beyond them: see
    /// [`Simulation::verified`](crate::Simulation::verified).
    #[must_use]
    pub fn warnings(&self) -> Warnings {
        self.monitor
            .as_ref()
            .map_or_else(Warnings::unmonitored, Monitor::warnings)
    }
}

impl<S: Real, M: Mechanism> Clone for RunReport<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: Mechanism> Copy for RunReport<S, M> {}

/// Equal in everything that was counted, reached and warned of.
impl<S: Real, M: Mechanism> PartialEq for RunReport<S, M> {
    fn eq(&self, other: &Self) -> bool {
        let counts = |report: &Self| {
            let Self {
                evaluations,
                accepted,
                rejected,
                iterations,
                stopped,
                ..
            } = *report;
            (evaluations, accepted, rejected, iterations, stopped)
        };
        counts(self) == counts(other)
            && self.worst_violation == other.worst_violation
            && self.time == other.time
            && self.state == other.state
            && self.warnings() == other.warnings()
    }
}

impl<S: Real, M: Mechanism> fmt::Debug for RunReport<S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RunReport")
            .field("evaluations", &self.evaluations)
            .field("accepted", &self.accepted)
            .field("rejected", &self.rejected)
            .field("worst_violation", &self.worst_violation)
            .field("iterations", &self.iterations)
            .field("time", &self.time)
            .field("state", &self.state)
            .field("stopped", &self.stopped)
            .field("warnings", &self.warnings())
            .field("verification", &self.verification)
            .finish()
    }
}
