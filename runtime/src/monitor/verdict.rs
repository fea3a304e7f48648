//! The verdicts of all indicators, the gravest first.

use super::Monitor;
use super::record::RunFacts;
use super::warning::Warnings;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// Warnings.
    #[must_use]
    pub(crate) fn warnings(&self) -> Warnings {
        let run = &self.facts();
        let slip_of_round_off = self.round_off.speed(run);
        // What is told already is not told again.
        let energy = self.energy.verdict(run);
        let phase = self.energy.phase(run).filter(|_| energy.is_none());
        let long_run = self.round_off.long_run(run).filter(|_| phase.is_none());
        let singular = self.pivots.verdict(run);
        let vanishing = self.gradients.verdict(run);
        Warnings::new([
            self.violations.wrong_side(),
            energy,
            self.violations.open(run),
            self.violations.slipping(run, slip_of_round_off),
            singular,
            vanishing.filter(|_| singular.is_none()),
            self.unconverged.verdict(),
            phase,
            long_run,
            self.compliance.verdict(run),
            self.control.many_steps(run),
            self.control.verdict::<M>(run),
            self.norm_drift.verdict(run),
            self.round_off.verdict(run),
            self.energy.coarse_steps(run),
            self.phase_error.verdict(run),
            self.growth.verdict(run),
            self.states.verdict(self.control.absolute()),
        ])
    }

    /// What verdicts share.
    fn facts(&self) -> RunFacts<S> {
        let travel = &self.travel;
        RunFacts {
            length: self.length,
            start: travel.start,
            steps: travel.steps,
            duration: travel.time - travel.start,
            longest: travel.longest,
            travel: travel.radians,
            fastest: travel.fastest,
            speeds: travel.speeds(),
            rests: self.rest.lasts() || self.has_hardly_moved(),
            open: self.violations.largest(self.length),
            lives: self.memory.lives(&self.measure),
            fed: self.memory.fed(self.energy.gained()),
            part_of_vibrations: self.memory.part_of_vibrations(&self.measure),
            round: self.turning.round(),
            part_that_goes_round: self.turning.part_that_goes_round(),
            is_controlled: self.control.is_there(),
            has_balance: self.energy.has_balance(),
            is_closed: self.energy.is_of_a_closed_system(),
        }
    }

    /// Whether all that was moved is below the digits of the positions, as where friction holds.
    fn has_hardly_moved(&self) -> bool {
        let reach = self.round_off.reach(self.length);
        self.travel.radians * self.length <= self.round_off.way(S::zero(), reach)
    }
}
