//! Where the integrations of a driver begin and end.

use crate::error::Fault;
use crate::integrate::TimeSpan;
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::paced::end_of_step;
use crate::run::driver::Driver;
use crate::run::leg::{Begun, Leg};
use crate::run::past::Past;
use crate::run::worked::begin_to_watch;
use crate::stepping::watch::is_same;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Begins a run at the start of its interval (s): evaluates where that has no length, and calls
    /// controllers. Whether one stops the run.
    pub(crate) fn begin(
        &mut self,
        (start, end): (S, S),
        at: &mut StateAt<S, M>,
    ) -> Result<bool, Fault> {
        if start == end {
            let equations = self.march.equations_mut();
            let evaluated = equations.evaluate_once(start, &at.bodies);
            evaluated.map_err(|fault| self.explained(fault, *at))?;
            self.course.counts.evaluations += 1;
        }
        self.begin_events(at)
    }

    /// Shows the start to the monitor, and asks closures twice, before the first step.
    pub(crate) fn begin_to_watch(
        &mut self,
        (start, end): (S, S),
        at: &StateAt<S, M>,
    ) -> Result<(), Fault> {
        if start == end {
            return Ok(());
        }
        let equations = self.march.equations();
        if let Some(monitor) = &mut self.course.monitor {
            equations.begin(monitor, start, &at.bodies);
        }
        equations.ask_twice((start, &at.bodies), (end, &at.bodies))
    }

    /// Begins an integration, which asks for output after so many seconds, or goes on with that of
    /// a checkpoint. False where it goes across a length of zero instead.
    pub(crate) fn open(
        &mut self,
        leg: &mut Leg<S, M>,
        first_output: S,
        at: &mut StateAt<S, M>,
        past: Option<&Past<'_, S, M>>,
    ) -> Result<bool, Fault> {
        let from = leg.from;
        let end = self.next_end(from, self.course.hybrid.end)?;
        let until = self.slowed_end(from, end);
        let under_way = past.and_then(|past| Some((past, past.segment?)));
        if under_way.is_none() {
            self.course.passing.begin();
        }
        leg.until = self.course.passing.end(from, until);
        if past.is_none() {
            self.leave_zeros(at, leg.until - from);
        }
        let span = TimeSpan {
            start: from,
            end: leg.until,
            first_output: first_output.min(leg.until - from),
        };
        // Steps that slip makes short grow as others do.
        let whole = (if until < end { end } else { leg.until }) - from;
        let begun = match under_way {
            Some((past, segment)) => self.go_on((span, whole), &segment, past)?,
            None if self.goes_across(at, leg.until)? => return Ok(false),
            None => self.start((span, whole), at)?,
        };
        leg.under_way = Some(begun);
        leg.taken.end = self.march.time();
        Ok(true)
    }

    /// Ends the integration under way, if there is one. False after a step that must be shorter: at
    /// that instant nothing happens.
    pub(crate) fn close(&mut self, leg: &mut Leg<S, M>, at: &mut StateAt<S, M>) -> bool {
        if let Some(begun) = leg.under_way.take() {
            self.course.counts = self.counts_with(&begun);
        }
        self.convert(at);
        let length = leg.until - leg.from;
        leg.from = at.time;
        if self.course.passing.has_refused(at.time) {
            return false;
        }
        self.leave_zeros(at, length);
        true
    }

    /// Where (s) an integration ends that begins at a time, at the latest: at a break, a
    /// controller, a given time of a handler or a switch of the time alone.
    fn next_end(&mut self, from: S, end: S) -> Result<S, Fault> {
        let until = next_break(M::REPORT.time.breaks, self.breaks, from, end);
        let until = self.next_instant(until);
        self.next_switch(from, until)
    }

    /// The same where slip that turns lets a step go less far.
    fn slowed_end(&self, from: S, end: S) -> S {
        let interactions = self.march.equations().interactions();
        let tolerance = self.course.settings.tolerance;
        end_of_step(interactions, (from, end), tolerance)
    }

    /// The next instant (s) of a controller or of a handler at given times, up to a time.
    fn next_instant(&mut self, until: S) -> S {
        let mut next = until;
        let _ = self.list.each(&mut |happening| {
            let of_controller = happening.period().map(|period| period.next());
            let of_handler = happening.next_time().map(|(time, _)| time);
            let instants = of_controller.into_iter().chain(of_handler);
            next = instants
                .filter(|&instant| !is_same(instant, until))
                .fold(next, S::min);
            Ok(())
        });
        next
    }

    /// Begins an integration.
    fn start(
        &mut self,
        (span, whole): (TimeSpan<S>, S),
        at: &StateAt<S, M>,
    ) -> Result<Begun<S>, Fault> {
        self.march.start(span, whole, &at.bodies)?;
        self.know_factors(at)?;
        let goes_on = self.course.passing.goes_on(span.start);
        if let (Some(monitor), false) = (&mut self.course.monitor, goes_on) {
            monitor.restart();
            begin_to_watch(monitor, self.march, &at.bodies);
        }
        Ok(Begun {
            start: span.start,
            of_monitor: 0,
        })
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
