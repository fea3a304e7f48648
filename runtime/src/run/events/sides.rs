//! The sides of laws that switch, in a run: held within a step, changed between two.
//!
//! A step is then that of a smooth system, whatever the method. `guards.rs` finds where an
//! expression of the state passes its zero, `instants.rs` knows it of the time ahead. Here the side
//! is turned, and the integration begins anew.

use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::switch::Switch;
use crate::run::driver::Driver;
use crate::run::events::instants::Instants;
use crate::run::events::sizes::rate;
use crate::run::events::switching::{digits_of, of, put, readings_of, sliding, undecided};
use crate::state::vector::Array as _;
use crate::stepping::watch::is_same;

/// A trial lasts this part of the time in which something turns by a radian or goes the length of
/// the mechanism, at the most.
const LITTLE: f64 = 1e-4;

/// How much longer the second trial is.
const LONGER: f64 = 64.0;

/// What parts of a trial are tried where it leads back, as a stiff contact does: a law that slides
/// leads back however short they are.
const SHORTER: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// How often the sides may be found anew at an instant, besides once for each.
const ROUNDS: usize = 8;

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Whether the integration begins anew because a law has switched. Turns the sides of those
    /// whose zeros were found, in a state as it was corrected, and takes those of the others.
    pub(crate) fn turn(&mut self, time: S, state: &M::State<S>) -> Result<bool, Fault> {
        let hybrid = &mut self.course.hybrid;
        let Some(switching) = &mut self.switching else {
            return Ok(false);
        };
        let is_found = core::mem::take(&mut switching.is_found);
        if is_found {
            let constants = self.march.equations().constants();
            let readings = readings_of::<S, M>(constants, time, state);
            let digits = digits_of::<S, M>(constants, (time, state), &readings);
            switching.each(|switch, watch| {
                watch.found_at(of::<S, M>(&readings, switch), of::<S, M>(&digits, switch));
                Ok(())
            })?;
        }
        let instant = switching.instant.take();
        let is_due = instant.is_some_and(|instant| time >= instant || is_same(time, instant));
        let (now, end) = (time.to_f64(), hybrid.end.to_f64());
        if is_due {
            let instants = Instants::<M>::new(self.march.equations().parameters());
            for switch in M::SWITCHES {
                if of::<S, M>(&switching.due, switch) != S::zero() {
                    let mut watch = switching.watch(switch);
                    let side = watch.side().to_f64();
                    let side = instants.side_after(switch, side, now, end);
                    watch.begin_at(S::constant(side), S::smallest());
                    switching.keep(switch, &watch);
                }
            }
        }
        if is_found || is_due {
            hybrid.is_fresh = true;
            self.hold();
            self.stand(time, state, false)?;
        }
        Ok(is_found || is_due)
    }

    /// Takes the sides of a state, those at a zero by which way the motion goes. What has just been
    /// found at its zero keeps the side that it has been turned to, unless the state was moved.
    pub(crate) fn stand(
        &mut self,
        time: S,
        state: &M::State<S>,
        is_moved: bool,
    ) -> Result<(), Fault> {
        if self.switching.is_none() {
            return Ok(());
        }
        let mut is_new = is_moved;
        // What an expression holds stands before it, so that a round is enough for most.
        for _ in 0..M::SWITCHES.len() + ROUNDS {
            self.hold();
            if !self.stand_once(time, state, is_new)? {
                self.course.hybrid.is_fresh = true;
                self.hold();
                return Ok(());
            }
            is_new = false;
        }
        let mut jumps = M::SWITCHES.iter().filter(|switch| !switch.is_continuous);
        let first = jumps.next();
        first.map_or(Ok(()), |switch| Err(sliding(switch, time)))
    }

    /// Whether a side was changed.
    fn stand_once(&mut self, time: S, state: &M::State<S>, is_moved: bool) -> Result<bool, Fault> {
        let bounds = [self.course.hybrid.end - time, self.course.hybrid.longest];
        let end = self.course.hybrid.end.to_f64();
        let mut is_changed = false;
        // Until a side is changed, which others may hold.
        let (mut known_instants, mut known_readings) = (None, None);
        for switch in M::SWITCHES {
            let Some(switching) = &self.switching else {
                return Ok(false);
            };
            let mut watch = switching.watch(switch);
            let before = watch.side();
            if switch.is_of_time {
                let instants = known_instants
                    .get_or_insert_with(|| Instants::<M>::new(self.march.equations().parameters()));
                let now = time.to_f64();
                let reading = instants.at(switch, now);
                if reading.is_nan() {
                    return Err(undecided(switch, now));
                }
                // A jump by another one; the zeros of its own are found as such.
                let digits = instants.digits(switch, now);
                let is_beyond = before.to_f64() * reading < -digits;
                // One that comes to rest at zero has no sign any more.
                if reading == 0.0 || before == S::zero() || is_beyond {
                    let side = instants.side_behind(switch, now, end);
                    watch.begin_at(S::constant(side), S::smallest());
                }
            } else {
                let (readings, digits) = known_readings.get_or_insert_with(|| {
                    let constants = self.march.equations().constants();
                    let readings = readings_of::<S, M>(constants, time, state);
                    let digits = digits_of::<S, M>(constants, (time, state), &readings);
                    (readings, digits)
                });
                let digits = of::<S, M>(digits, switch);
                let reading = of::<S, M>(readings, switch);
                if reading.to_f64().is_nan() {
                    return Err(undecided(switch, time.to_f64()));
                }
                // Exactly zero may be where it comes to rest.
                if !watch.stays(reading, digits, is_moved || reading == S::zero()) {
                    let side = match watch.clear_side(reading, digits) {
                        Some(side) => side,
                        None => self.side_of_motion(bounds, switch, (time, state))?,
                    };
                    watch.begin_at(side, digits);
                }
                watch.read(reading);
            }
            if watch.side() != before {
                is_changed = true;
                self.march.equations_mut().hold(switch, watch.side());
                (known_instants, known_readings) = (None, None);
            }
            if let Some(switching) = &mut self.switching {
                switching.keep(switch, &watch);
            }
        }
        Ok(is_changed)
    }

    /// The side of an expression at its zero by which way the motion goes; 0 where it rests there.
    /// By what is left of the run (s), and the longest step so far.
    fn side_of_motion(
        &mut self,
        [left, longest]: [S; 2],
        switch: &Switch,
        (time, state): (S, &M::State<S>),
    ) -> Result<S, Fault> {
        let held = of::<S, M>(self.march.equations().parameters(), switch);
        let seen = self.march.equations().seen();
        let longest = if longest > S::zero() {
            left.min(longest)
        } else {
            left
        };
        let mut step = longest;
        let equations = self.march.equations();
        let rates = equations.evaluation(time, state)?.rates;
        let fastest = rate::<S, M>(equations.constants(), (state, &rates), longest);
        if fastest * step > S::constant(LITTLE) {
            step = S::constant(LITTLE).quotient(fastest);
        }
        let mut found = None;
        for length in [S::one(), S::constant(LONGER)] {
            let step = (length * step).min(longest);
            found = self.side_by_trial(switch, (time, state), step)?;
            if found != Some(S::zero()) {
                break;
            }
        }
        for part in SHORTER {
            if found.is_none() {
                found = self.side_by_trial(switch, (time, state), S::constant(part) * step)?;
            }
        }
        // A continuous law is the same on both sides: the shortest trial tells where it leads.
        if found.is_none() && switch.is_continuous {
            let part = SHORTER.last().map_or(S::one(), |&part| S::constant(part));
            self.march.equations_mut().hold(switch, S::zero());
            found = Some(self.way(switch, (time, state), part * step)?);
        }
        let side = found.ok_or_else(|| sliding(switch, time))?;
        self.march.equations_mut().hold(switch, held);
        self.march.equations_mut().recall(seen);
        Ok(side)
    }

    /// The side to which a trial of a length (s) leads, 0 where it leads nowhere; `None` where it
    /// leads back from either side.
    fn side_by_trial(
        &mut self,
        switch: &Switch,
        at: (S, &M::State<S>),
        step: S,
    ) -> Result<Option<S>, Fault> {
        // As the law reads itself: the way that it goes must be right on the side it leads to.
        self.march.equations_mut().hold(switch, S::zero());
        let side = self.way(switch, at, step)?;
        if side == S::zero() {
            return Ok(Some(side));
        }
        self.march.equations_mut().hold(switch, side);
        if self.way(switch, at, step)? != -side {
            return Ok(Some(side));
        }
        self.march.equations_mut().hold(switch, -side);
        Ok((self.way(switch, at, step)? == -side).then_some(-side))
    }

    /// The sign of what an expression changes by in a step.
    fn way(
        &mut self,
        switch: &Switch,
        (time, state): (S, &M::State<S>),
        step: S,
    ) -> Result<S, Fault> {
        let equations = self.march.equations_mut();
        let readings = readings_of::<S, M>(equations.constants(), time, state);
        let before = of::<S, M>(&readings, switch);
        let bodies = equations.trial(time, state, step)?;
        let after = readings_of::<S, M>(equations.constants(), time + step, &bodies);
        let change = of::<S, M>(&after, switch) - before;
        let digits = digits_of::<S, M>(equations.constants(), (time, state), &readings);
        let digits = of::<S, M>(&digits, switch);
        Ok(if change > digits {
            S::one()
        } else if change < -digits {
            -S::one()
        } else {
            S::zero()
        })
    }

    /// The sides as they are kept.
    pub(crate) fn hold(&mut self) {
        if let Some(switching) = &self.switching {
            for switch in M::SWITCHES {
                self.march
                    .equations_mut()
                    .hold(switch, switching.watch(switch).side());
            }
        }
    }

    /// The next instant (s) at which a switch of the time alone passes its zero, up to a time.
    /// Those at the present one are turned at once.
    pub(crate) fn next_switch(&mut self, from: S, until: S) -> Result<S, Fault> {
        if !M::SWITCHES.iter().any(|switch| switch.is_of_time) {
            return Ok(until);
        }
        let Some(switching) = &mut self.switching else {
            return Ok(until);
        };
        'anew: for _ in 0..M::SWITCHES.len() + ROUNDS {
            let instants = Instants::<M>::new(self.march.equations().parameters());
            let (mut next, mut due) = (until, M::Parameters::<S>::zeros());
            let mut is_due = false;
            for switch in M::SWITCHES.iter().filter(|switch| switch.is_of_time) {
                let mut watch = switching.watch(switch);
                let side = watch.side().to_f64();
                let stretch = (from.to_f64(), next.to_f64());
                let Some(root) = instants.first(switch, side, stretch)? else {
                    continue;
                };
                let root = S::constant(root);
                if is_same(root, from) {
                    let side = instants.side_after(switch, side, stretch.0, until.to_f64());
                    watch.begin_at(S::constant(side), S::smallest());
                    switching.keep(switch, &watch);
                    self.march.equations_mut().hold(switch, watch.side());
                    continue 'anew;
                }
                if !(is_due && is_same(root, next)) {
                    due = M::Parameters::<S>::zeros();
                    next = if is_same(root, until) { until } else { root };
                }
                put::<S, M>(&mut due, switch, S::one());
                is_due = true;
            }
            switching.instant = is_due.then_some(next);
            switching.due = due;
            return Ok(next);
        }
        let mut of_time = M::SWITCHES.iter().filter(|switch| switch.is_of_time);
        of_time
            .next()
            .map_or(Ok(until), |switch| Err(undecided(switch, from.to_f64())))
    }
}
