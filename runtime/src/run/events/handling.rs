//! Handlers and controllers, called between two segments of a run.

use core::ops::ControlFlow;

use crate::assembly::consistent_start::check_start;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;
use crate::nonsmooth::status::Tracked;
use crate::run::events::context::Event;
use crate::run::events::list::{Happening, Hybrid};
use crate::run::events::sizes::{ahead, rate, round_off, shaken};
use crate::run::sample::Sample;
use crate::run::segments::Run;
use crate::state::vector::{Array, StateParts, Vector as _};
use crate::stepping::watch::{Reading, Watch};

/// What handlers and controllers have done at an instant.
#[derive(Clone, Copy)]
struct Done {
    /// A handler has set the state.
    moved: bool,
    /// Or something else by which modes of interactions may change.
    changed: bool,
    /// A handler or a controller stops the run.
    stops: bool,
}

/// What is called at an instant.
#[derive(Clone, Copy, PartialEq)]
enum Called<S> {
    /// Those of the events that pass their zeros at a time (s): at the instant, or by its round-off
    /// before it.
    Handlers(S),
    Controllers,
}

impl<S: Real, M: Mechanism> Run<'_, S, M> {
    /// Calls controllers at the start, and takes the readings there.
    pub(crate) fn begin_events(
        &mut self,
        (time, state): &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        let Some(mut hybrid) = self.hybrid.take() else {
            return Ok(());
        };
        self.begin_interactions()?;
        self.stand(&mut hybrid, *time, state, true)?;
        let before = self.monitor.is_some().then(|| self.energies(*time, state));
        let done = self.call(&mut hybrid, Called::Controllers, *time, state)?;
        self.stand(&mut hybrid, *time, state, true)?;
        if self.switch(&mut hybrid, *time, state, true)? {
            self.stand(&mut hybrid, *time, state, true)?;
        }
        self.account(before, *time, state);
        self.read_all(&mut hybrid, *time, state, |watch, reading| {
            watch.begin(reading);
        })?;
        self.hybrid = Some(hybrid);
        if done.stops {
            self.log.stop();
        }
        Ok(())
    }

    /// Calls the controllers of the instant from which a run goes on, if they were not: at the
    /// former end of its interval.
    pub(crate) fn go_on_with_events(
        &mut self,
        (time, state): &mut (S, M::State<S>),
    ) -> Result<(), Fault> {
        let Some(mut hybrid) = self.hybrid.take() else {
            return Ok(());
        };
        if *time < hybrid.end {
            let before = self.monitor.is_some().then(|| self.energies(*time, state));
            let done = self.call(&mut hybrid, Called::Controllers, *time, state)?;
            if done.changed {
                self.switch(&mut hybrid, *time, state, true)?;
            }
            self.account(before, *time, state);
            if done.stops {
                self.log.stop();
            }
        }
        self.hybrid = Some(hybrid);
        Ok(())
    }

    /// Reports an event that was found, calls its handler and the controllers of the instant that
    /// was reached. The state is the one with which the run goes on.
    pub(crate) fn happen(&mut self, last_good: &mut (S, M::State<S>)) -> Result<(), Fault> {
        let Some(mut hybrid) = self.hybrid.take() else {
            return Ok(());
        };
        let is_found = core::mem::take(&mut hybrid.is_found);
        if is_found && self.log.unseen > 0 {
            self.schedule.at(last_good.0, 0);
            self.show(last_good.0, &last_good.1);
        }
        let mut done = Done {
            moved: false,
            changed: false,
            stops: self.log.flow.is_break(),
        };
        if !done.stops {
            let is_turned = self.turn(&mut hybrid, last_good.0, &last_good.1)?;
            if is_turned {
                self.stand(&mut hybrid, last_good.0, &last_good.1, false)?;
                let unseen = self.log.unseen;
                if unseen > 0 && self.schedule.at(last_good.0, unseen) {
                    self.show(last_good.0, &last_good.1);
                }
            }
            done = self.act(&mut hybrid, is_found || is_turned, last_good)?;
            if done.moved || hybrid.is_switched || done.stops && self.log.unseen > 0 {
                self.show(last_good.0, &last_good.1);
            }
        }
        if done.stops {
            self.log.stop();
        }
        self.hybrid = Some(hybrid);
        Ok(())
    }

    fn act(
        &mut self,
        hybrid: &mut Hybrid<'_, S, M>,
        is_found: bool,
        (time, state): &mut (S, M::State<S>),
    ) -> Result<Done, Fault> {
        let time = *time;
        let before = self.monitor.is_some().then(|| self.energies(time, state));
        let mut done = Done {
            moved: false,
            changed: false,
            stops: false,
        };
        if is_found {
            self.read_all(hybrid, time, state, |watch, reading| {
                watch.correct(reading.here, reading.round_off);
            })?;
        }
        hybrid.is_switched = false;
        done.moved = self.switch(hybrid, time, state, false)?;
        if done.moved {
            self.stand(hybrid, time, state, true)?;
        }
        if is_found {
            let handled = self.call_handlers(hybrid, time, state)?;
            if handled.changed {
                self.stand(hybrid, time, state, handled.moved)?;
                if self.switch(hybrid, time, state, true)? {
                    self.stand(hybrid, time, state, true)?;
                }
            }
            done.moved |= handled.moved;
            done.stops = handled.stops;
        }
        if !done.stops && time < hybrid.end {
            let controlled = self.call(hybrid, Called::Controllers, time, state)?;
            if controlled.changed {
                self.stand(hybrid, time, state, controlled.moved)?;
                if self.switch(hybrid, time, state, true)? {
                    self.stand(hybrid, time, state, true)?;
                }
            }
            done.stops = controlled.stops;
        }
        if is_found {
            hybrid.is_fresh = true;
            self.read_all(hybrid, time, state, |watch, reading| {
                watch.settle(reading, done.moved);
            })?;
        }
        self.account(before, time, state);
        Ok(done)
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
    fn call_handlers(
        &mut self,
        hybrid: &mut Hybrid<'_, S, M>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Done, Fault> {
        let mut done = Done {
            moved: false,
            changed: false,
            stops: false,
        };
        let mut handled: Option<S> = None;
        loop {
            let mut next: Option<S> = None;
            hybrid.list.each(&mut |happening| {
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
            let now = self.call(hybrid, Called::Handlers(root), time, state)?;
            done.moved |= now.moved;
            done.changed |= now.changed;
            done.stops |= now.stops;
            handled = Some(root);
        }
    }

    /// Calls what is due at a time, one after the other: each sees what the former have done.
    fn call(
        &mut self,
        hybrid: &mut Hybrid<'_, S, M>,
        called: Called<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<Done, Fault> {
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
        } = hybrid;
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
            let equations = self.march.equations();
            let view = View::new(equations.constants(), time, state);
            let sample = Sample::new(view, equations);
            let mut event = Event::new(sample, name, equations.parameters(), *inputs);
            let flow = happening.act(&mut event)?;
            let (next, held, parameters) = (event.state, event.inputs, event.parameters);
            if let Some(parameters) = parameters {
                let equations = self.march.equations_mut();
                equations.take_parameters(parameters)?;
                equations.renew_limits()?;
                *taken = Some(parameters);
            }
            if held != *inputs || parameters.is_some() {
                self.march.equations_mut().set_inputs(&held)?;
                *inputs = held;
                done.changed = true;
            }
            if next != *state {
                let duration = *end - time;
                let checked = self.checked(time, duration, next, *accepts_any_state);
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

    /// A state that a handler has set, as a start is checked.
    fn checked(
        &self,
        time: S,
        duration: S,
        mut state: M::State<S>,
        accepts_any: bool,
    ) -> Result<M::State<S>, Fault> {
        let equations = self.march.equations();
        let (constants, is_relative) = (equations.constants(), equations.is_relative());
        check_state::<S, M>(&state)?;
        M::rewrap(constants, &mut state);
        if !accepts_any || is_relative {
            check_start::<S, M>(constants, (time, duration), &state, is_relative)?;
        }
        Ok(state)
    }

    fn read_all(
        &self,
        hybrid: &mut Hybrid<'_, S, M>,
        time: S,
        state: &M::State<S>,
        mut take: impl FnMut(&mut Watch<S>, Reading<S>),
    ) -> Result<(), Fault> {
        let ahead = self.ahead(hybrid, time, state);
        let equations = self.march.equations();
        let constants = equations.constants();
        let shaken = |way| shaken::<S, M>(constants, time, state, way);
        let beside = [shaken(1.0), shaken(-1.0)];
        hybrid.list.each(&mut |happening| {
            if happening.watch().is_none() {
                return Ok(());
            }
            let read = |(time, state): (S, &M::State<S>)| {
                happening.read(&Sample::new(View::new(constants, time, state), equations))
            };
            let here = read((time, state));
            let reading = Reading {
                here,
                ahead: read((ahead.0, &ahead.1)),
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
    fn ahead(&self, hybrid: &Hybrid<'_, S, M>, time: S, state: &M::State<S>) -> (S, M::State<S>) {
        let left = hybrid.end - time;
        let mut step = left;
        if hybrid.longest > S::zero() {
            step = step.min(hybrid.longest);
        }
        let constants = self.march.equations().constants();
        let mut rates = M::coordinate_rates(constants, state);
        M::state_rates_into(constants, time, state, &mut rates);
        let rates = M::State::from_parts(rates, Array::zeros());
        let rate = rate::<S, M>(constants, (state, &rates), step);
        if rate * step > ahead::<S>() {
            step = ahead::<S>().quotient(rate);
        }
        (time + step, state.plus([(step, &rates)]))
    }
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
