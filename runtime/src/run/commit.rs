//! What becomes of a step: its end is corrected, shown to the monitor and accepted.

use crate::dynamics::equations::Exchanged;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt, at};
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;
use crate::run::leg::{Begun, Taken};
use crate::run::within::{Looks, judge};
use crate::run::worked::worked;

/// Of how many steps a closure is asked twice at the end, beside the first ones: now and then, at
/// the cost of three calls.
const ASKED_TWICE: usize = 1024;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
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
        let Some(monitor) = self
            .course
            .monitor
            .as_ref()
            .filter(|it| at.time > it.time())
        else {
            return (None, None);
        };
        let (exchanged, looks) = worked(monitor, self.march, at, is_event, near);
        if looks > 1 || looks > 0 && (self.corrects() || self.course.settings.interacts) {
            begun.of_monitor = begun.of_monitor.saturating_add(looks);
        }
        exchanged
    }

    /// Counts what looks into a step have evaluated as that of the monitor, unless it is of use to
    /// the run.
    #[inline]
    pub(crate) fn count_looks(
        &self,
        taken: &Taken<S, M>,
        begun: &mut Begun<S>,
        was_interpolated: bool,
    ) {
        let Looks { looks, evaluations } = taken.looks;
        let is_shared = if was_interpolated {
            // With reports, which find what interpolation needs where a look has evaluated it, or
            // evaluate for each time anew.
            self.march.counts().evaluations == evaluations
        } else {
            // Or as the slope at the start of the next step.
            looks <= 1 && !self.corrects() && !self.course.settings.interacts
        };
        if looks > 0 && !is_shared {
            begun.of_monitor = begun.of_monitor.saturating_add(looks);
        }
    }

    /// Ends a run that has evaluated as often as it may, or so many times more.
    #[inline]
    pub(crate) fn keep_to_budget(&self, begun: &Begun<S>, more: usize) -> Result<(), Fault> {
        let budget = self.course.settings.budget;
        if budget == usize::MAX {
            return Ok(());
        }
        let evaluations = self.counts_with(begun).evaluations;
        if evaluations < budget.saturating_add(more) {
            return Ok(());
        }
        Err(Fault::Step(StepFault::Budget {
            evaluations,
            joint: None,
        }))
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
            self.course.steps = self.course.steps.saturating_add(1);
            self.course.unseen += 1;
            return Ok(());
        }
        let mut state = self.march.bodies(&last_good.bodies);
        let exchanged = self.exchanged(at(time, &state), false, begun, &last_good.bodies);
        if self.corrects() {
            state = self.corrected(time, state)?;
            self.march.replace(&state);
        }
        if self.course.settings.interacts {
            self.march.hold_modes(&mut state)?;
        }
        if let Some(monitor) = &mut self.course.monitor {
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
        let reads = self.course.monitor.is_some() || self.stabilisation.is_some();
        self.course.settings.may_defer
            && M::SEPARATIONS.is_empty()
            && self.course.hybrid.is_empty
            && !reads
    }

    /// Converts the last good state to bodies, if that was deferred.
    #[inline]
    pub(crate) fn convert(&mut self, last_good: &mut StateAt<S, M>) {
        if self.course.settings.may_defer {
            self.march.convert(&mut last_good.bodies);
        }
    }

    /// The same of an event within the last step, with the bodies there.
    #[inline(never)]
    pub(crate) fn observe_event(
        &mut self,
        At { time, mut bodies }: StateAt<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        self.course.passing.ends_with_a_jump();
        let exchanged = self.exchanged(at(time, &bodies), true, begun, &last_good.bodies);
        if self.corrects() {
            bodies = self.corrected(time, bodies)?;
        }
        if self.course.monitor.is_some() {
            self.march.equations_mut().see_pivot(time, &bodies);
        }
        // A mode may end where the step began: no step to look at.
        if self.course.settings.interacts && time <= last_good.time {
            *last_good = At { time, bodies };
            self.course.unseen += 1;
            return Ok(());
        }
        if let Some(monitor) = &mut self.course.monitor {
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
        if let Some(monitor) = &mut self.course.monitor {
            let unconverged = self.march.equations().iterations().unconverged;
            monitor.accept_unconverged_evaluations(unconverged, time);
        }
        self.course.steps = self.course.steps.saturating_add(1);
        if self.course.steps.is_power_of_two() || self.course.steps.is_multiple_of(ASKED_TWICE) {
            let before = last_good.borrowed();
            self.march.equations().ask_twice((time, &state), before)?;
        }
        *last_good = At {
            time,
            bodies: state,
        };
        self.course.unseen += 1;
        Ok(())
    }
}
