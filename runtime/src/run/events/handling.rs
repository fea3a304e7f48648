//! Handlers and controllers, called between two segments of a run.

use core::ops::ControlFlow;

use crate::assembly::consistent_start::check_start;
use crate::dynamics::equations::Equations;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;
use crate::nonsmooth::status::Tracked;
use crate::run::driver::Driver;
use crate::run::events::context::Event;
use crate::run::events::list::{Happening, Hybrid};
use crate::run::events::sizes::{ahead, rate, round_off, shaken};
use crate::run::sample::Sample;
use crate::state::vector::{Array, StateParts, Vector as _};
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

/// What is called at an instant.
#[derive(Clone, Copy, PartialEq)]
enum Called<S> {
    /// Those of the events that pass their zeros at a time (s): at the instant, or by its round-off
    /// before it.
    Handlers(S),
    Controllers,
}

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Calls controllers at the start, and takes the readings there. Whether one stops the run.
    pub(crate) fn begin_events(
        &mut self,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<bool, Fault> {
        if self.hybrid.is_empty {
            return Ok(false);
        }
        self.begin_interactions()?;
        self.stand(*time, state, true)?;
        let before = self.monitor.is_some().then(|| self.energies(*time, state));
        let done = self.call(Called::Controllers, *time, state)?;
        self.stand(*time, state, true)?;
        if self.switch(*time, state, true)? {
            self.stand(*time, state, true)?;
        }
        self.account(before, *time, state);
        self.read_all(*time, state, |watch, reading| watch.begin(reading))?;
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
        if self.hybrid.is_empty || *time >= self.hybrid.end {
            return Ok(false);
        }
        let before = self.monitor.is_some().then(|| self.energies(*time, state));
        let done = self.call(Called::Controllers, *time, state)?;
        if done.changed {
            self.switch(*time, state, true)?;
        }
        self.account(before, *time, state);
        Ok(done.stops)
    }

    /// The phases of an instant, in their order: impulses and modes of interactions, handlers,
    /// controllers, signs. Laws that have switched are turned before. After each phase that has
    /// changed anything, sides of laws and modes of interactions are found anew.
    pub(crate) fn act(
        &mut self,
        is_found: bool,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
    ) -> Result<Done, Fault> {
        let time = *time;
        let before = self.monitor.is_some().then(|| self.energies(time, state));
        if is_found {
            self.read_all(time, state, |watch, reading| {
                watch.correct(reading.here, reading.round_off);
            })?;
        }
        self.hybrid.is_switched = false;
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
        if !done.stops && time < self.hybrid.end {
            let controlled = self.call(Called::Controllers, time, state)?;
            self.follow(&controlled, time, state)?;
            done.stops = controlled.stops;
        }
        if is_found {
            self.hybrid.is_fresh = true;
            self.read_all(time, state, |watch, reading| {
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
        let after = before.map(|_| self.energies(time, state));
        if let (Some(monitor), Some(before), Some(after)) = (&mut self.monitor, before, after) {
            monitor.jump(after - before);
        }
    }

    /// Kinetic and potential energy (J).
    fn energies(&self, time: S, state: &M::State<S>) -> S {
        let constants = self.march.equations().constants();
        M::kinetic_energy(constants, state) + M::potential_energy(constants, time, state)
    }

    /// Calls the handlers of all events that were found, in the order in which these pass their
    /// zeros, and of those that do at once in the order in which they were given.
    fn call_handlers(&mut self, time: S, state: &mut M::State<S>) -> Result<Done, Fault> {
        let mut done = Done {
            moved: false,
            changed: false,
            stops: false,
        };
        let mut handled: Option<S> = None;
        loop {
            let mut next: Option<S> = None;
            self.hybrid.list.each(&mut |happening| {
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
            let now = self.call(Called::Handlers(root), time, state)?;
            done.moved |= now.moved;
            done.changed |= now.changed;
            done.stops |= now.stops;
            handled = Some(root);
        }
    }

    /// Calls what is due at a time, one after the other: each sees what the former have done.
    fn call(&mut self, called: Called<S>, time: S, state: &mut M::State<S>) -> Result<Done, Fault> {
        let mut done = Done {
            moved: false,
            changed: false,
            stops: false,
        };
        let Hybrid {
            list,
            inputs,
            taken,
            accepts_any_state,
            end,
            ..
        } = &mut self.hybrid;
        let march = &mut *self.march;
        list.each(&mut |happening: &mut dyn Happening<S, M>| {
            let name = match called {
                Called::Handlers(root) => happening
                    .watch()
                    .filter(|watch| watch.root() == Some(root))
                    .map(|watch| watch.name()),
                Called::Controllers => happening
                    .period()
                    .is_some_and(|period| period.is_due(time))
                    .then_some(""),
            };
            let Some(name) = name else {
                return Ok(());
            };
            let equations = march.equations();
            let view = View::new(equations.constants(), time, state);
            let sample = Sample::new(view, equations);
            let mut event = Event::new(sample, name, equations.parameters(), *inputs);
            let flow = happening.act(&mut event)?;
            let (next, held, parameters) = (event.state, event.inputs, event.parameters);
            if let Some(parameters) = parameters {
                let equations = march.equations_mut();
                equations.take_parameters(parameters)?;
                equations.renew_limits()?;
                *taken = Some(parameters);
            }
            if held != *inputs || parameters.is_some() {
                march.equations_mut().set_inputs(&held)?;
                *inputs = held;
                done.changed = true;
            }
            if next != *state {
                let duration = *end - time;
                let checked = checked(
                    march.equations(),
                    (time, duration),
                    next,
                    *accepts_any_state,
                );
                *state = checked.map_err(|fault| after_handler(name, fault))?;
                done.moved = true;
            }
            done.stops |= matches!(flow, ControlFlow::Break(()));
            Ok(())
        })?;
        let asks = |tracked: &Tracked<S, M>| tracked.status.get().is_asked;
        done.changed |= done.moved || self.march.equations().interactions().iter().any(asks);
        Ok(done)
    }

    fn read_all(
        &mut self,
        time: S,
        state: &M::State<S>,
        mut take: impl FnMut(&mut Watch<S>, Reading<S>),
    ) -> Result<(), Fault> {
        let ahead = self.ahead(time, state);
        let equations = self.march.equations();
        let constants = equations.constants();
        let shaken = |way| shaken::<S, M>(constants, time, state, way);
        let beside = [shaken(1.0), shaken(-1.0)];
        self.hybrid.list.each(&mut |happening| {
            if happening.watch().is_none() {
                return Ok(());
            }
            let read = |(time, state): (S, &M::State<S>)| {
                happening.read(&Sample::new(View::new(constants, time, state), equations))
            };
            let here = read((time, state));
            let reading = Reading {
                here,
                ahead: read(ahead.borrowed()),
                round_off: round_off(here, beside.each_ref().map(|(t, x)| read((*t, x)))),
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
        let mut step = self.hybrid.end - time;
        if self.hybrid.longest > S::zero() {
            step = step.min(self.hybrid.longest);
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
        Fault::InconsistentStart {
            joint,
            quantity,
            violation,
            ..
        } => Fault::HandlerOpens {
            event,
            joint,
            quantity,
            violation,
        },
        fault => fault,
    }
}
