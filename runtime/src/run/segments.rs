//! A run under way: segments of integration between breaks, corrections, reports, and the monitor
//! over them.

use core::ops::ControlFlow;

use crate::error::Fault;
use crate::integrate::{Counts, TimeSpan};
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::Monitor;
use crate::run::companion::Companion;
use crate::run::events::list::Hybrid;
use crate::run::output::Schedule;
use crate::run::passing::Passing;
use crate::run::past::Past;
use crate::run::post_step::PostStabilisation;
use crate::run::report::RunReport;
use crate::run::sample::Sample;
use crate::run::within::judge;
use crate::stepping::marching::{Marching, Settings};

/// A run under way.
pub(crate) struct Run<'r, S: Real, M: Mechanism> {
    /// What is integrated.
    pub(crate) march: &'r mut (dyn Marching<S, M> + 'r),
    pub(crate) settings: Settings<S>,
    /// What is done to states after steps and before reports.
    pub(crate) stabilisation: Option<&'r dyn PostStabilisation<S, M>>,
    pub(crate) schedule: Schedule<S>,
    /// Instants (s) at which the integration begins anew, in any order, besides those of the
    /// description.
    pub(crate) breaks: &'r [S],
    pub(crate) monitor: Option<Monitor<S, M>>,
    /// A second run beside it.
    pub(crate) companion: Option<Companion<'r, S, M>>,
    pub(crate) log: Log<'r, S, M>,
    /// Events and controllers.
    pub(crate) hybrid: Hybrid<'r, S, M>,
    /// Lengths that pass through zero.
    pub(crate) passing: Passing<S>,
    /// Steps so far.
    pub(crate) steps: usize,
    pub(crate) counts: Counts,
    /// How fast (rad/s) a state moved that no correction could bring back.
    pub(crate) gone: Option<S>,
}

/// A step that was taken, and looked into for the monitor. In a place of its own over all steps, as
/// it is long and mostly empty.
pub(super) struct Taken<S: Real, M: Mechanism> {
    /// When it ends (s).
    pub(super) end: S,
    /// The first event within it.
    pub(super) event: Option<(S, M::State<S>)>,
    /// Where a rule of higher order would have led, where that is asked.
    pub(super) better: Option<M::State<S>>,
    /// Evaluations so far, and those of them that looked into the step.
    pub(super) evaluations: usize,
    pub(super) looks: usize,
}

impl<S: Real, M: Mechanism> Taken<S, M> {
    pub(super) fn none() -> Self {
        Self {
            end: S::zero(),
            event: None,
            better: None,
            evaluations: 0,
            looks: 0,
        }
    }
}

/// Of how many steps a closure is asked twice at the end, beside the first ones: now and then, at
/// the cost of three calls.
const ASKED_TWICE: usize = 1024;

/// An integration that was begun.
#[derive(Clone, Copy)]
pub(crate) struct Begun<S> {
    /// When (s).
    #[cfg_attr(
        not(feature = "std"),
        expect(dead_code, reason = "checkpoints and trajectories need a heap")
    )]
    pub(crate) start: S,
    /// What interpolants have evaluated for the monitor, which is no part of the run.
    pub(crate) of_monitor: usize,
}

/// Whom states are shown to. Behind a pointer, so that a run is compiled once for all observers.
pub(crate) type Observer<'o, S, M> = dyn FnMut(&Sample<'_, S, M>) -> ControlFlow<()> + 'o;

/// Shows states to the observer.
pub(crate) struct Log<'r, S: Real, M: Mechanism> {
    observe: &'r mut Observer<'r, S, M>,
    pub(crate) worst_violation: S,
    pub(crate) flow: ControlFlow<()>,
    /// Steps since a state was shown.
    pub(crate) unseen: usize,
}

impl<'r, S: Real, M: Mechanism> Log<'r, S, M> {
    pub(crate) fn new(observe: &'r mut Observer<'r, S, M>) -> Self {
        Self {
            observe,
            worst_violation: S::zero(),
            flow: ControlFlow::Continue(()),
            unseen: 0,
        }
    }

    /// Stops the run.
    pub(crate) fn stop(&mut self) {
        self.flow = ControlFlow::Break(());
    }
}

impl<S: Real, M: Mechanism> Run<'_, S, M> {
    /// Goes from a state to the end; keeps the last good state.
    pub(crate) fn go(
        mut self,
        (start, end): (S, S),
        last_good: &mut (S, M::State<S>),
        mut past: Option<&Past<'_, S, M>>,
    ) -> Result<RunReport<S, M>, Fault> {
        let mut from = start;
        self.leave_zeros(last_good, end - start);
        if let Some(past) = past {
            self.take_past(past)
                .map_err(|fault| self.explained(fault, *last_good))?;
            from = match &past.segment {
                Some(segment) => segment.start,
                None => {
                    self.go_on_with_events(last_good)?;
                    last_good.0
                }
            };
        } else {
            self.begin((start, end), last_good)?;
        }
        while from < end && self.log.flow.is_continue() {
            let mut until = next_break(M::REPORT.time.breaks, self.breaks, from, end);
            until = self.hybrid.next_instant(until);
            until = self
                .next_switch(from, until)
                .map_err(|fault| self.explained(fault, *last_good))?;
            let is_between = past.is_none_or(|past| past.segment.is_none());
            if is_between {
                self.passing.begin();
            }
            until = self.passing.end(from, until);
            if past.is_none() {
                self.leave_zeros(last_good, until - from);
            }
            let span = TimeSpan {
                start: from,
                end: until,
                first_output: self.schedule.first(from).min(until - from),
            };
            if let Some(companion) = &mut self.companion {
                companion.restart(&span, self.stabilisation);
            }
            let reached = if is_between && self.goes_across(last_good, until)? {
                if self.schedule.at(last_good.0, self.log.unseen) {
                    self.show(last_good.0, &last_good.1);
                }
                Ok(())
            } else {
                self.segment(span, last_good, past.take())
            };
            self.convert(last_good);
            if reached.is_ok() && self.passing.has_refused(last_good.0) {
                from = last_good.0;
                continue;
            }
            self.leave_zeros(last_good, until - from);
            reached
                .and_then(|()| self.happen(last_good))
                .and_then(|()| self.keep_between(last_good, end))
                .map_err(|fault| self.explained(fault, *last_good))?;
            from = last_good.0;
        }
        Ok(self.report(*last_good))
    }

    /// Hands over a checkpoint between two integrations, or at the end of the run.
    #[cfg(feature = "std")]
    fn keep_between(&mut self, last_good: &(S, M::State<S>), end: S) -> Result<(), Fault> {
        let is_due = last_good.0 >= end || self.keeps_now();
        if self.keeps() && is_due && self.log.flow.is_continue() {
            self.keep(None, last_good)?;
        }
        Ok(())
    }

    #[cfg(not(feature = "std"))]
    #[inline(always)]
    fn keep_between(&self, _: &(S, M::State<S>), _: S) -> Result<(), Fault> {
        Ok(())
    }

    /// Begins at the start: evaluates, calls controllers, shows the state.
    fn begin(
        &mut self,
        (start, end): (S, S),
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        if start == end {
            let evaluated = self
                .march
                .equations_mut()
                .evaluate_once(start, &last_good.1);
            evaluated.map_err(|fault| self.explained(fault, *last_good))?;
            self.counts.evaluations += 1;
        }
        self.begin_events(last_good)?;
        #[cfg(feature = "std")]
        self.begin_records(start, true);
        if self.log.flow.is_continue() {
            self.show(start, &last_good.1);
        }
        if let Some(monitor) = self.monitor.as_mut().filter(|_| start < end) {
            self.march.equations().begin(monitor, start, &last_good.1);
        }
        if start < end {
            let start = (start, &last_good.1);
            self.march.equations().ask_twice(start, (end, start.1))?;
        }
        Ok(())
    }

    /// Integrates over an interval without breaks, up to the first event: step by step, each is
    /// taken, then reports within it are made, then its end is observed.
    fn segment(
        &mut self,
        span: TimeSpan<S>,
        last_good: &mut (S, M::State<S>),
        past: Option<&Past<'_, S, M>>,
    ) -> Result<(), Fault> {
        let mut begun = self.start(span, last_good, past)?;
        let budget = self.settings.budget;
        let budget = budget.saturating_sub(self.counts.evaluations);
        let mut taken = Taken::none();
        taken.end = self.march.time();
        while taken.end < span.end {
            let left = span.end - last_good.0;
            let longest = self.settings.fixed_step.map_or(left, |step| step.min(left));
            if !self.take(last_good, longest, &mut taken)? {
                break;
            }
            let event = taken.event.as_ref();
            let reached = event.map_or(taken.end, |&(time, _)| time);
            #[cfg(feature = "std")]
            let is_recorded = {
                let at_end = event.map(|(_, bodies)| bodies);
                self.record_within((reached, at_end), last_good)?
            };
            #[cfg(not(feature = "std"))]
            let is_recorded = false;
            let has_reported = self.report_within(reached, last_good)?;
            if self.log.flow.is_break() {
                break;
            }
            if taken.looks > 0 && !self.shares_looks(&taken, has_reported || is_recorded) {
                begun.of_monitor = begun.of_monitor.saturating_add(taken.looks);
            }
            if let Some(&(time, bodies)) = event {
                self.observe_event((time, bodies), last_good)?;
            } else {
                self.observe(taken.end, taken.better.as_ref(), last_good)?;
            }
            #[cfg(feature = "std")]
            self.record_end(last_good);
            let is_event = event.is_some();
            if !is_event && self.schedule.at(last_good.0, self.log.unseen) {
                self.convert(last_good);
                self.show(last_good.0, &last_good.1);
                if self.log.flow.is_break() {
                    break;
                }
            }
            if budget < usize::MAX && last_good.0 < span.end {
                self.keep_to(budget, &begun)?;
            }
            if is_event {
                break;
            }
            #[cfg(feature = "std")]
            if self.keeps_now() && last_good.0 < span.end {
                self.keep(Some(&begun), last_good)?;
                if self.log.flow.is_break() {
                    break;
                }
            }
        }
        let counts = self.march.counts().without(begun.of_monitor);
        self.counts = self.counts.plus(counts);
        Ok(())
    }

    /// Begins an integration, or goes on with the one that was under way.
    fn start(
        &mut self,
        span: TimeSpan<S>,
        last_good: &(S, M::State<S>),
        past: Option<&Past<'_, S, M>>,
    ) -> Result<Begun<S>, Fault> {
        if let Some((past, segment)) = past.and_then(|past| Some((past, past.segment?))) {
            self.go_on(span, &segment, past)?;
            return Ok(Begun {
                start: segment.start,
                of_monitor: segment.of_monitor,
            });
        }
        self.march.start(span, &last_good.1)?;
        if let (Some(monitor), false) = (&mut self.monitor, self.passing.goes_on(span.start)) {
            monitor.restart();
            self.march.monitor_end(monitor, &last_good.1, None);
        }
        Ok(Begun {
            start: span.start,
            of_monitor: 0,
        })
    }

    /// Whether what looks into a step have evaluated is of use to the run.
    fn shares_looks(&self, taken: &Taken<S, M>, was_interpolated: bool) -> bool {
        if was_interpolated {
            // With reports, which find what interpolation needs where a look has evaluated it, or
            // evaluate for each time anew.
            self.march.counts().evaluations == taken.evaluations
        } else {
            // Or as the slope at the start of the next step.
            taken.looks <= 1 && !self.corrects() && !self.settings.interacts
        }
    }

    /// Ends a run that has evaluated more often than it may.
    fn keep_to(&self, budget: usize, begun: &Begun<S>) -> Result<(), Fault> {
        let evaluations = self.march.counts().without(begun.of_monitor).evaluations;
        if evaluations < budget {
            return Ok(());
        }
        Err(Fault::Budget {
            evaluations: self.counts.evaluations.saturating_add(evaluations),
            joint: None,
        })
    }

    /// Shows the states at reporting times within the last step up to a time, until the observer
    /// stops; whether there are any.
    #[inline]
    fn report_within(
        &mut self,
        reached: S,
        last_good: &mut (S, M::State<S>),
    ) -> Result<bool, Fault> {
        let mut start = None;
        while let Some(time) = self.schedule.within(reached) {
            start.get_or_insert_with(|| (self.march.equations().seen(), *last_good));
            let near = (last_good.0 - self.march.deferred_since(), &last_good.1);
            let mut state = self.march.within(near, time)?;
            if let Some(stabilisation) = self.stabilisation {
                state = self.stabilised(stabilisation, time, state)?;
            }
            *last_good = (time, state);
            self.march.forget_deferred();
            self.show(time, &last_good.1);
            if self.log.flow.is_break() {
                break;
            }
        }
        let Some((seen, (time, state))) = start else {
            return Ok(false);
        };
        // What output within the step evaluates is not what the monitor is shown, which is its end.
        self.march.equations_mut().recall(seen);
        // The monitor is not shown this step any more: the one before it was the last.
        if let Some(monitor) = self.monitor.as_mut().filter(|_| self.log.flow.is_break()) {
            monitor.end_of_steps(self.march.equations().constants(), time, &state);
        }
        Ok(true)
    }

    /// Corrects the end of the last step, and shows it to the monitor, with where a rule of higher
    /// order would have led.
    #[inline]
    fn observe(
        &mut self,
        time: S,
        better: Option<&M::State<S>>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        if self.may_defer() && self.march.defers(time - last_good.0) {
            last_good.0 = time;
            self.steps = self.steps.saturating_add(1);
            self.log.unseen += 1;
            return Ok(());
        }
        let mut state = self.march.bodies(&last_good.1);
        if self.corrects() {
            state = self.corrected(time, state)?;
            self.march.replace(&state);
        }
        if self.settings.interacts {
            self.march.hold_modes(&mut state)?;
        }
        if let Some(monitor) = &mut self.monitor {
            if let Some(better) = better {
                judge(monitor, self.march.equations(), (time, &state), better);
            }
            let estimate = self.march.estimate();
            self.march.monitor_end(monitor, &state, estimate);
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
    pub(super) fn convert(&mut self, last_good: &mut (S, M::State<S>)) {
        if self.settings.may_defer {
            self.march.convert(&mut last_good.1);
        }
    }

    /// The same of an event within the last step, with the bodies there.
    #[inline(never)]
    fn observe_event(
        &mut self,
        (time, mut bodies): (S, M::State<S>),
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        self.passing.ends_with_a_jump();
        if self.corrects() {
            bodies = self.corrected(time, bodies)?;
        }
        if self.monitor.is_some() {
            self.march.equations_mut().see_pivot(time, &bodies);
        }
        // A mode may end where the step began: no step to look at.
        if self.settings.interacts && time <= last_good.0 {
            *last_good = (time, bodies);
            self.log.unseen += 1;
            return Ok(());
        }
        if let Some(monitor) = &mut self.monitor {
            let estimate = self.march.estimate();
            self.march.monitor_event(monitor, (time, &bodies), estimate);
        }
        self.accept(time, bodies, last_good)
    }

    /// Takes a state, and the bodies in it, as the last good one.
    #[inline]
    fn accept(
        &mut self,
        time: S,
        state: M::State<S>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        if let Some(monitor) = &mut self.monitor {
            let unconverged = self.march.equations().iterations().unconverged;
            monitor.accept_unconverged_evaluations(unconverged, time);
        }
        self.steps = self.steps.saturating_add(1);
        if self.steps.is_power_of_two() || self.steps.is_multiple_of(ASKED_TWICE) {
            let before = (last_good.0, &last_good.1);
            self.march.equations().ask_twice((time, &state), before)?;
        }
        *last_good = (time, state);
        self.log.unseen += 1;
        Ok(())
    }

    pub(crate) fn show(&mut self, time: S, state: &M::State<S>) {
        let beside = self.companion.as_mut();
        let beside =
            beside.and_then(|companion| companion.compare(time, state, self.stabilisation));
        let equations = self.march.equations();
        let view = View::new(equations.constants(), time, state);
        let log = &mut self.log;
        log.worst_violation = log.worst_violation.max(view.violation());
        log.flow = (log.observe)(&Sample::new(view, equations).beside(beside));
        log.unseen = 0;
    }

    /// The last state is one that was shown.
    fn report(mut self, (time, state): (S, M::State<S>)) -> RunReport<S, M> {
        let equations = self.march.equations();
        if let Some(monitor) = &mut self.monitor {
            equations.name_smallest_pivot(monitor);
            monitor.end(equations.constants(), time, &state);
        }
        RunReport {
            evaluations: self.counts.evaluations,
            accepted: self.counts.accepted,
            rejected: self.counts.rejected,
            worst_violation: self.log.worst_violation,
            iterations: equations.iterations(),
            time,
            state,
            stopped: self.log.flow.is_break(),
            verification: self.companion.map(Companion::found),
            monitor: self.monitor,
        }
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
