//! A second run beside the first, by which the error of the first is estimated.
//!
//! Indicators look at single steps. How errors grow over many steps (orbits, falls from the
//! upright, chaos, closures that jump) only a second run tells. It has another tolerance or step
//! and goes from report to report with the first. Their difference is about the error of the
//! coarser one. A bias that does not go with the steps, as of a penalty, is made another one.
//!
//! It is led as the first run is, with interactions and sides of laws of its own. Nobody looks on,
//! and there are no handlers: what they do cannot be done twice.

use crate::error::Fault;
use crate::integrate::TimeSpan;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::{Begun, Driver, Taken};
use crate::run::output::Schedule;
use crate::run::verification::Verification;

/// The second run, under way.
pub(crate) struct Companion<'c, S: Real, M: Mechanism> {
    driver: Driver<'c, S, M>,
    /// As that of the first run, which tells the method when output is asked for.
    schedule: Schedule<S>,
    /// When (s) and how its bodies stood last, as accepted.
    at: StateAt<S, M>,
    has_begun: bool,
    /// The integration under way, and when (s) it ends.
    segment: Option<(Begun<S>, S)>,
    /// The last step, and whether it is still to be accepted: it lies beyond the last report, or
    /// has just been reached.
    taken: Taken<S, M>,
    is_open: bool,
    found: Verification<S, M>,
}

impl<'c, S: Real, M: Mechanism> Companion<'c, S, M> {
    pub(crate) fn new(
        driver: Driver<'c, S, M>,
        schedule: Schedule<S>,
        (time, bodies): (S, &M::State<S>),
    ) -> Self {
        Self {
            driver,
            schedule,
            at: At {
                time,
                bodies: *bodies,
            },
            has_begun: false,
            segment: None,
            taken: Taken::none(),
            is_open: false,
            found: Verification::nothing(),
        }
    }

    /// Compares with the bodies of the first run at a time (s); the bodies of the companion there,
    /// where it stands beside it.
    pub(crate) fn compare(&mut self, time: S, bodies: &M::State<S>) -> Option<M::State<S>> {
        if self.found.ended.is_some() {
            return None;
        }
        match self.reach(time) {
            Ok(there) => {
                self.found.compare(time, bodies, &there);
                Some(there)
            }
            Err(fault) => {
                self.found.ended = Some((self.reached(), fault));
                None
            }
        }
    }

    pub(crate) fn found(mut self) -> Verification<S, M> {
        self.end_segment();
        self.found.evaluations = self.driver.counts.evaluations;
        self.found
    }

    fn reached(&self) -> S {
        if self.is_open {
            self.taken.end
        } else {
            self.at.time
        }
    }

    /// The bodies at a time (s), which is not before any that was asked for.
    fn reach(&mut self, time: S) -> Result<M::State<S>, Fault> {
        if !self.has_begun {
            self.has_begun = true;
            self.driver.begin_events(&mut self.at)?;
        }
        loop {
            if self.is_open {
                let event = self.taken.event.as_ref();
                let reached = event.map_or(self.taken.end, |event| event.time);
                if reached > time {
                    let bodies = self
                        .driver
                        .march
                        .within((self.at.time, &self.at.bodies), time)?;
                    let bodies = self.driver.stabilised_if(time, bodies)?;
                    self.at = At { time, bodies };
                    return Ok(self.at.bodies);
                }
                self.accept(reached)?;
            } else if self.at.time >= time {
                return Ok(self.at.bodies);
            } else {
                self.advance()?;
            }
        }
    }

    /// Takes a step, or goes across a length of zero.
    fn advance(&mut self) -> Result<(), Fault> {
        let (begun, until) = match self.segment.take() {
            Some(segment) => segment,
            None => match self.begin()? {
                Some(segment) => segment,
                None => return Ok(()),
            },
        };
        self.segment = Some((begun, until));
        let left = until - self.at.time;
        self.is_open = self.driver.take(&mut self.at, left, &mut self.taken)?;
        if !self.is_open {
            self.end_segment();
            self.driver.passing.has_refused(self.at.time);
            return Ok(());
        }
        let budget = self.driver.settings.budget;
        let budget = budget.saturating_sub(self.driver.counts.evaluations);
        self.driver.keep_to(budget.saturating_add(1), &begun)
    }

    /// Begins an integration, with its end (s); `None` where the companion goes across a length of
    /// zero instead.
    fn begin(&mut self) -> Result<Option<(Begun<S>, S)>, Fault> {
        let from = self.at.time;
        let until = self.driver.next_end(from, self.driver.hybrid.end)?;
        self.driver.passing.begin();
        let until = self.driver.passing.end(from, until);
        self.driver.leave_zeros(&mut self.at, until - from);
        if self.driver.goes_across(&mut self.at, until)? {
            self.driver.passing.has_refused(self.at.time);
            self.instant(until - from)?;
            return Ok(None);
        }
        let span = TimeSpan {
            start: from,
            end: until,
            first_output: self.schedule.first_after(from).min(until - from),
        };
        let begun = self.driver.start(span, &self.at)?;
        Ok(Some((begun, until)))
    }

    /// Accepts what the last step has reached (s), as the first run accepts its own.
    fn accept(&mut self, reached: S) -> Result<(), Fault> {
        self.is_open = false;
        let Some((mut begun, until)) = self.segment else {
            return Ok(());
        };
        let taken = &self.taken;
        self.driver.commit(taken, &mut begun, &mut self.at)?;
        let is_event = self.taken.event.is_some();
        if is_event || reached >= until {
            let length = until - begun.start;
            self.end_segment();
            self.driver.convert(&mut self.at);
            self.driver.passing.has_refused(self.at.time);
            self.instant(length)?;
        }
        self.driver.convert(&mut self.at);
        Ok(())
    }

    /// What is done between two integrations, of which the last one had so many seconds.
    fn instant(&mut self, length: S) -> Result<(), Fault> {
        self.driver.leave_zeros(&mut self.at, length);
        if self.driver.hybrid.is_empty {
            return Ok(());
        }
        let is_found = core::mem::take(&mut self.driver.hybrid.is_found);
        let is_turned = self.driver.turn(self.at.time, &self.at.bodies)?;
        self.driver.act(is_found || is_turned, &mut self.at)?;
        Ok(())
    }

    fn end_segment(&mut self) {
        if let Some((begun, _)) = self.segment.take() {
            self.driver.end(&begun);
        }
    }
}
