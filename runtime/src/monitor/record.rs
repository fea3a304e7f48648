//! What indicators are given: a record of every step, and what their verdicts share of a run.

use super::motion::Motion;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::Mechanism;

/// A step, or the start of an integration, as every indicator sees it.
pub(crate) struct MonitoredStep<'a, S: Scalar, M: Mechanism> {
    pub(crate) constants: &'a M::Constants<S>,
    /// When it began (s).
    pub(crate) start: S,
    /// When it ended (s).
    pub(crate) end: S,
    /// How many were shown before.
    pub(crate) index: usize,
    /// The state at its end, after its correction.
    pub(crate) state: &'a M::State<S>,
    pub(crate) motion: Motion<S>,
    /// What is evaluated at the end of some steps only.
    pub(crate) look: Option<&'a Look<S, M>>,
    /// The error as the step control estimated it, relative to the state.
    pub(crate) estimate: Option<S>,
    /// The power (W) of all forces without a potential, drivers included; `None` where there are
    /// none.
    pub(crate) power: Option<S>,
    /// Their work, where it was looked for within the step.
    pub(crate) work: Option<Work<S>>,
    /// The relative pivot at its end; `None` where it was not looked at.
    pub(crate) pivot: Option<S>,
    /// The largest `| |p| - 1 |` of a body at its end, before it was corrected.
    pub(crate) norm_drift: S,
    /// Whether that was corrected, so that every step adds another.
    pub(crate) is_normalised: bool,
}

/// The work of forces over a step, as the power within it tells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work<S> {
    /// The work (J).
    pub(crate) done: S,
    /// By how much it may be off (J).
    pub(crate) unsure: S,
    /// The same work whatever its sign (J).
    pub(crate) turnover: S,
}

/// Violations and energies of a state.
pub(crate) struct Look<S: Scalar, M: Mechanism> {
    pub(super) phi: M::Multipliers<S>,
    pub(super) phi_rate: M::Multipliers<S>,
    /// Kinetic energy (J).
    pub(super) kinetic: S,
    /// Potential energy (J).
    pub(super) potential: S,
}

impl<S: Real, M: Mechanism> Look<S, M> {
    #[inline(never)]
    pub(super) fn at(constants: &M::Constants<S>, time: S, state: &M::State<S>) -> Self {
        Self {
            phi: M::constraints(constants, time, state),
            phi_rate: M::constraint_rates(constants, time, state),
            kinetic: M::kinetic_energy(constants, state),
            potential: M::potential_energy(constants, time, state),
        }
    }
}

/// What verdicts share of a run: how large the mechanism is, and how it has moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct RunFacts<S> {
    /// The length (m) of the mechanism at the start.
    pub(super) length: S,
    /// The time (s) at the start.
    pub(super) start: S,
    pub(super) steps: usize,
    /// The time (s) since the start.
    pub(super) duration: S,
    /// The longest step (s).
    pub(super) longest: S,
    /// Radians of motion, see [`Travel`](super::travel::Travel).
    pub(super) travel: S,
    /// The largest rate of motion (rad/s).
    pub(super) fastest: S,
    /// The largest speed (m/s) and angular velocity (rad/s).
    pub(super) speeds: [S; 2],
    /// Whether the run began at rest and has stayed there: what moved since says nothing.
    pub(super) rests: bool,
    /// The largest violation of a position, in lengths of the mechanism or radians.
    pub(super) open: S,
    /// How often the motion has forgotten what it was: an error counts that has come about since.
    pub(super) lives: S,
    /// The part of what dampers took that was fed to the motion.
    pub(super) fed: S,
    /// The part of the radians of motion that vibrations of more than a length leave.
    pub(super) part_of_vibrations: S,
    /// By how much the velocity of the fastest translation has turned in one direction (rad), and
    /// the part of the radians of translations that this is.
    pub(super) round: S,
    pub(super) part_that_goes_round: S,
    /// Whether the method controls its steps.
    pub(super) is_controlled: bool,
    /// Whether the balance of energy tells anything.
    pub(super) has_balance: bool,
    /// Whether next to nothing works on the mechanism.
    pub(super) is_closed: bool,
}
