//! A run from its start to its end: integrations, what is done between two of them, and who is
//! shown what.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::companion::Companion;
use crate::run::leg::{Begun, Leg, Taken};
use crate::run::observed::Observed;
use crate::run::past::Past;
use crate::run::report::RunReport;

impl<S: Real, M: Mechanism> Observed<'_, S, M> {
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
        let mut leg = Leg::at(begun?);
        while leg.from < end && self.log.flow.is_continue() {
            if let Err(fault) = self.integrate(&mut leg, last_good, past.take()) {
                self.driver.convert(last_good);
                return Err(self.driver.explained(fault, *last_good));
            }
        }
        Ok(self.report(*last_good))
    }

    /// Integrates up to where the integration begins anew, and does what is to be done there.
    fn integrate(
        &mut self,
        leg: &mut Leg<S, M>,
        last_good: &mut StateAt<S, M>,
        past: Option<&Past<'_, S, M>>,
    ) -> Result<(), Fault> {
        let first_output = self.schedule.first(leg.from);
        if self.driver.open(leg, first_output, last_good, past)? {
            self.step_on(leg, last_good)?;
        } else if self.schedule.at(last_good.time, self.driver.course.unseen) {
            self.show(last_good.time, &last_good.bodies);
        }
        if self.driver.close(leg, last_good) {
            self.happen(last_good)?;
            self.keep_between(last_good)?;
        }
        Ok(())
    }

    /// Takes the steps of the integration under way, up to the first event: of each what lies
    /// within is shown, its end is accepted, and that is shown.
    fn step_on(&mut self, leg: &mut Leg<S, M>, last_good: &mut StateAt<S, M>) -> Result<(), Fault> {
        let Leg {
            until,
            under_way: Some(begun),
            taken,
            ..
        } = leg
        else {
            return Ok(());
        };
        let until = *until;
        while taken.end < until {
            if !self.driver.take(last_good, until - last_good.time, taken)? {
                break;
            }
            self.look_within(taken, begun, last_good)?;
            if self.log.flow.is_break() {
                break;
            }
            self.driver.commit(taken, begun, last_good)?;
            self.look_at_end(taken, last_good);
            if self.log.flow.is_break() {
                break;
            }
            if last_good.time < until {
                self.driver.keep_to_budget(begun, 0)?;
            }
            if taken.event.is_some() {
                break;
            }
            #[cfg(feature = "std")]
            if self.keeps_now() && last_good.time < until {
                self.keep(Some(begun), last_good)?;
                if self.log.flow.is_break() {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Hands over a checkpoint between two integrations, or at the end of the run.
    #[cfg(feature = "std")]
    fn keep_between(&mut self, last_good: &StateAt<S, M>) -> Result<(), Fault> {
        let end = self.driver.course.hybrid.end;
        let is_due = last_good.time >= end || self.keeps_now();
        if self.keeps() && is_due && self.log.flow.is_continue() {
            self.keep(None, last_good)?;
        }
        Ok(())
    }

    #[cfg(not(feature = "std"))]
    #[inline(always)]
    fn keep_between(&self, _: &StateAt<S, M>) -> Result<(), Fault> {
        Ok(())
    }

    /// Begins at the start (s): evaluates, calls controllers, shows the state.
    fn begin(&mut self, interval: (S, S), last_good: &mut StateAt<S, M>) -> Result<S, Fault> {
        let (start, _) = interval;
        if self.driver.begin(interval, last_good)? {
            self.log.stop();
        }
        #[cfg(feature = "std")]
        self.begin_records(start, true);
        if self.log.flow.is_continue() {
            self.show(start, &last_good.bodies);
        }
        self.driver.begin_to_watch(interval, last_good)?;
        Ok(start)
    }

    /// Shows what lies within a step: to trajectories, and to the observer.
    #[inline(always)]
    fn look_within(
        &mut self,
        taken: &Taken<S, M>,
        begun: &mut Begun<S>,
        last_good: &mut StateAt<S, M>,
    ) -> Result<(), Fault> {
        let reached = taken.reached();
        #[cfg(feature = "std")]
        let is_recorded = {
            let at_end = taken.event.as_ref().map(|event| &event.bodies);
            self.record_within((reached, at_end), last_good)?
        };
        #[cfg(not(feature = "std"))]
        let is_recorded = false;
        let has_reported = self.report_within(reached, last_good)?;
        if self.log.flow.is_continue() {
            self.driver
                .count_looks(taken, begun, has_reported || is_recorded);
        }
        Ok(())
    }

    /// Shows the end of a step as it was accepted. An event is shown with what happens there.
    #[inline(always)]
    fn look_at_end(&mut self, taken: &Taken<S, M>, last_good: &mut StateAt<S, M>) {
        #[cfg(feature = "std")]
        self.record_end(last_good);
        if taken.event.is_none() && self.schedule.at(last_good.time, self.driver.course.unseen) {
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
            .course
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
    fn report(self, at: StateAt<S, M>) -> RunReport<S, M> {
        RunReport {
            worst_violation: self.log.worst_violation,
            stopped: self.log.flow.is_break(),
            verification: self.companion.map(Companion::found),
            ..self.driver.report(None, at)
        }
    }
}
