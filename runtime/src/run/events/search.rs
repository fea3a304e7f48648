//! The first event within a step, on the dense output of the method.

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::Advance;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::run::events::list::{Happening, Hybrid};
use crate::run::events::looked::Looked;
use crate::run::events::root::{MOST, locate};
use crate::run::events::switching::{Switching, of, sliding, undecided};
use crate::run::events::watch::{is_same, looks};
use crate::run::followed::bodies_within;
use crate::run::sample::Sample;
use crate::run::segments::Run;

/// How much longer than for other switches a moment is, for those of continuous laws in fixed
/// steps.
const UNRESOLVED: f64 = 1e3;

/// The time (s) and the state of an event.
type Found<S, M> = Option<(S, <M as Mechanism>::State<S>)>;

impl<S, M, F, A, C> Run<'_, S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
    /// Whether an event may be found within a step.
    #[inline]
    pub(crate) fn looks_for_events(&self) -> bool {
        let always = A::INTERACTS || Switching::<S, M>::watches();
        let watches = |hybrid: &Hybrid<'_, S, M>| hybrid.watches || always;
        self.hybrid.as_ref().is_some_and(watches)
    }

    /// The time and the state of the first event within the last step, which began at a time where
    /// the bodies stood near by; before the step is corrected or shown to the monitor.
    #[inline(never)]
    pub(crate) fn event_within<K: Advance<S, Dynamics<S, M, F, A, C>>>(
        &mut self,
        integration: &mut K,
        (start, near): (S, &M::State<S>),
    ) -> Result<Found<S, M>, Fault> {
        let Some(hybrid) = &mut self.hybrid else {
            return Ok(None);
        };
        let seen = self.dynamics.seen();
        let step = Step {
            dynamics: &mut self.dynamics,
            end: integration.time(),
            integration,
            since: start,
            near: *near,
        };
        let found = step.first_event(start, hybrid);
        self.dynamics.recall(seen);
        found
    }
}

/// A step that is looked into.
struct Step<'s, S: Real, M: Mechanism, F: Formulation<S>, A, C: Coordinates<M>, K> {
    dynamics: &'s mut Dynamics<S, M, F, A, C>,
    integration: &'s mut K,
    /// The last look (s), and the bodies there.
    since: S,
    near: M::State<S>,
    end: S,
}

impl<S, M, F, A, C, K> Step<'_, S, M, F, A, C, K>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    K: Advance<S, Dynamics<S, M, F, A, C>>,
{
    #[inline(never)]
    fn first_event(
        mut self,
        start: S,
        hybrid: &mut Hybrid<'_, S, M>,
    ) -> Result<Found<S, M>, Fault> {
        hybrid.longest = hybrid.longest.max(self.end - start);
        let mut before = start;
        for time in looks(start, self.end, hybrid.is_fresh) {
            let bodies = self.bodies_at(time)?;
            let mut first = self.first_end_of_a_mode(before, (time, &bodies))?;
            hybrid.list.each(&mut |happening| {
                let root = self.look(happening, before, (time, &bodies))?;
                first = match (first, root) {
                    (Some(first), Some(root)) => Some(first.min(root)),
                    (first, root) => first.or(root),
                };
                Ok(())
            })?;
            let switch = self.look_at_switches(hybrid, before, (time, &bodies))?;
            first = match (first, switch) {
                (Some(first), Some(switch)) => Some(first.min(switch)),
                (first, switch) => first.or(switch),
            };
            let Some(root) = first else {
                hybrid.list.each(&mut |happening| {
                    if let Some(watch) = happening.watch() {
                        watch.go_on();
                    }
                    Ok(())
                })?;
                self.modes_go_on();
                if let Some(switching) = &mut hybrid.switching {
                    switching.each(|_, watch| {
                        watch.go_on();
                        Ok(())
                    })?;
                }
                (before, self.since, self.near) = (time, time, bodies);
                continue;
            };
            // The end of the step where it is there to round-off.
            let is_end = time == self.end && is_same(root, time);
            let root = if is_end { time } else { root };
            let bodies = self.bodies_at(root)?;
            let longest = hybrid.longest;
            let mut is_found = false;
            hybrid.list.each(&mut |happening| {
                let reading = self.read(happening, root, &bodies)?;
                let Some(watch) = happening.watch() else {
                    return Ok(());
                };
                watch.take(root, reading, longest)?;
                is_found |= watch.is_found();
                Ok(())
            })?;
            self.take_ends_of_modes(root, &bodies)?;
            let mut modes = self.dynamics.tracked().iter();
            is_found |= modes.any(|tracked| tracked.status.get().is_found);
            self.take_switches(hybrid, root, &bodies)?;
            hybrid.is_found = is_found;
            return Ok(Some((root, bodies)));
        }
        hybrid.is_fresh = false;
        Ok(None)
    }

    /// Where a condition is met between two times, of which the bodies at the second are known.
    fn look(
        &mut self,
        happening: &mut dyn Happening<S, M>,
        before: S,
        (time, bodies): (S, &M::State<S>),
    ) -> Result<Option<S>, Fault> {
        let reading = self.read(happening, time, bodies)?;
        let Some(&mut watch) = happening.watch() else {
            return Ok(None);
        };
        let mut root = None;
        if watch.is_met(reading) {
            let read = |time: S| {
                let bodies = self.bodies_at(time)?;
                let reading = self.read(happening, time, &bodies)?;
                Ok::<S, Fault>(watch.upwards(reading))
            };
            let found = locate((before, time), watch.upwards(reading), read, MOST)?;
            root = Some(found.plain());
        }
        if let Some(watch) = happening.watch() {
            watch.keep(reading, root);
        }
        Ok(root)
    }

    /// Where the first switch of the state passes its zero between two times, of which the bodies
    /// at the second are known.
    fn look_at_switches(
        &mut self,
        hybrid: &mut Hybrid<'_, S, M>,
        before: S,
        (time, bodies): (S, &M::State<S>),
    ) -> Result<Option<S>, Fault> {
        let switching = hybrid.switching.as_mut();
        let Some(switching) = switching.filter(|_| Switching::<S, M>::watches()) else {
            return Ok(None);
        };
        let readings = self.dynamics.switches(time, bodies);
        let mut first: Option<S> = None;
        switching.each(|switch, watch| {
            let reading = of::<S, M>(&readings, switch);
            if reading.to_f64().is_nan() {
                return Err(undecided(switch, time.to_f64()));
            }
            let mut root = None;
            if watch.is_left(reading) {
                let read = |time: S| {
                    let bodies = self.bodies_at(time)?;
                    let readings = self.dynamics.switches(time, &bodies);
                    Ok::<S, Fault>(watch.beyond(of::<S, M>(&readings, switch)))
                };
                let found = locate((before, time), watch.beyond(reading), read, MOST)?;
                root = Some(found.plain());
                first = match first.zip(root) {
                    Some((first, root)) => Some(first.min(root)),
                    None => root,
                };
            }
            watch.keep(reading, root);
            Ok(())
        })?;
        Ok(first)
    }

    /// Turns the switches that pass their zeros at a time.
    fn take_switches(
        &self,
        hybrid: &mut Hybrid<'_, S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<(), Fault> {
        let longest = hybrid.longest;
        // A continuous law holds nothing. One that switches again and again within a fixed step is
        // stiffer than that step resolves; a controlled step follows as often as it is.
        let unresolved = match self.integration.estimate() {
            None => S::constant(UNRESOLVED) * longest,
            Some(_) => S::zero(),
        };
        let switching = hybrid.switching.as_mut();
        let Some(switching) = switching.filter(|_| Switching::<S, M>::watches()) else {
            return Ok(());
        };
        let readings = self.dynamics.switches(time, bodies);
        let mut is_found = false;
        switching.each(|switch, watch| {
            let reading = of::<S, M>(&readings, switch);
            let found = if switch.is_continuous {
                let found = watch.take(time, reading, unresolved);
                found.map_err(|_| undecided(switch, time.to_f64()))
            } else {
                let found = watch.take(time, reading, longest);
                found.map_err(|_| sliding(switch, time))
            };
            found?;
            is_found |= watch.is_found();
            Ok(())
        })?;
        switching.is_found = is_found;
        Ok(())
    }

    /// The reading of a condition; zero where there is none.
    fn read(
        &self,
        happening: &mut dyn Happening<S, M>,
        time: S,
        bodies: &M::State<S>,
    ) -> Result<S, Fault> {
        let view = self.dynamics.view(time, bodies);
        let reading = happening.read(&Sample::new(view, &*self.dynamics));
        match happening.watch() {
            Some(watch) => watch.checked(time, reading),
            None => Ok(reading),
        }
    }
}

impl<S, M, F, A, C, K> Looked<S, M, F, A, C> for Step<'_, S, M, F, A, C, K>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    K: Advance<S, Dynamics<S, M, F, A, C>>,
{
    fn looked(&self) -> &Dynamics<S, M, F, A, C> {
        self.dynamics
    }

    fn bodies_at(&mut self, time: S) -> Result<M::State<S>, Fault> {
        let near = (self.since, &self.near);
        let bodies = bodies_within(self.dynamics, self.integration, near, time)?;
        Ok(with_unit_orientations::<S, M>(&bodies))
    }
}
