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
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;
use crate::run::output::Schedule;
use crate::run::pulled::{Pulled, Way};
use crate::run::verification::Verification;

/// The second run, under way.
pub(crate) struct Companion<'c, S: Real, M: Mechanism> {
    driver: Driver<'c, S, M>,
    /// As that of the first run, which tells the method when output is asked for.
    schedule: Schedule<S>,
    way: Way<S, M>,
    has_begun: bool,
    found: Verification<S, M>,
}

impl<'c, S: Real, M: Mechanism> Companion<'c, S, M> {
    pub(crate) fn new(driver: Driver<'c, S, M>, schedule: Schedule<S>, at: StateAt<S, M>) -> Self {
        Self {
            driver,
            schedule,
            way: Way::from(at),
            has_begun: false,
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
                self.found.ended = Some((self.way.reached(), fault));
                None
            }
        }
    }

    pub(crate) fn found(mut self) -> Verification<S, M> {
        self.driver.close(&mut self.way.leg, &mut self.way.at);
        self.found.evaluations = self.driver.course.counts.evaluations;
        self.found
    }

    /// The bodies at a time (s), which is not before any that was asked for.
    fn reach(&mut self, time: S) -> Result<M::State<S>, Fault> {
        if !self.has_begun {
            self.has_begun = true;
            self.driver.begin_events(&mut self.way.at)?;
        }
        let schedule = self.schedule;
        let first_output = |from: S| schedule.first_after(from);
        loop {
            let pulled = self.driver.pull(&mut self.way, time, &first_output)?;
            if matches!(pulled, Pulled::Time) {
                return Ok(self.way.at.bodies);
            }
        }
    }
}
