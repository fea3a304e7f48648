//! Whether energy came or went that no force accounts for.
//!
//! It costs the power of the forces a step, an evaluation a step where there are drivers, and both
//! energies at a look. Within steps whose ends do not tell the work, it costs some more powers.
//! Only it finds a penalty that multiplies the energy, and a damped motion that a tolerance feeds:
//! `tests/tests/sound/outside.rs`, `tests/tests/silent/report.rs`.

use super::balance::Balance;
use super::limits::{self, above};
use super::record::{Look, MonitoredStep, RunFacts};
use super::warning::Warning;
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::{read, write};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// A change of energy that no force accounts for, over the energy that the mechanism exchanges:
/// motions go with the root of their energy, so one of this size is right to about a hundredth.
const ENERGY: f64 = 1e-2;

/// How much of the work of forces over a step may be unknown, where two rules for it disagree, with
/// steps that nothing controls: at about two radians of an oscillation a step.
const FOLLOWED: f64 = 0.3;

/// The power of the energy that the period of an orbit goes with.
const PERIOD: f64 = 1.5;

/// The work of a first step is not known, that of the next ones depends on it.
const BEGINNING: usize = 8;

/// The energy of a run, and its balance.
pub(super) struct Energy<S: Scalar, M: Mechanism> {
    balance: Balance<S>,
    /// The end of the last step, where potentials change with time by themselves.
    before: Option<(S, M::State<S>)>,
    /// Whether points are close in the step under way that forces act between.
    is_close: bool,
}

/// Bodies of one state with the user's own states of another.
fn with_states_of<S: Real, M: Mechanism>(bodies: M::State<S>, of: &M::State<S>) -> M::State<S> {
    let mut mixed = bodies;
    for info in M::REPORT.states {
        let value: [S; 1] = read(of.coordinates().as_slice(), info.coordinate);
        write(
            mixed.coordinates_mut().as_mut_slice(),
            info.coordinate,
            value,
        );
    }
    mixed
}

copied!([S: Scalar, M: Mechanism] Energy<S, M>);

impl<S: Real, M: Mechanism> Energy<S, M> {
    /// From a start with these energies (J) on.
    pub(super) fn from(kinetic: S, potential: S) -> Self {
        Self {
            balance: Balance::new(kinetic, potential),
            before: None,
            is_close: false,
        }
    }

    /// Points are close in the step under way that forces act between.
    pub(super) fn comes_close(&mut self) {
        self.is_close = true;
    }

    /// See [`Balance::asks`]. Each power of a driver costs an evaluation, and a phase that drivers
    /// lead is not late by what they exchange.
    #[inline]
    pub(super) fn asks(&self, end: S, power: S) -> Option<(S, S)> {
        if M::REPORT.time.constraints {
            return None;
        }
        self.balance.asks(end, power, self.is_close)
    }

    #[inline]
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>) {
        if let Some(power) = step.power {
            self.balance.add_work(step.end, power, step.work);
        }
        self.is_close = false;
        if M::REPORT.time.potential {
            self.work_by_time(step);
        }
        if let Some(look) = step.look {
            self.look(step.end, look);
        }
    }

    /// Takes the energies at the end of a step that was taken.
    pub(super) fn look(&mut self, time: S, look: &Look<S, M>) {
        self.balance.level(time, look.kinetic, look.potential);
    }

    /// What a potential gains by the time and by the user's own states alone, at either end of a
    /// step.
    fn work_by_time(&mut self, step: &MonitoredStep<'_, S, M>) {
        let (time, state) = (step.end, step.state);
        if let Some((then, before)) = self.before.replace((time, *state)) {
            let energy = |time, state| M::potential_energy(step.constants, time, &state);
            let later = with_states_of::<S, M>(before, state);
            let sooner = with_states_of::<S, M>(*state, &before);
            let at_start = energy(time, later) - energy(then, before);
            let at_end = energy(time, *state) - energy(then, sooner);
            self.balance.add([at_start, at_end]);
        }
    }

    /// Takes what energies are made of at least (J), of which their round-off is.
    pub(super) fn made_of(&mut self, parts: S) {
        self.balance.made_of(parts);
    }

    /// Forces may jump here.
    pub(super) fn restart(&mut self) {
        self.balance.restart();
    }

    /// An event has put so much energy (J) into the mechanism.
    pub(super) fn jump(&mut self, energy: S) {
        self.before = None;
        self.balance.jump(energy);
    }

    /// Whether the work of forces is known well enough for the balance to tell anything.
    pub(super) fn has_balance(&self) -> bool {
        self.balance.tells(ENERGY)
    }

    /// Whether next to nothing works on the mechanism.
    pub(super) fn is_of_a_closed_system(&self) -> bool {
        self.balance.is_of_a_closed_system()
    }

    /// The energy (J) that the mechanism has more than at the start.
    pub(super) fn gained(&self) -> S {
        self.balance.gained()
    }

    /// What no force accounts for at the end, over what is exchanged.
    pub(super) fn drift(&self) -> S {
        self.balance.drift()
    }

    /// What no force accounts for (J), where it was largest.
    pub(super) fn unaccounted(&self) -> S {
        self.balance.unaccounted()
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        if run.rests {
            return None;
        }
        let (change, time) = self.balance.worst();
        let change = change.quotient(run.lives);
        above(change.abs(), ENERGY).then(|| Warning::Energy {
            change: change.to_f64(),
            time: time.to_f64(),
        })
    }

    /// Of a change that is small.
    pub(super) fn phase(&self, run: &RunFacts<S>) -> Option<Warning> {
        let change = self.balance.drift().quotient(run.lives);
        let shift = S::constant(0.5) * change.abs() * run.travel;
        let shift = (shift * run.part_of_vibrations).max(self.shift_of_orbits(run));
        let shift = shift.quotient(run.lives);
        above(shift, limits::PHASE).then(|| Warning::Phase {
            change: change.to_f64(),
            travel: run.travel.to_f64(),
            shift: shift.to_f64(),
        })
    }

    /// By how much a place on the way round is off, over the mean radius (rad).
    ///
    /// The period of an orbit goes with the power -3/2 of its energy, which is less than the
    /// kinetic energy: all that it exchanges says little of it. What a place is off by goes with
    /// the speed there.
    fn shift_of_orbits(&self, run: &RunFacts<S>) -> S {
        // What trembles turns about itself.
        if run.rests {
            return S::zero();
        }
        let mean = self.balance.mean();
        let late = S::constant(PERIOD) * mean.change * run.round;
        (late * mean.peak.sqrt()).quotient(run.lives)
    }

    /// Only where nothing controls the steps.
    pub(super) fn coarse_steps(&self, run: &RunFacts<S>) -> Option<Warning> {
        let share = self.balance.unknown_share();
        let begun = run.steps > BEGINNING && !run.rests;
        let warned = begun && !run.is_controlled && above(share, FOLLOWED);
        warned.then(|| Warning::CoarseSteps {
            share: share.to_f64(),
        })
    }
}
