//! A run under way: segments of integration between breaks, corrections, reports, and the monitor
//! over them.

use core::ops::ControlFlow;

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::{Advance, Counts, Integration as _, Integrator, System as _, TimeSpan};
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::{Monitor, Work};
use crate::run::branching::Branching;
use crate::run::companion::Companion;
use crate::run::deferred::Deferred;
use crate::run::events::list::Hybrid;
use crate::run::followed::bodies_within;
use crate::run::output::Schedule;
use crate::run::passing::Passing;
use crate::run::past::Past;
use crate::run::post_step::PostStabilisation;
use crate::run::report::RunReport;
use crate::run::sample::Sample;
use crate::run::within::judge;
use crate::run::worked::{begin_to_watch, worked};

/// A run under way.
pub(crate) struct Run<'r, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>> {
    /// What the integrator moves.
    pub(crate) dynamics: Dynamics<S, M, F, A, C>,
    /// What is done to states after steps and before reports.
    pub(crate) stabilisation: Option<&'r dyn PostStabilisation<S, M>>,
    pub(crate) schedule: Schedule<S>,
    /// Instants (s) at which the integration begins anew, in any order, besides those of the
    /// description.
    pub(crate) breaks: &'r [S],
    pub(crate) monitor: Option<Monitor<S, M>>,
    pub(crate) log: Log<'r, S, M>,
    /// Events and controllers.
    pub(crate) hybrid: Option<Hybrid<'r, S, M>>,
    /// Lengths that pass through zero.
    pub(crate) passing: Passing<S>,
    /// Steps so far.
    pub(crate) steps: usize,
    pub(crate) counts: Counts,
    /// A state that was reached since the bodies of the last good one.
    pub(crate) deferred: Deferred<C::State<S>>,
    /// How fast (rad/s) a state moved that no correction could bring back.
    pub(crate) gone: Option<S>,
    /// Where joints are closed without a stabilisation.
    pub(crate) branching: Branching<S>,
}

/// A step that was taken, and looked into for the monitor. In a place of its own over all steps, as
/// it is long and mostly empty.
pub(super) struct Taken<S: Real, M: Mechanism> {
    /// The first event within it.
    pub(super) event: Option<(S, M::State<S>)>,
    /// Where a rule of higher order would have led, where that is asked.
    pub(super) better: Option<M::State<S>>,
    /// Evaluations so far, and those of them that looked into the step.
    pub(super) evaluations: usize,
    pub(super) looks: usize,
}

impl<S: Real, M: Mechanism> Taken<S, M> {
    const fn none() -> Self {
        Self {
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
pub(crate) struct Begun<S, X> {
    /// When (s), and in which state.
    #[cfg_attr(
        not(feature = "std"),
        expect(dead_code, reason = "checkpoints and trajectories need a heap")
    )]
    pub(crate) start: S,
    pub(crate) state: X,
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

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Goes from a state to the end; keeps the last good state.
    pub(crate) fn go<I: Integrator<S, Dynamics<S, M, F, A, C>>>(
        mut self,
        integrator: &I,
        mut companion: Option<Companion<S, M, F, A, C, I>>,
        (start, end): (S, S),
        last_good: &mut (S, M::State<S>),
        mut past: Option<&Past<'_, S, M>>,
    ) -> Result<RunReport<S, M>, Fault> {
        let mut from = start;
        self.leave_zeros(last_good, end - start);
        if let Some(past) = past {
            self.take_past(past)
                .map_err(|fault| self.explained(integrator, fault, *last_good))?;
            from = match &past.segment {
                Some(segment) => segment.start,
                None => {
                    self.go_on_with_events(last_good)?;
                    last_good.0
                }
            };
        } else {
            self.begin(integrator, &mut companion, (start, end), last_good)?;
        }
        while from < end && self.log.flow.is_continue() {
            let mut until = next_break(M::REPORT.time.breaks, self.breaks, from, end);
            if let Some(hybrid) = &mut self.hybrid {
                until = hybrid.next_instant(until);
            }
            until = self
                .next_switch(from, until)
                .map_err(|fault| self.explained(integrator, fault, *last_good))?;
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
            if let Some(companion) = &mut companion {
                companion.restart(&span, self.stabilisation);
            }
            let reached = if is_between && self.goes_across(last_good, until)? {
                if self.schedule.at(last_good.0, self.log.unseen) {
                    self.show(last_good.0, &last_good.1, &mut companion);
                }
                Ok(())
            } else {
                self.segment(integrator, &mut companion, span, last_good, past.take())
            };
            self.convert(last_good);
            if reached.is_ok() && self.passing.has_refused(last_good.0) {
                from = last_good.0;
                continue;
            }
            self.leave_zeros(last_good, until - from);
            reached
                .and_then(|()| self.happen(last_good, &mut companion))
                .and_then(|()| self.keep_between(integrator, last_good, end))
                .map_err(|fault| self.explained(integrator, fault, *last_good))?;
            from = last_good.0;
        }
        let mut report = self.report(*last_good);
        report.verification = companion.map(Companion::found);
        Ok(report)
    }

    /// Hands over a checkpoint between two integrations, or at the end of the run.
    #[cfg(feature = "std")]
    fn keep_between<I: Integrator<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integrator: &I,
        last_good: &(S, M::State<S>),
        end: S,
    ) -> Result<(), Fault> {
        let is_due = last_good.0 >= end || self.keeps_now();
        if self.keeps() && is_due && self.log.flow.is_continue() {
            self.keep::<I, I::Integration>(integrator, None, last_good)?;
        }
        Ok(())
    }

    #[cfg(not(feature = "std"))]
    #[inline(always)]
    fn keep_between<I>(&self, _: &I, _: &(S, M::State<S>), _: S) -> Result<(), Fault> {
        Ok(())
    }

    /// Begins at the start: evaluates, calls controllers, shows the state.
    fn begin<I: Integrator<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integrator: &I,
        companion: &mut Option<Companion<S, M, F, A, C, I>>,
        (start, end): (S, S),
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        if start == end {
            self.evaluate(start, &last_good.1)
                .map_err(|fault| self.explained(integrator, fault, *last_good))?;
        }
        self.begin_events(last_good)?;
        #[cfg(feature = "std")]
        self.begin_records(start, true);
        if self.log.flow.is_continue() {
            self.show(start, &last_good.1, companion);
        }
        if let Some(monitor) = self.monitor.as_mut().filter(|_| start < end) {
            self.dynamics.begin(monitor, start, &last_good.1);
        }
        if start < end {
            let start = (start, &last_good.1);
            self.dynamics.ask_twice(start, (end, start.1))?;
        }
        Ok(())
    }

    /// Evaluates the rates once: a run of no length is refused where any other would be.
    fn evaluate(&mut self, time: S, state: &M::State<S>) -> Result<(), Fault> {
        let state = self.dynamics.nearest(state);
        self.dynamics.rates(time, &state)?;
        self.counts.evaluations += 1;
        Ok(())
    }

    /// Integrates over an interval without breaks, up to the first event: step by step, each is
    /// taken, then reports within it are made, then its end is observed.
    fn segment<I: Integrator<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integrator: &I,
        companion: &mut Option<Companion<S, M, F, A, C, I>>,
        span: TimeSpan<S>,
        last_good: &mut (S, M::State<S>),
        past: Option<&Past<'_, S, M>>,
    ) -> Result<(), Fault> {
        let under_way = past.and_then(|past| Some((past, past.segment?)));
        let mut begun = match &under_way {
            Some((_, segment)) => Self::begun(segment)?,
            None => Begun {
                start: span.start,
                state: self.dynamics.nearest(&last_good.1),
                of_monitor: 0,
            },
        };
        let mut integration = integrator.start(&mut self.dynamics, span, begun.state)?;
        if let Some((past, segment)) = under_way {
            self.go_on(&mut integration, segment.memory, past)?;
        } else if let (Some(monitor), false) = (&mut self.monitor, self.passing.goes_on(span.start))
        {
            monitor.restart();
            let state = integration.state();
            begin_to_watch(
                monitor,
                &mut self.dynamics,
                (span.start, state),
                &last_good.1,
            );
        }
        let budget = integrator.budget().unwrap_or(usize::MAX);
        let budget = budget.saturating_sub(self.counts.evaluations);
        let mut taken = Taken::none();
        while integration.time() < span.end {
            let left = span.end - last_good.0;
            let longest = integrator.fixed_step().map_or(left, |step| step.min(left));
            if !self.take(&mut integration, last_good, longest, &mut taken)? {
                break;
            }
            let event = taken.event.as_ref();
            let reached = event.map_or(integration.time(), |&(time, _)| time);
            #[cfg(feature = "std")]
            let is_recorded = {
                let at_end = event.map(|(_, bodies)| bodies);
                self.record_within(&mut integration, (reached, at_end), last_good)?
            };
            #[cfg(not(feature = "std"))]
            let is_recorded = false;
            let has_reported =
                self.report_within(&mut integration, reached, companion, last_good)?;
            if self.log.flow.is_break() {
                break;
            }
            let is_shared = if has_reported || is_recorded {
                // With reports, which find what interpolation needs where a look has evaluated it,
                // or evaluate for each time anew.
                integration.counts().evaluations == taken.evaluations
            } else {
                // Or as the slope at the start of the next step.
                taken.looks <= 1 && !self.corrects() && !A::INTERACTS
            };
            if !is_shared {
                begun.of_monitor = begun.of_monitor.saturating_add(taken.looks);
            }
            let before = integration.counts().evaluations;
            if let Some(&(time, bodies)) = event {
                self.observe_event(&mut integration, (time, bodies), last_good)?;
            } else {
                self.observe(&mut integration, taken.better.as_ref(), last_good)?;
            }
            let looks = integration.counts().evaluations.saturating_sub(before);
            if looks > 1 || self.corrects() || A::INTERACTS {
                begun.of_monitor = begun.of_monitor.saturating_add(looks);
            }
            #[cfg(feature = "std")]
            self.record_end(last_good);
            let is_event = event.is_some();
            if !is_event && self.schedule.at(last_good.0, self.log.unseen) {
                self.convert(last_good);
                self.show(last_good.0, &last_good.1, companion);
                if self.log.flow.is_break() {
                    break;
                }
            }
            let counts = integration.counts().without(begun.of_monitor);
            let evaluations = counts.evaluations;
            if evaluations >= budget && last_good.0 < span.end {
                let evaluations = self.counts.evaluations.saturating_add(evaluations);
                return Err(Fault::Budget {
                    evaluations,
                    joint: None,
                });
            }
            if is_event {
                break;
            }
            #[cfg(feature = "std")]
            if self.keeps_now() && last_good.0 < span.end {
                self.keep(integrator, Some((&mut integration, &begun)), last_good)?;
                if self.log.flow.is_break() {
                    break;
                }
            }
        }
        self.counts = (self.counts).plus(integration.counts().without(begun.of_monitor));
        Ok(())
    }

    /// Shows the states at reporting times within the last step up to a time, until the observer
    /// stops; whether there are any.
    #[inline]
    fn report_within<I, K>(
        &mut self,
        integration: &mut K,
        reached: S,
        companion: &mut Option<Companion<S, M, F, A, C, I>>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<bool, Fault>
    where
        I: Integrator<S, Dynamics<S, M, F, A, C>>,
        K: Advance<S, Dynamics<S, M, F, A, C>>,
    {
        let mut start = None;
        while let Some(time) = self.schedule.within(reached) {
            start.get_or_insert_with(|| (self.dynamics.seen(), *last_good));
            let near = (last_good.0 - self.deferred.elapsed(), &last_good.1);
            let mut state = bodies_within(&mut self.dynamics, integration, near, time)?;
            if let Some(stabilisation) = self.stabilisation {
                state = self.stabilised(stabilisation, time, state)?;
            }
            *last_good = (time, state);
            self.deferred.clear();
            self.show(time, &last_good.1, companion);
            if self.log.flow.is_break() {
                break;
            }
        }
        let Some((seen, (time, state))) = start else {
            return Ok(false);
        };
        // What output within the step evaluates is not what the monitor is shown, which is its end.
        self.dynamics.recall(seen);
        // The monitor is not shown this step any more: the one before it was the last.
        if let Some(monitor) = self.monitor.as_mut().filter(|_| self.log.flow.is_break()) {
            monitor.end_of_steps(self.dynamics.constants(), time, &state);
        }
        Ok(true)
    }

    /// Corrects the end of the last step, and shows it to the monitor, with where a rule of higher
    /// order would have led.
    #[inline]
    fn observe<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        better: Option<&M::State<S>>,
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        let time = integration.time();
        let may_defer = self.may_defer() && !self.branching.is_near();
        if may_defer && self.deferred.defer(integration.state(), time - last_good.0) {
            last_good.0 = time;
            self.steps = self.steps.saturating_add(1);
            self.log.unseen += 1;
            return Ok(());
        }
        let near = &last_good.1;
        let mut state = self.dynamics.bodies_counted(integration.state(), near);
        let exchanged = match &self.monitor {
            Some(monitor) => worked(
                monitor,
                &mut self.dynamics,
                integration,
                (time, &state),
                near,
            ),
            None => (None, None),
        };
        if self.corrects() {
            state = self.corrected(time, state)?;
            let state = self.dynamics.nearest_to(&state, integration.state());
            integration.replace(state);
        }
        if A::INTERACTS
            && let Some(held) = self.dynamics.held(time, integration.state())?
        {
            state = self.dynamics.bodies_near(&held, &state);
            integration.replace(held);
        }
        if let (Some(monitor), Some(better)) = (&mut self.monitor, better) {
            judge(monitor, &self.dynamics, (time, &state), better);
        }
        let estimate = integration.estimate();
        self.accept((time, state), (estimate, exchanged), last_good)
    }

    /// Whether bodies are of no use before somebody looks: nothing reads the end of each step.
    #[inline]
    fn may_defer(&self) -> bool {
        let reads = self.monitor.is_some() || self.stabilisation.is_some() || self.hybrid.is_some();
        C::IS_RELATIVE && !A::PRESENT && M::SEPARATIONS.is_empty() && !reads
    }

    /// Converts the last good state to bodies, if that was deferred.
    #[inline]
    pub(super) fn convert(&mut self, last_good: &mut (S, M::State<S>)) {
        if let Some(state) = self.deferred.take() {
            last_good.1 = self.dynamics.bodies_counted(&state, &last_good.1);
        }
    }

    /// The same of an event within the last step, with the bodies there.
    #[inline(never)]
    fn observe_event<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        (time, mut bodies): (S, M::State<S>),
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        self.passing.ends_with_a_jump();
        let exchanged = match &self.monitor {
            Some(monitor) if time > monitor.time() => {
                let (dynamics, near) = (&mut self.dynamics, &last_good.1);
                worked(monitor, dynamics, integration, (time, &bodies), near)
            }
            _ => (None, None),
        };
        if self.corrects() {
            bodies = self.corrected(time, bodies)?;
        }
        if self.monitor.is_some() {
            self.dynamics.see_pivot(time, &bodies);
        }
        // A mode may end where the step began: no step to look at.
        if A::INTERACTS && time <= last_good.0 {
            *last_good = (time, bodies);
            self.log.unseen += 1;
            return Ok(());
        }
        let estimate = integration.estimate();
        self.accept((time, bodies), (estimate, exchanged), last_good)
    }

    /// Takes a state, and the bodies in it, as the last good one.
    #[inline]
    fn accept(
        &mut self,
        (time, state): (S, M::State<S>),
        (estimate, exchanged): (Option<S>, (Option<S>, Option<Work<S>>)),
        last_good: &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        if let Some(monitor) = &mut self.monitor {
            self.dynamics
                .monitor(monitor, (time, &state), estimate, exchanged);
            let unconverged = self.dynamics.iterations().unconverged;
            monitor.accept_unconverged_evaluations(unconverged, time);
        }
        self.steps = self.steps.saturating_add(1);
        if self.steps.is_power_of_two() || self.steps.is_multiple_of(ASKED_TWICE) {
            let before = (last_good.0, &last_good.1);
            self.dynamics.ask_twice((time, &state), before)?;
        }
        *last_good = (time, state);
        self.log.unseen += 1;
        Ok(())
    }

    pub(crate) fn show<I: Integrator<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        time: S,
        state: &M::State<S>,
        companion: &mut Option<Companion<S, M, F, A, C, I>>,
    ) {
        let beside = companion.as_mut();
        let beside =
            beside.and_then(|companion| companion.compare(time, state, self.stabilisation));
        let dynamics = &self.dynamics;
        let view = dynamics.view(time, state);
        let log = &mut self.log;
        log.worst_violation = log.worst_violation.max(view.violation());
        log.flow = (log.observe)(&Sample::new(view, dynamics).beside(beside));
        log.unseen = 0;
    }

    /// The last state is one that was shown.
    fn report(mut self, (time, state): (S, M::State<S>)) -> RunReport<S, M> {
        if let Some(monitor) = &mut self.monitor {
            self.dynamics.name_smallest_pivot(monitor);
            monitor.end(self.dynamics.constants(), time, &state);
        }
        RunReport {
            evaluations: self.counts.evaluations,
            accepted: self.counts.accepted,
            rejected: self.counts.rejected,
            worst_violation: self.log.worst_violation,
            iterations: self.dynamics.iterations(),
            time,
            state,
            stopped: self.log.flow.is_break(),
            verification: None,
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
