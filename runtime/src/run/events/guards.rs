//! What ends the steps of a run early: modes of interactions, conditions of events, and laws that
//! switch.

use crate::dynamics::evaluate::Evaluate;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::measure::view::View;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::switch::Switch;
use crate::nonsmooth::paced::moment;
use crate::run::driver::Driver;
use crate::run::events::list::{Happening, Happenings};
use crate::run::events::switching::{Switching, of, readings_of, sliding, undecided};
use crate::run::sample::Sample;
use crate::stepping::guard::{Guard, Guards, Visit};
use crate::stepping::interval::LastStep;
use crate::stepping::modes::Modes;
use crate::stepping::root::first_root;
use crate::stepping::watch::Watch;

/// How much longer than for other switches a moment is, for those of continuous laws in fixed
/// steps.
const UNRESOLVED: f64 = 1e3;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Whether an event may be found within a step.
    #[inline]
    pub(crate) fn looks_for_events(&self) -> bool {
        let always = self.course.settings.interacts || Switching::<S, M>::watches();
        self.course.hybrid.watches || always
    }

    /// The first event within the last step, which began at a time where the bodies stood near by.
    /// The step is not corrected yet, nor shown to the monitor.
    #[inline(never)]
    pub(crate) fn event_within(
        &mut self,
        (start, near): (S, &M::State<S>),
        end: S,
    ) -> Result<Option<StateAt<S, M>>, Fault> {
        let hybrid = &mut self.course.hybrid;
        hybrid.longest = hybrid.longest.max(end - start);
        let is_fresh = hybrid.is_fresh;
        let seen = self.march.equations().seen();
        let mut guards = OfRun {
            modes: Modes::of(
                self.march.equations(),
                self.course.settings.tolerance,
                moment(
                    self.course.settings.fixed_step,
                    hybrid.longest,
                    hybrid.end - start,
                ),
            ),
            // A continuous law holds nothing. One that switches again and again within a fixed step
            // is stiffer than that step resolves; a controlled step follows as often as it is.
            unresolved: match self.march.estimate() {
                None => S::constant(UNRESOLVED) * hybrid.longest,
                Some(_) => S::zero(),
            },
            longest: hybrid.longest,
            list: self.list,
            switching: self.switching.as_deref_mut(),
        };
        let mut step = LastStep {
            march: self.march,
            since: start,
            near: *near,
        };
        let found = first_root(&mut step, &mut guards, (start, end), is_fresh);
        self.march.equations_mut().recall(seen);
        let found = found?;
        if found.is_none() {
            hybrid.is_fresh = false;
        } else {
            let modes = self.march.equations().interactions().iter();
            let mut modes = modes.map(|tracked| tracked.status.is_found);
            hybrid.is_found = modes.any(|is_found| is_found);
            hybrid.event = None;
            self.list.each(&mut |happening| {
                let found = happening.watch().filter(|watch| watch.is_found());
                hybrid.event = hybrid.event.or(found.map(|watch| watch.name()));
                Ok(())
            })?;
            hybrid.is_found |= hybrid.event.is_some();
        }
        Ok(found)
    }
}

/// The guards of a run.
struct OfRun<'g, S: Real, M: Mechanism> {
    modes: Modes<S>,
    list: &'g mut dyn Happenings<S, M>,
    switching: Option<&'g mut Switching<S, M>>,
    /// The longest step so far (s).
    longest: S,
    unresolved: S,
}

impl<S: Real, M: Mechanism> Guards<S, M> for OfRun<'_, S, M> {
    fn each(&mut self, visit: &mut Visit<'_, S, M>) -> Result<(), Fault> {
        self.modes.each(visit)?;
        let longest = self.longest;
        self.list.each(&mut |happening| {
            let Some(&mut watch) = happening.watch() else {
                return Ok(());
            };
            visit(&mut Condition {
                happening,
                watch,
                longest,
            })
        })?;
        let Some(switching) = &mut self.switching else {
            return Ok(());
        };
        let mut readings = None;
        for switch in Switching::<S, M>::of_state() {
            let mut side = Side::<S, M> {
                switch,
                watch: switching.watch(switch),
                readings: &mut readings,
                moment: if switch.is_continuous {
                    self.unresolved
                } else {
                    longest
                },
                is_found: &mut switching.is_found,
            };
            visit(&mut side)?;
            let watch = side.watch;
            switching.keep(switch, &watch);
        }
        Ok(())
    }
}

/// The condition of an event.
struct Condition<'c, S: Real, M: Mechanism> {
    happening: &'c mut dyn Happening<S, M>,
    watch: Watch<S>,
    /// The longest step so far (s).
    longest: S,
}

impl<S: Real, M: Mechanism> Guard<S, M> for Condition<'_, S, M> {
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        let equations = &*equations;
        let view = View::new(equations.constants(), time, bodies);
        let reading = self.happening.read(&Sample::new(view, equations));
        self.watch.checked(time, reading)
    }

    fn is_passed(&self, value: S) -> bool {
        self.watch.is_met(value)
    }

    fn beyond(&self, value: S) -> S {
        self.watch.upwards(value)
    }

    fn keep(&mut self, _equations: &mut dyn Evaluate<S, M>, value: S, root: Option<S>) {
        if let Some(watch) = self.happening.watch() {
            watch.keep(value, root);
        }
    }

    fn go_on(&mut self, _equations: &mut dyn Evaluate<S, M>) {
        if let Some(watch) = self.happening.watch() {
            watch.go_on();
        }
    }

    fn take(
        &mut self,
        _equations: &mut dyn Evaluate<S, M>,
        time: S,
        value: S,
    ) -> Result<(), Fault> {
        match self.happening.watch() {
            Some(watch) => watch.take(time, value, self.longest),
            None => Ok(()),
        }
    }
}

/// The expression of a law that switches.
struct Side<'s, S: Real, M: Mechanism> {
    switch: &'s Switch,
    watch: Watch<S>,
    /// Those of all switches, and when (s).
    readings: &'s mut Option<(S, M::Parameters<S>)>,
    /// Within what part of this (s) it may not switch again and again.
    moment: S,
    is_found: &'s mut bool,
}

impl<S: Real, M: Mechanism> Guard<S, M> for Side<'_, S, M> {
    fn value(
        &mut self,
        equations: &mut dyn Evaluate<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        let known = self.readings.filter(|(since, _)| *since == time);
        let find = || {
            (
                time,
                readings_of::<S, M>(equations.constants(), time, bodies),
            )
        };
        let (_, readings) = self.readings.insert(known.unwrap_or_else(find));
        let value = of::<S, M>(readings, self.switch);
        if value.to_f64().is_nan() {
            return Err(undecided(self.switch, time.to_f64()));
        }
        Ok(value)
    }

    fn is_passed(&self, value: S) -> bool {
        self.watch.is_left(value)
    }

    fn beyond(&self, value: S) -> S {
        self.watch.beyond(value)
    }

    fn keep(&mut self, _equations: &mut dyn Evaluate<S, M>, value: S, root: Option<S>) {
        self.watch.keep(value, root);
    }

    fn go_on(&mut self, _equations: &mut dyn Evaluate<S, M>) {
        self.watch.go_on();
    }

    fn take(
        &mut self,
        _equations: &mut dyn Evaluate<S, M>,
        time: S,
        value: S,
    ) -> Result<(), Fault> {
        let taken = self.watch.take(time, value, self.moment);
        taken.map_err(|_| match self.switch.is_continuous {
            true => undecided(self.switch, time.to_f64()),
            false => sliding(self.switch, time),
        })?;
        *self.is_found |= self.watch.is_found();
        Ok(())
    }
}
