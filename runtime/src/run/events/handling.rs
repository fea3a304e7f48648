//! Handlers and controllers, called between two segments of a run.

use core::ops::ControlFlow;

use crate::assembly::consistent_start::check_start;
use crate::dynamics::equations::Equations;
use crate::error::{Fault, StartFault, StepFault};
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;
use crate::nonsmooth::status::Tracked;
use crate::run::driver::Driver;
use crate::run::events::context::Event;
use crate::run::events::list::{Happening, Hybrid, Phase};
use crate::run::events::sizes::{ahead, rate, round_off, shaken};
use crate::run::events::times::is_due;
use crate::run::sample::Sample;
use crate::state::vector::{Array, StateParts, Vector as _};
use crate::stepping::marching::Marching;
use crate::stepping::watch::{Reading, Watch};

/// What handlers and controllers have done at an instant.
#[derive(Clone, Copy)]
pub(crate) struct Done {
    /// A handler has set the state.
    pub(crate) moved: bool,
    /// Or something else by which modes of interactions may change.
    changed: bool,
    /// A handler or a controller stops the run.
    pub(crate) stops: bool,
}

impl Done {
    const fn nothing() -> Self {
        Self {
            moved: false,
            changed: false,
            stops: false,
        }
    }

    const fn and(&mut self, other: Self) {
        self.moved |= other.moved;
        self.changed |= other.changed;
        self.stops |= other.stops;
    }
}

/// What is called, with an [`Event`].
pub(crate) type Handler<'h, S, M> =
    dyn FnMut(&mut Event<'_, S, M>) -> Result<ControlFlow<()>, Fault> + 'h;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Calls handlers of that time and controllers at the start, and takes the readings there.
    /// Whether one stops the run.
    pub(crate) fn begin_events(
        &mut self,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<bool, Fault> {
        if self.course.hybrid.is_empty {
            return Ok(false);
        }
        self.begin_interactions()?;
        self.stand(*time, state, true)?;
        let before = self.watched_energies(*time, state);
        let mut done = self.call(Phase::Times, *time, state)?;
        self.follow(&done, *time, state)?;
        if !done.stops {
            done.and(self.call(Phase::Relays, *time, state)?);
            done.and(self.call(Phase::Controllers, *time, state)?);
        }
        self.stand(*time, state, true)?;
        if self.switch(*time, state, true)? {
            self.stand(*time, state, true)?;
        }
        self.account(before, *time, state);
        self.read_all(*time, state, &mut |watch, reading| watch.begin(reading))?;
        Ok(done.stops)
    }

    /// Calls the controllers of the instant from which a run goes on, if they were not: at the
    /// former end of its interval. Whether one stops the run.
    pub(crate) fn go_on_with_events(
        &mut self,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<bool, Fault> {
        if self.course.hybrid.is_empty || *time >= self.course.hybrid.end {
            return Ok(false);
        }
        let before = self.watched_energies(*time, state);
        let done = self.call(Phase::Controllers, *time, state)?;
        if done.changed {
            self.switch(*time, state, true)?;
        }
        self.account(before, *time, state);
        Ok(done.stops)
    }

    /// Whether an event was found in the last step, or a handler is due at its end (s): by the name
    /// of the first of them.
    pub(crate) fn take_found(&mut self, time: S) -> Result<bool, Fault> {
        let hybrid = &mut self.course.hybrid;
        let is_found = core::mem::take(&mut hybrid.is_found);
        let (mut is_time, mut event) = (false, None);
        self.list.each(&mut |happening| {
            let found = happening.watch().filter(|watch| watch.is_found());
            let found = found.filter(|_| is_found).map(|watch| watch.name());
            let next = happening.next_time();
            let due = next.and_then(|(next, name)| is_due(next, time).then_some(name));
            is_time |= due.is_some();
            event = event.or(found).or(due);
            Ok(())
        })?;
        if is_time {
            hybrid.event = event;
        }
        Ok(is_found || is_time)
    }

    /// The phases of an instant, in their order: impulses and modes of interactions, handlers of
    /// events and of the time, relays, controllers, signs. Laws that have switched are turned
    /// before. After each phase that has changed anything, sides of laws and modes of interactions
    /// are found anew.
    pub(crate) fn act(
        &mut self,
        is_found: bool,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<Done, Fault> {
        let time = *time;
        let before = self.watched_energies(time, state);
        if is_found {
            self.read_all(time, state, &mut |watch, reading| {
                watch.correct(reading.here, reading.round_off);
            })?;
        }
        self.course.hybrid.is_switched = false;
        let mut done = Done {
            moved: self.switch(time, state, false)?,
            changed: false,
            stops: false,
        };
        if done.moved {
            self.stand(time, state, true)?;
        }
        if is_found {
            let handled = self.call_handlers(time, state)?;
            self.follow(&handled, time, state)?;
            done.moved |= handled.moved;
            done.stops = handled.stops;
        }
        if is_found && !done.stops {
            let timed = self.call(Phase::Times, time, state)?;
            self.follow(&timed, time, state)?;
            done.moved |= timed.moved;
            done.stops = timed.stops;
        }
        if !done.stops {
            let relayed = self.call(Phase::Relays, time, state)?;
            self.follow(&relayed, time, state)?;
            done.moved |= relayed.moved;
            done.stops = relayed.stops;
        }
        if !done.stops && time < self.course.hybrid.end {
            let controlled = self.call(Phase::Controllers, time, state)?;
            self.follow(&controlled, time, state)?;
            done.stops = controlled.stops;
        }
        if is_found {
            self.course.hybrid.is_fresh = true;
            self.read_all(time, state, &mut |watch, reading| {
                watch.settle(reading, done.moved);
            })?;
        }
        self.account(before, time, state);
        Ok(done)
    }

    /// Finds sides of laws and modes of interactions anew where something has changed.
    fn follow(&mut self, done: &Done, time: S, state: &mut M::State<S>) -> Result<(), Fault> {
        if done.changed {
            self.stand(time, state, done.moved)?;
            if self.switch(time, state, true)? {
                self.stand(time, state, true)?;
            }
        }
        Ok(())
    }

    /// Tells the monitor what energy (J) an instant has put in, if it was known before.
    fn account(&mut self, before: Option<S>, time: S, state: &M::State<S>) {
        let after = self.watched_energies(time, state);
        if let (Some(monitor), Some(before), Some(after)) =
            (&mut self.course.monitor, before, after)
        {
            monitor.jump(after - before);
        }
    }

    /// Kinetic and potential energy (J), where there is a monitor to be told of it.
    fn watched_energies(&self, time: S, state: &M::State<S>) -> Option<S> {
        self.course.monitor.as_ref()?;
        let constants = self.march.equations().constants();
        Some(M::kinetic_energy(constants, state) + M::potential_energy(constants, time, state))
    }

    /// Calls the handlers of all events that were found, in the order in which these pass their
    /// zeros, and of those that do at once in the order in which they were given.
    fn call_handlers(&mut self, time: S, state: &mut M::State<S>) -> Result<Done, Fault> {
        let mut done = Done::nothing();
        let mut handled: Option<S> = None;
        loop {
            let mut next: Option<S> = None;
            self.list.each(&mut |happening| {
                let root = happening.watch().and_then(|watch| watch.root());
                let root = root.filter(|&root| handled.is_none_or(|handled| root > handled));
                next = match next.zip(root) {
                    Some((next, root)) => Some(next.min(root)),
                    None => next.or(root),
                };
                Ok(())
            })?;
            let Some(root) = next else {
                return Ok(done);
            };
            let now = self.call(Phase::Handlers(root), time, state)?;
            done.and(now);
            handled = Some(root);
        }
    }

    /// Calls what is due at a time, one after the other: each sees what the former have done.
    fn call(&mut self, phase: Phase<S>, time: S, state: &mut M::State<S>) -> Result<Done, Fault> {
        let mut done = Done::nothing();
        let (march, hybrid) = (&mut *self.march, &mut self.course.hybrid);
        self.list.each(&mut |happening: &mut dyn Happening<S, M>| {
            let Some(name) = happening.due(time, phase) else {
                return Ok(());
            };
            let handler = &mut |event: &mut Event<'_, S, M>| happening.act(event);
            done.and(invoke(march, hybrid, (name, handler), time, state)?);
            Ok(())
        })?;
        Ok(self.with_asked(done))
    }

    /// What was done, if interactions were asked for something, too.
    fn with_asked(&self, mut done: Done) -> Done {
        let asks = |tracked: &Tracked<S, M>| tracked.status.is_asked;
        done.changed |= done.moved || self.march.equations().interactions().iter().any(asks);
        done
    }

    /// Calls a handler at an instant at which no event was found. Whether it stops the run.
    pub(crate) fn change(
        &mut self,
        handler: &mut Handler<'_, S, M>,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<bool, Fault> {
        let time = *time;
        let before = self.watched_energies(time, state);
        let hybrid = &mut self.course.hybrid;
        let done = invoke(self.march, hybrid, ("change", handler), time, state)?;
        let mut done = self.with_asked(done);
        self.follow(&done, time, state)?;
        let relayed = self.call(Phase::Relays, time, state)?;
        self.follow(&relayed, time, state)?;
        done.and(relayed);
        self.course.hybrid.is_fresh = true;
        self.read_all(time, state, &mut |watch, reading| {
            if done.moved {
                watch.move_to(reading);
            } else {
                watch.settle(reading, false);
            }
        })?;
        self.account(before, time, state);
        Ok(done.stops)
    }

    /// Forgets what was found in a step that is not gone to its end.
    pub(crate) fn forget_found(
        &mut self,
        At {
            time,
            bodies: state,
        }: &StateAt<S, M>,
    ) -> Result<(), Fault> {
        self.course.hybrid.is_found = false;
        for tracked in self.march.equations_mut().interactions_mut() {
            tracked.status.is_found = false;
        }
        if let Some(switching) = &mut self.switching {
            switching.is_found = false;
        }
        self.stand(*time, state, true)?;
        self.read_all(*time, state, &mut |watch, reading| watch.move_to(reading))
    }

    fn read_all(
        &mut self,
        time: S,
        state: &M::State<S>,
        take: &mut dyn FnMut(&mut Watch<S>, Reading<S>),
    ) -> Result<(), Fault> {
        let ahead = self.ahead(time, state);
        let equations = self.march.equations();
        let constants = equations.constants();
        let shaken = |way| shaken::<S, M>(constants, time, state, way);
        let [one, other] = [shaken(1.0), shaken(-1.0)];
        self.list.each(&mut |happening| {
            if happening.watch().is_none() {
                return Ok(());
            }
            let read = |(time, state): (S, &M::State<S>)| {
                happening.read(&Sample::new(View::new(constants, time, state), equations))
            };
            let here = read((time, state));
            let ahead = read(ahead.borrowed());
            let beside = [read((one.0, &one.1)), read((other.0, &other.1))];
            let reading = Reading {
                here,
                ahead,
                round_off: round_off(here, beside),
            };
            if let Some(watch) = happening.watch() {
                watch.checked(time, here)?;
                take(watch, reading);
            }
            Ok(())
        })
    }

    /// A little ahead on the way of the motion, as far as velocities and rates of states lead.
    fn ahead(&self, time: S, state: &M::State<S>) -> StateAt<S, M> {
        let mut step = self.course.hybrid.end - time;
        if self.course.hybrid.longest > S::zero() {
            step = step.min(self.course.hybrid.longest);
        }
        let constants = self.march.equations().constants();
        let mut rates = M::coordinate_rates(constants, state);
        M::state_rates_into(constants, time, state, &mut rates);
        let rates = M::State::from_parts(rates, Array::zeros());
        let rate = rate::<S, M>(constants, (state, &rates), step);
        if rate * step > ahead::<S>() {
            step = ahead::<S>().quotient(rate);
        }
        At {
            time: time + step,
            bodies: state.plus([(step, &rates)]),
        }
    }
}

/// Calls a handler of an event by its name, and takes what it has changed.
fn invoke<S: Real, M: Mechanism>(
    march: &mut (dyn Marching<S, M> + '_),
    hybrid: &mut Hybrid<S, M>,
    (name, handler): (&'static str, &mut Handler<'_, S, M>),
    time: S,
    state: &mut M::State<S>,
) -> Result<Done, Fault> {
    let mut done = Done::nothing();
    let (mut next, mut held) = (*state, hybrid.inputs);
    let (mut parameters, mut flow) = (None, ControlFlow::Continue(()));
    march
        .equations_mut()
        .change_interactions(&mut |equations, interactions| {
            let view = View::new(equations.constants(), time, state);
            let sample = Sample::new(view, equations);
            let former = (equations.parameters(), hybrid.inputs);
            let mut event = Event::new((sample, name), former, interactions);
            flow = handler(&mut event)?;
            (next, held, parameters) = (event.state, event.inputs, event.parameters);
            Ok(())
        })?;
    if let Some(parameters) = parameters {
        let equations = march.equations_mut();
        equations.take_parameters(parameters)?;
        equations.renew_limits()?;
        hybrid.taken = Some(parameters);
    }
    if held != hybrid.inputs || parameters.is_some() {
        march.equations_mut().set_inputs(&held)?;
        hybrid.inputs = held;
        done.changed = true;
    }
    if next != *state {
        let at = (time, hybrid.end - time);
        let checked = checked(march.equations(), at, next, hybrid.accepts_any_state);
        *state = checked.map_err(|fault| after_handler(name, fault))?;
        done.moved = true;
    }
    done.stops = matches!(flow, ControlFlow::Break(()));
    Ok(done)
}

/// A state that a handler has set, as a start of a run over a duration (s) is checked.
fn checked<S: Real, M: Mechanism>(
    equations: &dyn Equations<S, M>,
    at: (S, S),
    mut state: M::State<S>,
    accepts_any: bool,
) -> Result<M::State<S>, Fault> {
    let (constants, is_relative) = (equations.constants(), equations.is_relative());
    check_state::<S, M>(&state)?;
    M::rewrap(constants, &mut state);
    if !accepts_any || is_relative {
        check_start::<S, M>(constants, at, &state, is_relative)?;
    }
    Ok(state)
}

/// The fault of a state as that of the handler which has set it.
fn after_handler(event: &'static str, fault: Fault) -> Fault {
    match fault {
        Fault::Start(StartFault::Inconsistent {
            joint,
            quantity,
            violation,
            ..
        }) => Fault::Step(StepFault::HandlerOpens {
            event,
            joint,
            quantity,
            violation,
        }),
        fault => fault,
    }
}
