//! A run from its start to its end: segments of integration between breaks, what is done between
//! two of them, and who is shown what.

use crate::error::Fault;
use crate::integrate::TimeSpan;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::companion::Companion;
use crate::run::driver::{Begun, Driver, Taken};
use crate::run::past::Past;
use crate::run::report::RunReport;
use crate::run::under_way::Run;

impl<S: Real, M: Mechanism> Run<'_, S, M> {
    /// Goes from a state to the end; keeps the last good state.
    pub(crate) fn go(
        mut self,
        (start, end): (S, S),
        last_good: &mut StateAt<S, M>,
        mut past: Option<&Past<'_, S, M>>,
    ) -> Result<RunReport<S, M>, Fault> {
        self.driver.leave_zeros(last_good, end - start);
        let begun = match past {
            Some(past) => self.take_past(past, last_good),
            None => self.begin((start, end), last_good),
        };
        let mut from = begun?;
        while from < end && self.log.flow.is_continue() {
            let reached = self.integrate((from, end), last_good, past.take());
            from = reached.map_err(|fault| self.driver.explained(fault, *last_good))?;
        }
        Ok(self.report(*last_good))
    }

    /// Integrates up to where the integration begins anew (s), and does what is to be done there.
    fn integrate(
        &mut self,
        (from, end): (S, S),
        last_good: &mut StateAt<S, M>,
        past: Option<&Past<'_, S, M>>,
    ) -> Result<S, Fault> {
        let mut until = self.driver.next_end(from, end)?;
        let is_between = past.is_none_or(|past| past.segment.is_none());
        if is_between {
            self.driver.passing.begin();
        }
        until = self.driver.passing.end(from, until);
        if past.is_none() {
            self.driver.leave_zeros(last_good, until - from);
        }
        let span = TimeSpan {
            start: from,
            end: until,
            first_output: self.schedule.first(from).min(until - from),
        };
        if is_between && self.driver.goes_across(last_good, until)? {
            if self.schedule.at(last_good.time, self.driver.unseen) {
                self.show(last_good.time, &last_good.bodies);
            }
        } else {
            let reached = self.segment(span, last_good, past);
            self.driver.convert(last_good);
            reached?;
        }
        if self.driver.passing.has_refused(last_good.time) {
            return Ok(last_good.time);
        }
        self.driver.leave_zeros(last_good, until - from);
        self.happen(last_good)?;
        self.keep_between(last_good, end)?;
        Ok(last_good.time)
    }

    /// Hands over a checkpoint between two integrations, or at the end of the run.
    #[cfg(feature = "std")]
    fn keep_between(&mut self, last_good: &StateAt<S, M>, end: S) -> Result<(), Fault> {
        let is_due = last_good.time >= end || self.keeps_now();
        if self.keeps() && is_due && self.log.flow.is_continue() {
            self.keep(None, last_good)?;
        }
        Ok(())
    }

    #[cfg(not(feature = "std"))]
    #[inline(always)]
    fn keep_between(&self, _: &StateAt<S, M>, _: S) -> Result<(), Fault> {
        Ok(())
    }

    /// Begins at the start (s): evaluates, calls controllers, shows the state.
    fn begin(&mut self, (start, end): (S, S), last_good: &mut StateAt<S, M>) -> Result<S, Fault> {
        let driver = &mut self.driver;
        if start == end {
            let equations = driver.march.equations_mut();
            let evaluated = equations.evaluate_once(start, &last_good.bodies);
            evaluated.map_err(|fault| driver.explained(fault, *last_good))?;
            driver.counts.evaluations += 1;
        }
        if driver.begin_events(last_good)? {
            self.log.stop();
        }
        #[cfg(feature = "std")]
        self.begin_records(start, true);
        if self.log.flow.is_continue() {
            self.show(start, &last_good.bodies);
        }
        if start < end {
            let Driver { march, monitor, .. } = &mut self.driver;
            let equations = march.equations();
            if let Some(monitor) = monitor {
                equations.begin(monitor, start, &last_good.bodies);
            }
            let start = (start, &last_good.bodies);
            equations.ask_twice(start, (end, start.1))?;
        }
        Ok(start)
    }

    /// Integrates over an interval without breaks, up to the first event: step by step, each is
    /// taken, then reports within it are made, then its end is observed.
    fn segment(
        &mut self,
        span: TimeSpan<S>,
        last_good: &mut StateAt<S, M>,
        past: Option<&Past<'_, S, M>>,
    ) -> Result<(), Fault> {
        let under_way = past.and_then(|past| Some((past, past.segment?)));
        let mut begun = match under_way {
            Some((past, segment)) => self.go_on(span, &segment, past)?,
            None => self.driver.start(span, last_good)?,
        };
        let budget = self.driver.settings.budget;
        let budget = budget.saturating_sub(self.driver.counts.evaluations);
        let mut taken = Taken::none();
        taken.end = self.driver.march.time();
        while taken.end < span.end {
            let left = span.end - last_good.time;
            if !self.driver.take(last_good, left, &mut taken)? {
                break;
            }
            self.look_within(&taken, &mut begun, last_good)?;
            if self.log.flow.is_break() {
                break;
            }
            self.driver.commit(&taken, &mut begun, last_good)?;
            self.look_at_end(&taken, last_good);
            if self.log.flow.is_break() {
                break;
            }
            if budget < usize::MAX && last_good.time < span.end {
                self.driver.keep_to(budget, &begun)?;
            }
            if taken.event.is_some() {
                break;
            }
            #[cfg(feature = "std")]
            if self.keeps_now() && last_good.time < span.end {
                self.keep(Some(&begun), last_good)?;
                if self.log.flow.is_break() {
                    break;
                }
            }
        }
        self.driver.end(&begun);
        Ok(())
    }

    /// Shows what lies within a step: to trajectories, and to the observer.
    #[inline(always)]
    fn look_within(
        &mut self,
        taken: &Taken<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        let event = taken.event.as_ref();
        let reached = event.map_or(taken.end, |event| event.time);
        #[cfg(feature = "std")]
        let is_recorded = {
            let at_end = event.map(|event| &event.bodies);
            self.record_within((reached, at_end), last_good)?
        };
        #[cfg(not(feature = "std"))]
        let is_recorded = false;
        let has_reported = self.report_within(reached, last_good)?;
        if taken.looks.looks > 0
            && self.log.flow.is_continue()
            && !self.driver.shares_looks(taken, has_reported || is_recorded)
        {
            begun.of_monitor = begun.of_monitor.saturating_add(taken.looks.looks);
        }
        Ok(())
    }

    /// Shows the end of a step as it was accepted. An event is shown with what happens there.
    #[inline(always)]
    fn look_at_end(&mut self, taken: &Taken<S, M>, last_good: &mut StateAt<S, M>) {
        #[cfg(feature = "std")]
        self.record_end(last_good);
        if taken.event.is_none() && self.schedule.at(last_good.time, self.driver.unseen) {
            self.driver.convert(last_good);
            self.show(last_good.time, &last_good.bodies);
        }
    }

    /// Shows the states at reporting times within the last step up to a time, until the observer
    /// stops; whether there are any.
    #[inline]
    fn report_within(&mut self, reached: S, last_good: &mut StateAt<S, M>) -> Result<bool, Fault> {
        let mut start = None;
        while let Some(time) = self.schedule.within(reached) {
            start.get_or_insert_with(|| (self.driver.march.equations().seen(), *last_good));
            let near = (
                last_good.time - self.driver.march.deferred_since(),
                &last_good.bodies,
            );
            let mut state = self.driver.march.within(near, time)?;
            if let Some(stabilisation) = self.driver.stabilisation {
                state = self.driver.stabilised(stabilisation, time, state)?;
            }
            *last_good = At {
                time,
                bodies: state,
            };
            self.driver.march.forget_deferred();
            self.show(time, &last_good.bodies);
            if self.log.flow.is_break() {
                break;
            }
        }
        let Some((seen, first)) = start else {
            return Ok(false);
        };
        // What output within the step evaluates is not what the monitor is shown, which is its end.
        self.driver.march.equations_mut().recall(seen);
        // The monitor is not shown this step any more: the one before it was the last.
        if let Some(monitor) = self
            .driver
            .monitor
            .as_mut()
            .filter(|_| self.log.flow.is_break())
        {
            let constants = self.driver.march.equations().constants();
            monitor.end_of_steps(constants, first.time, &first.bodies);
        }
        Ok(true)
    }

    /// The last state is one that was shown.
    fn report(
        mut self,
        At {
            time,
            bodies: state,
        }: StateAt<S, M>,
    ) -> RunReport<S, M> {
        let equations = self.driver.march.equations();
        if let Some(monitor) = &mut self.driver.monitor {
            equations.name_smallest_pivot(monitor);
            monitor.end(equations.constants(), time, &state);
        }
        RunReport {
            evaluations: self.driver.counts.evaluations,
            accepted: self.driver.counts.accepted,
            rejected: self.driver.counts.rejected,
            worst_violation: self.log.worst_violation,
            iterations: equations.iterations(),
            time,
            state,
            stopped: self.log.flow.is_break(),
            verification: self.companion.map(Companion::found),
            monitor: self.driver.monitor,
        }
    }
}
