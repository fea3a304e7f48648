//! What a run tells the monitor beside its steps, and asks of it.

use super::Monitor;
use super::beginning::{Beginning, shaken};
use super::phase_error::PhaseError;
use crate::constraints::extent::farthest;
use crate::constraints::newton::free_parts;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// A state whose coordinates are changed in their last digit.
    pub(crate) fn shaken(&self, state: &M::State<S>) -> M::State<S> {
        shaken::<S, M>(state, self.length)
    }

    /// Takes what acts at the start of a run.
    pub(crate) fn begin(&mut self, state: &M::State<S>, beginning: &Beginning<'_, S, M>) {
        self.round_off.begin(beginning.noise(self.length));
        let left = self.compliance.left();
        self.rest.begin(beginning, self.length, left);
        let reach = self.length + farthest(M::REPORT.bodies, state.coordinates().as_slice());
        self.energy.made_of(beginning.work_over(reach));
    }

    /// With a compliance `e` accelerations satisfy `D u' - gamma* = e lambda`.
    pub(crate) fn yielded(
        &mut self,
        compliances: &M::Multipliers<S>,
        multipliers: &M::Multipliers<S>,
        accelerations: &M::Velocities<S>,
    ) {
        let rows = (self.violations.rows(), self.length);
        self.compliance
            .take(rows, (compliances, multipliers), accelerations);
    }

    /// Takes the end of a run, which may lie within a step.
    pub(crate) fn end(&mut self, constants: &M::Constants<S>, time: S, state: &M::State<S>) {
        self.end_of_steps(constants, time, state);
        self.violations.end(constants, time, state);
    }

    /// Time and state of the smallest pivot, or right after it; `None` where there are no pivots.
    pub(crate) fn nearest(&self) -> Option<(S, M::State<S>)> {
        self.pivots.nearest()
    }

    /// Takes the joint of the smallest pivot.
    pub(crate) fn name(&mut self, joint: usize) {
        self.pivots.name(joint);
    }

    /// By how much time (s) velocities at the end of a step are ahead of coordinates; `None` where
    /// they are not.
    #[inline]
    pub(crate) fn stagger(&self, end: S) -> Option<S> {
        let lead = self.phase_error.stagger();
        lead.map(|lead| lead * (end - self.travel.time))
    }

    /// Steps that were looked at.
    #[inline]
    pub(crate) fn steps(&self) -> usize {
        self.travel.steps
    }

    /// Whether the next step is to be judged by a rule of higher order.
    pub(crate) fn judges(&self) -> bool {
        PhaseError::<S, M>::is_due(self.travel.steps)
    }

    /// Takes where the next step has led to at a time, and where a rule of higher order leads.
    pub(crate) fn judge(
        &mut self,
        (constants, time): (&M::Constants<S>, S),
        ends: [&M::State<S>; 2],
    ) {
        let [missed, slower] = PhaseError::<S, M>::missed_by(ends);
        let mut motions = [missed, slower, *ends[0].velocities()];
        // What a driver prescribes is never late.
        if M::REPORT.time.constraints {
            free_parts::<S, M>(constants, (time, ends[0]), &mut motions);
        }
        self.phase_error.judge(&self.measure, ends[0], &motions);
    }

    /// Forces may jump here.
    pub(crate) fn restart(&mut self) {
        self.energy.restart();
        self.states.restart();
    }

    /// Points are close in the step under way, along whose line a force acts.
    pub(crate) fn comes_close(&mut self) {
        self.energy.comes_close();
    }

    /// Points pass each other closely in a step, along whose line a force acts; whether it turns
    /// round within the step.
    pub(crate) fn passes(&mut self, turns_round: bool) {
        self.control.passes();
        if turns_round {
            self.phase_error.passes_over();
        }
    }

    /// An event has put so much energy (J) into the mechanism.
    pub(crate) fn jump(&mut self, energy: S) {
        self.energy.jump(energy);
    }

    /// Counts a correction that was accepted without convergence.
    pub(crate) fn accept_unconverged_correction(&mut self, time: S) {
        self.unconverged.correction(time);
    }

    /// Takes how many evaluations of the run were accepted without convergence up to a time.
    #[inline]
    pub(crate) fn accept_unconverged_evaluations(&mut self, evaluations: usize, time: S) {
        self.unconverged.evaluations(evaluations, time);
    }
}
