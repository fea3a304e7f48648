//! What a run remembers of the switches of its mechanism: a [`Watch`] for each.
//!
//! There may be any number of them, and nothing is on a heap: each number of a watch is kept in an
//! array as long as that of the parameters, where the sides of the switches have their places. A
//! run of a mechanism without switches has none of these arrays.

use crate::error::{Fault, ModeFault};
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::mechanism::switch::Switch;
use crate::run::events::sizes::{round_off, shaken};
use crate::state::vector::Array;
use crate::stepping::watch::{Crossing, NUMBERS, Watch};

/// The switches of a mechanism in a run.
pub(crate) struct Switching<S: Real, M: Mechanism> {
    numbers: [M::Parameters<S>; NUMBERS],
    /// Whether one of the state has passed its zero where the last step ended.
    pub(crate) is_found: bool,
    /// When (s) the next ones of the time alone pass theirs, and which they are: their numbers are
    /// not zero there.
    pub(crate) instant: Option<S>,
    pub(crate) due: M::Parameters<S>,
}

/// The number of a switch in an array.
pub(crate) fn of<S: Real, M: Mechanism>(array: &M::Parameters<S>, switch: &Switch) -> S {
    let number = array.as_slice().get(switch.place).copied();
    number.unwrap_or(S::zero())
}

/// The same, to be written.
pub(crate) fn put<S: Real, M: Mechanism>(array: &mut M::Parameters<S>, switch: &Switch, number: S) {
    if let Some(place) = array.as_mut_slice().get_mut(switch.place) {
        *place = number;
    }
}

/// The expressions whose signs decide in laws, in a state of the bodies.
pub(crate) fn readings_of<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    bodies: &M::State<S>,
) -> M::Parameters<S> {
    let mut readings = M::Parameters::<S>::zeros();
    let bodies = with_unit_orientations::<S, M>(bodies);
    M::switches_into(constants, time, &bodies, &mut readings);
    readings
}

/// Down to where each of their readings is at zero.
pub(super) fn digits_of<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    (time, bodies): (S, &M::State<S>),
    readings: &M::Parameters<S>,
) -> M::Parameters<S> {
    let beside = |way| {
        let (time, bodies) = shaken::<S, M>(constants, time, bodies, way);
        readings_of::<S, M>(constants, time, &bodies)
    };
    let (one, other) = (beside(1.0), beside(-1.0));
    let mut digits = *readings;
    for switch in M::SWITCHES {
        let beside = [of::<S, M>(&one, switch), of::<S, M>(&other, switch)];
        let size = round_off(of::<S, M>(readings, switch), beside);
        put::<S, M>(&mut digits, switch, size);
    }
    digits
}

impl<S: Real, M: Mechanism> Switching<S, M> {
    /// Whether some read the motion.
    pub(crate) fn watches() -> bool {
        Self::of_state().next().is_some()
    }

    /// Nothing is known of them.
    pub(crate) fn new() -> Self {
        Self {
            numbers: [Array::zeros(); NUMBERS],
            is_found: false,
            instant: None,
            due: Array::zeros(),
        }
    }

    /// What is known of one.
    pub(crate) fn watch(&self, switch: &Switch) -> Watch<S> {
        let mut numbers = [S::zero(); NUMBERS];
        for (number, array) in numbers.iter_mut().zip(&self.numbers) {
            *number = of::<S, M>(array, switch);
        }
        Watch::of_numbers(switch.expression, Crossing::Either, numbers)
    }

    /// Keeps what is known of one.
    pub(crate) fn keep(&mut self, switch: &Switch, watch: &Watch<S>) {
        for (array, number) in self.numbers.iter_mut().zip(watch.numbers()) {
            put::<S, M>(array, switch, number);
        }
    }

    /// Goes through those of the state.
    pub(crate) fn of_state() -> impl Iterator<Item = &'static Switch> {
        M::SWITCHES.iter().filter(|switch| !switch.is_of_time)
    }

    /// Changes what is known of each of the state.
    pub(crate) fn each(
        &mut self,
        mut change: impl FnMut(&Switch, &mut Watch<S>) -> Result<(), Fault>,
    ) -> Result<(), Fault> {
        for switch in Self::of_state() {
            let mut watch = self.watch(switch);
            change(switch, &mut watch)?;
            self.keep(switch, &watch);
        }
        Ok(())
    }

    /// Hands over what it remembers between two steps.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>) {
        for switch in M::SWITCHES {
            let mut watch = self.watch(switch);
            watch.remember(memory);
            self.keep(switch, &watch);
        }
    }
}

/// A law whose field points to its switch from both sides.
#[cold]
pub(crate) fn sliding<S: Real>(switch: &Switch, time: S) -> Fault {
    Fault::Mode(ModeFault::SlidingLaw {
        law: switch.law,
        expression: switch.expression,
        time: time.to_f64(),
    })
}

/// A switch that is not a number, or that cannot be followed.
#[cold]
pub(crate) fn undecided(switch: &Switch, time: f64) -> Fault {
    Fault::Mode(ModeFault::SwitchUndecided {
        law: switch.law,
        expression: switch.expression,
        time,
    })
}
