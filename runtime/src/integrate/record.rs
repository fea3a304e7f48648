//! What every integration under way keeps: where it is, and its last step.

use core::mem::replace;

use super::{Counts, Memory, Scheme, Slopes, StepEnds, StepRecord, System, TimeSpan, named};
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// Where an integration is.
#[derive(Clone)]
pub(super) struct Reached<S, X> {
    pub(super) counts: Counts,
    pub(super) time: S,
    pub(super) state: X,
    /// The slope at `state`, where it is known.
    pub(super) slope: X,
    pub(super) is_known: bool,
    /// The error of the last step, relative to the state, where it is estimated.
    pub(super) estimate: Option<S>,
}

impl<S: Real, X: Vector<S>> Reached<S, X> {
    /// The start, with its slope.
    pub(super) fn start<Y: System<S, State = X>>(
        system: &mut Y,
        span: &TimeSpan<S>,
        state: X,
    ) -> Result<Self, Fault> {
        let mut counts = Counts::default();
        let counted = &mut Slopes::counted(system, &mut counts);
        Ok(Self {
            slope: counted.rates(span.start, &state)?,
            counts,
            time: span.start,
            state,
            is_known: true,
            estimate: None,
        })
    }

    /// Its part of [`Integration::remember`](super::Integration::remember).
    pub(super) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        let Counts {
            evaluations,
            accepted,
            rejected,
        } = &mut self.counts;
        for count in [evaluations, accepted, rejected] {
            memory.count(count);
        }
        memory.number(&mut self.time);
        memory.vector(&mut self.state);
        memory.vector(&mut self.slope);
        memory.flag(&mut self.is_known);
        memory.optional(&mut self.estimate);
    }

    /// Computes the slope, once; refused if it is not finite.
    #[inline]
    pub(super) fn know_slope<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
    ) -> Result<(), Fault> {
        if self.is_known {
            return Ok(());
        }
        let counts = &mut self.counts;
        let (time, state) = (self.time, &self.state);
        let outcome = Slopes::counted(system, counts).stage(time, state, &mut self.slope);
        if outcome.is_err() || !self.slope.is_finite() {
            let fault = named(outcome.err(), system, |system| system.rates(time, state));
            return Err(fault.unwrap_or(Fault::Step(StepFault::StateNotFinite)));
        }
        self.is_known = true;
        Ok(())
    }
}

/// The functions of a [`Integration`](super::Integration) that read and write where it is: its
/// field `reached`.
macro_rules! reached {
    () => {
        fn time(&self) -> S {
            self.reached.time
        }

        fn state(&self) -> &X {
            &self.reached.state
        }

        fn replace(&mut self, state: X) {
            self.reached.state = state;
            self.reached.is_known = false;
        }

        fn recount(&mut self, turns: &[S]) {
            $crate::integrate::put_turns(&mut self.reached.state, turns);
        }

        fn counts(&self) -> Counts {
            self.reached.counts
        }

        fn estimate(&self) -> Option<S> {
            self.reached.estimate
        }
    };
}
pub(super) use reached;

/// The last step, for output within it.
#[derive(Clone)]
pub(super) struct LastStep<S, X> {
    /// The time at its start.
    pub(super) start: S,
    pub(super) step: S,
    /// State and slope at its start.
    pub(super) from: X,
    pub(super) first: X,
}

impl<S: Real, X: Vector<S>> LastStep<S, X> {
    /// Of an integration that has not taken a step.
    pub(super) fn none(at: &Reached<S, X>) -> Self {
        Self {
            start: at.time,
            step: S::zero(),
            from: at.state.clone(),
            first: at.slope.clone(),
        }
    }

    /// Makes an accepted step, which began at `reached`, the last one. The slope at its end is not
    /// known.
    #[inline(always)]
    pub(super) fn take(&mut self, reached: &mut Reached<S, X>, (step, end): (S, S), state: X) {
        // A copy, not an exchange, which would be two: the slope at the end is written anew.
        self.first.clone_from(&reached.slope);
        reached.is_known = false;
        self.go(reached, (step, end), state);
    }

    /// The same, where the slopes at both ends are in place.
    #[inline(always)]
    pub(super) fn go(&mut self, reached: &mut Reached<S, X>, (step, end): (S, S), state: X) {
        reached.counts.accepted += 1;
        self.from.clone_from(&reached.state);
        reached.state = state;
        self.start = replace(&mut reached.time, end);
        self.step = step;
    }

    /// The step as an interpolant sees it.
    #[inline(always)]
    pub(super) fn record<'a, K>(
        &'a self,
        reached: &'a Reached<S, X>,
        stages: &'a K,
    ) -> StepRecord<'a, S, X, K> {
        StepRecord {
            step: self.step,
            from: &self.from,
            first: &self.first,
            stages,
            to: &reached.state,
            last: &reached.slope,
        }
    }

    /// The part of the step at a time within it.
    #[inline(always)]
    pub(super) fn theta(&self, reached: &Reached<S, X>, time: S) -> S {
        (time - self.start).quotient(reached.time - self.start)
    }

    /// Evaluates what the interpolant of a scheme needs besides the slopes.
    pub(super) fn prepare<K: Scheme<S>, Y: System<S, State = X>>(
        &self,
        scheme: &K,
        system: &mut Y,
        reached: &mut Reached<S, X>,
        stages: &mut K::Stages<X>,
    ) -> Result<(), Fault> {
        let ends = StepEnds {
            step: self.step,
            from: &self.from,
            first: &self.first,
            last: &reached.slope,
        };
        let mut counted = Slopes::counted(system, &mut reached.counts);
        scheme.prepare(&mut counted, self.start, ends, stages)
    }
}
