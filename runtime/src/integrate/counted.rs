//! What an integration costs.

use super::{AlphaEnd, AlphaStep, System};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// What an integration has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Evaluations of the rates.
    pub evaluations: usize,
    /// Steps that were accepted.
    pub accepted: usize,
    /// Steps that were tried and rejected.
    pub rejected: usize,
}

impl Counts {
    /// These without so many evaluations.
    pub(crate) fn without(self, evaluations: usize) -> Self {
        Self {
            evaluations: self.evaluations.saturating_sub(evaluations),
            ..self
        }
    }

    /// These and those of a course that went on.
    pub(crate) fn plus(self, more: Self) -> Self {
        Self {
            evaluations: self.evaluations.saturating_add(more.evaluations),
            accepted: self.accepted.saturating_add(more.accepted),
            rejected: self.rejected.saturating_add(more.rejected),
        }
    }
}

/// A system that counts its evaluations.
pub(super) struct Counted<'a, Y> {
    pub(super) system: &'a mut Y,
    pub(super) counts: &'a mut Counts,
}

impl<S: Real, Y: System<S>> System<S> for Counted<'_, Y> {
    type State = Y::State;

    #[inline(always)]
    fn rates(&mut self, time: S, state: &Y::State) -> Result<Y::State, Fault> {
        self.counts.evaluations += 1;
        self.system.rates(time, state)
    }

    #[inline(always)]
    fn stage(&mut self, time: S, state: &Y::State, rates: &mut Y::State) -> Result<(), Fault> {
        self.counts.evaluations += 1;
        self.system.stage(time, state, rates)
    }

    fn jacobian(
        &mut self,
        time: S,
        state: &Y::State,
        rates: &Y::State,
        columns: &mut <Y::State as Vector<S>>::Each<Y::State>,
    ) -> Result<usize, Fault> {
        let evaluations = self.system.jacobian(time, state, rates, columns)?;
        self.counts.evaluations += evaluations;
        Ok(evaluations)
    }

    #[inline(always)]
    fn with_new_velocities(
        &mut self,
        time: S,
        state: &Y::State,
        step: S,
        rates: &mut Y::State,
    ) -> Result<(), Fault> {
        self.system.with_new_velocities(time, state, step, rates)
    }

    fn step_on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, Y::State>,
    ) -> Result<AlphaEnd<Y::State>, Fault> {
        let end = self.system.step_on_constraints(asked)?;
        self.counts.evaluations += end.evaluations;
        Ok(end)
    }

    #[inline(always)]
    fn settle(&mut self, state: &mut Y::State, rates: Option<&mut Y::State>) {
        self.system.settle(state, rates);
    }
}
