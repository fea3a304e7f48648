//! Steps of a driver: where an integration begins and ends, and what becomes of a step.

use crate::dynamics::equations::Exchanged;
use crate::error::Fault;
use crate::integrate::TimeSpan;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt, at};
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::{Begun, Driver, Taken};
use crate::run::within::judge;
use crate::run::worked::{begin_to_watch, worked};

/// Of how many steps a closure is asked twice at the end, beside the first ones: now and then, at
/// the cost of three calls.
const ASKED_TWICE: usize = 1024;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Where (s) an integration ends that begins at a time, at the latest: at a break, a controller
    /// or a switch of the time alone.
    pub(crate) fn next_end(&mut self, from: S, end: S) -> Result<S, Fault> {
        let until = next_break(M::REPORT.time.breaks, self.breaks, from, end);
        let until = self.hybrid.next_instant(until);
        self.next_switch(from, until)
    }

    /// Begins an integration.
    pub(crate) fn start(
        &mut self,
        span: TimeSpan<S>,
        last_good: &StateAt<S, M>,
    ) -> Result<Begun<S>, Fault> {
        self.march.start(span, &last_good.bodies)?;
        if let (Some(monitor), false) = (&mut self.monitor, self.passing.goes_on(span.start)) {
            monitor.restart();
            begin_to_watch(monitor, self.march, &last_good.bodies);
        }
        Ok(Begun {
            start: span.start,
            of_monitor: 0,
        })
    }

    /// Ends an integration.
    pub(crate) fn end(&mut self, begun: &Begun<S>) {
        let counts = self.march.counts().without(begun.of_monitor);
        self.counts = self.counts.plus(counts);
    }

    /// Corrects what a step has reached, shows it to the monitor, and accepts it.
    #[inline(always)]
    pub(crate) fn commit(
        &mut self,
        taken: &Taken<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        match &taken.event {
            Some(event) => self.observe_event(*event, begun, last_good),
            None => self.observe(taken, begun, last_good),
        }
    }

    /// The power where a step ends, at its end or at an event, and its work where that is asked
    /// for; before it is corrected.
    #[inline]
    fn exchanged(
        &mut self,
        at: At<S, &M::State<S>>,
        is_event: bool,
        begun: &mut Begun<S>,
        near: &M::State<S>,
    ) -> Exchanged<S> {
        let Some(monitor) = self.monitor.as_ref().filter(|it| at.time > it.time()) else {
            return (None, None);
        };
        let (exchanged, looks) = worked(monitor, self.march, at, is_event, near);
        if looks > 1 || looks > 0 && (self.corrects() || self.settings.interacts) {
            begun.of_monitor = begun.of_monitor.saturating_add(looks);
        }
        exchanged
    }

    /// Whether what looks into a step have evaluated is of use to the run.
    pub(crate) fn shares_looks(&self, taken: &Taken<S, M>, was_interpolated: bool) -> bool {
        if was_interpolated {
            // With reports, which find what interpolation needs where a look has evaluated it, or
            // evaluate for each time anew.
            self.march.counts().evaluations == taken.looks.evaluations
        } else {
            // Or as the slope at the start of the next step.
            taken.looks.looks <= 1 && !self.corrects() && !self.settings.interacts
        }
    }

    /// Ends a run that has evaluated more often than it may.
    pub(crate) fn keep_to(&self, budget: usize, begun: &Begun<S>) -> Result<(), Fault> {
        let evaluations = self.march.counts().without(begun.of_monitor).evaluations;
        if evaluations < budget {
            return Ok(());
        }
        Err(Fault::Budget {
            evaluations: self.counts.evaluations.saturating_add(evaluations),
            joint: None,
        })
    }

    /// Corrects the end of the last step, and shows it to the monitor, with where a rule of higher
    /// order would have led.
    #[inline(always)]
    fn observe(
        &mut self,
        taken: &Taken<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        let time = taken.end;
        if self.may_defer() && self.march.defers(time - last_good.time) {
            last_good.time = time;
            self.steps = self.steps.saturating_add(1);
            self.unseen += 1;
            return Ok(());
        }
        let mut state = self.march.bodies(&last_good.bodies);
        let exchanged = self.exchanged(at(time, &state), false, begun, &last_good.bodies);
        if self.corrects() {
            state = self.corrected(time, state)?;
            self.march.replace(&state);
        }
        if self.settings.interacts {
            self.march.hold_modes(&mut state)?;
        }
        if let Some(monitor) = &mut self.monitor {
            if let Some(better) = &taken.better {
                judge(monitor, self.march.equations(), (time, &state), better);
            }
            let estimate = self.march.estimate();
            let equations = self.march.equations_mut();
            equations.monitor(monitor, at(time, &state), estimate, exchanged);
        }
        self.accept(time, state, last_good)
    }

    /// Whether bodies are of no use before somebody looks: nothing reads the end of each step.
    #[inline]
    fn may_defer(&self) -> bool {
        let reads = self.monitor.is_some() || self.stabilisation.is_some();
        self.settings.may_defer && M::SEPARATIONS.is_empty() && self.hybrid.is_empty && !reads
    }

    /// Converts the last good state to bodies, if that was deferred.
    #[inline]
    pub(crate) fn convert(&mut self, last_good: &mut StateAt<S, M>) {
        if self.settings.may_defer {
            self.march.convert(&mut last_good.bodies);
        }
    }

    /// The same of an event within the last step, with the bodies there.
    #[inline(never)]
    fn observe_event(
        &mut self,
        At { time, mut bodies }: StateAt<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        self.passing.ends_with_a_jump();
        let exchanged = self.exchanged(at(time, &bodies), true, begun, &last_good.bodies);
        if self.corrects() {
            bodies = self.corrected(time, bodies)?;
        }
        if self.monitor.is_some() {
            self.march.equations_mut().see_pivot(time, &bodies);
        }
        // A mode may end where the step began: no step to look at.
        if self.settings.interacts && time <= last_good.time {
            *last_good = At { time, bodies };
            self.unseen += 1;
            return Ok(());
        }
        if let Some(monitor) = &mut self.monitor {
            let estimate = self.march.estimate();
            let equations = self.march.equations_mut();
            equations.monitor(monitor, at(time, &bodies), estimate, exchanged);
        }
        self.accept(time, bodies, last_good)
    }

    /// Takes a state, and the bodies in it, as the last good one.
    #[inline(always)]
    fn accept(
        &mut self,
        time: S,
        state: M::State<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        if let Some(monitor) = &mut self.monitor {
            let unconverged = self.march.equations().iterations().unconverged;
            monitor.accept_unconverged_evaluations(unconverged, time);
        }
        self.steps = self.steps.saturating_add(1);
        if self.steps.is_power_of_two() || self.steps.is_multiple_of(ASKED_TWICE) {
            let before = last_good.borrowed();
            self.march.equations().ask_twice((time, &state), before)?;
        }
        *last_good = At {
            time,
            bodies: state,
        };
        self.unseen += 1;
        Ok(())
    }
}

/// The first break after a time, of those of the description and those of a run, or the end.
fn next_break<S: Real>(described: &[f64], breaks: &[S], from: S, end: S) -> S {
    let described = described.iter().map(|&time| S::constant(time));
    let beyond = |time: S, bound: S| time - bound > S::constant(16.0) * bound.max(time).ulp();
    described
        .chain(breaks.iter().copied())
        .filter(|&time| beyond(time, from) && beyond(end, time))
        .fold(end, S::min)
}
