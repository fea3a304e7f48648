//! What gives a step the slopes of a system: bare, counted, or with a look at each, by which it
//! comes out why a step is refused.

use super::{Counts, SecondOrder, System};
use crate::error::{Fault, StepFault};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::opaque;
use crate::state::vector::Vector;

/// A system as a step sees it.
pub struct Slopes<'a, Y, L> {
    system: &'a mut Y,
    look: L,
}

opaque!([Y, L] Slopes<'_, Y, L>, "Slopes");

/// What is done about every slope: [`Unlooked`], [`Counting`] or [`Checking`].
pub trait Look<S: Scalar, X: Vector<S>> {
    /// Sees that so many slopes are evaluated.
    #[doc(hidden)]
    fn count(&mut self, evaluations: usize);

    /// A slope, see [`System::rates`].
    #[doc(hidden)]
    #[inline(always)]
    fn rates<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
    ) -> Result<X, Fault> {
        self.count(1);
        system.rates(time, state)
    }

    /// Writes a slope, see [`System::stage`].
    #[doc(hidden)]
    fn stage<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
        rates: &mut X,
    ) -> Result<(), Fault>;
}

/// Nothing.
#[derive(Debug)]
pub struct Unlooked;

/// Slopes are counted.
#[derive(Debug)]
pub struct Counting<'a>(&'a mut Counts);

/// Where slopes were evaluated is kept.
#[cfg(feature = "std")]
#[derive(Debug)]
pub struct Recording<'a, S, X>(&'a mut std::vec::Vec<Evaluated<S, X>>);

/// Where a slope was evaluated.
#[cfg(feature = "std")]
#[derive(Debug)]
pub(crate) struct Evaluated<S, X> {
    pub(crate) time: S,
    pub(crate) state: X,
}

/// The first stage whose slope is not finite is kept.
#[derive(Debug)]
pub struct Checking<S, X> {
    failed: Option<(S, X)>,
}

impl<S: Scalar, X: Vector<S>> Look<S, X> for Unlooked {
    #[inline(always)]
    fn count(&mut self, _evaluations: usize) {}

    #[inline(always)]
    fn stage<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
        rates: &mut X,
    ) -> Result<(), Fault> {
        system.stage(time, state, rates)
    }
}

impl<S: Scalar, X: Vector<S>> Look<S, X> for Counting<'_> {
    #[inline(always)]
    fn count(&mut self, evaluations: usize) {
        self.0.evaluations += evaluations;
    }

    #[inline(always)]
    fn stage<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
        rates: &mut X,
    ) -> Result<(), Fault> {
        self.0.evaluations += 1;
        system.stage(time, state, rates)
    }
}

#[cfg(feature = "std")]
impl<S: Scalar, X: Vector<S>> Look<S, X> for Recording<'_, S, X> {
    #[inline(always)]
    fn count(&mut self, _evaluations: usize) {}

    #[inline(always)]
    fn stage<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
        rates: &mut X,
    ) -> Result<(), Fault> {
        self.0.push(Evaluated {
            time,
            state: state.clone(),
        });
        system.stage(time, state, rates)
    }
}

impl<S: Real, X: Vector<S>> Look<S, X> for Checking<S, X> {
    fn count(&mut self, _evaluations: usize) {}

    fn rates<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
    ) -> Result<X, Fault> {
        let mut rates = state.clone();
        self.stage(system, time, state, &mut rates)?;
        Ok(rates)
    }

    fn stage<Y: System<S, State = X>>(
        &mut self,
        system: &mut Y,
        time: S,
        state: &X,
        rates: &mut X,
    ) -> Result<(), Fault> {
        match apart(system, time, state, rates) {
            Ok(()) if rates.is_finite() => Ok(()),
            Ok(()) | Err(Fault::Step(StepFault::StateNotFinite)) => {
                self.remember(time, state);
                Err(Fault::Step(StepFault::StateNotFinite))
            }
            Err(known) => Err(known),
        }
    }
}

impl<S: Copy, X: Clone> Checking<S, X> {
    // Once a run: no part of a stage, and of its stack.
    #[inline(never)]
    fn remember(&mut self, time: S, state: &X) {
        self.failed = Some((time, state.clone()));
    }
}

/// A slope by one piece of code for all stages.
#[inline(never)]
fn apart<S: Real, Y: System<S>>(
    system: &mut Y,
    time: S,
    state: &Y::State,
    rates: &mut Y::State,
) -> Result<(), Fault> {
    system.stage(time, state, rates)
}

impl<'a, Y> Slopes<'a, Y, Unlooked> {
    /// The slopes of a system, bare.
    #[inline(always)]
    pub fn new(system: &'a mut Y) -> Self {
        Self {
            system,
            look: Unlooked,
        }
    }
}

impl<'a, Y> Slopes<'a, Y, Counting<'a>> {
    #[inline(always)]
    pub(super) fn counted(system: &'a mut Y, counts: &'a mut Counts) -> Self {
        Self {
            system,
            look: Counting(counts),
        }
    }
}

#[cfg(feature = "std")]
impl<'a, Y, S, X> Slopes<'a, Y, Recording<'a, S, X>> {
    #[inline(always)]
    pub(super) fn recorded(
        system: &'a mut Y,
        stages: &'a mut std::vec::Vec<Evaluated<S, X>>,
    ) -> Self {
        Self {
            system,
            look: Recording(stages),
        }
    }
}

impl<S: Scalar, Y: System<S>, L: Look<S, Y::State>> System<S> for Slopes<'_, Y, L> {
    type State = Y::State;

    #[inline(always)]
    fn rates(&mut self, time: S, state: &Y::State) -> Result<Y::State, Fault> {
        self.look.rates(self.system, time, state)
    }

    #[inline(always)]
    fn stage(&mut self, time: S, state: &Y::State, rates: &mut Y::State) -> Result<(), Fault> {
        self.look.stage(self.system, time, state, rates)
    }

    fn diagnose(&mut self, time: S, state: &Y::State) -> Option<Fault> {
        self.system.diagnose(time, state)
    }

    fn jacobian(
        &mut self,
        time: S,
        state: &Y::State,
        rates: &Y::State,
        columns: &mut <Y::State as Vector<S>>::Each<Y::State>,
    ) -> Result<usize, Fault>
    where
        S: Real,
    {
        let evaluations = self.system.jacobian(time, state, rates, columns)?;
        self.look.count(evaluations);
        Ok(evaluations)
    }

    #[inline(always)]
    fn follow(&mut self, from: &Y::State, step: S, to: &mut Y::State) {
        self.system.follow(from, step, to);
    }

    #[inline(always)]
    fn renormalise(&mut self, state: &mut Y::State, rates: Option<&mut Y::State>) {
        self.system.renormalise(state, rates);
    }
}

impl<S: Scalar, Y: SecondOrder<S>, L: Look<S, Y::State>> SecondOrder<S> for Slopes<'_, Y, L> {
    #[inline(always)]
    fn with_new_velocities(&mut self, time: S, state: &Y::State, step: S, rates: &mut Y::State) {
        self.system.with_new_velocities(time, state, step, rates);
    }
}

/// A fault of a stage that says why; else that of the same once more, with a look at the rates of
/// every stage.
pub(super) fn named<S: Real, Y: System<S>, T>(
    fault: Option<Fault>,
    system: &mut Y,
    again: impl FnOnce(&mut Slopes<'_, Y, Checking<S, Y::State>>) -> Result<T, Fault>,
) -> Option<Fault> {
    if let Some(known) = fault
        && !matches!(known, Fault::Step(StepFault::StateNotFinite))
    {
        return Some(known);
    }
    match failing(system, again) {
        Ok((time, state)) => system.diagnose(time, &state).or(fault),
        Err(known) => known.or(fault),
    }
}

/// Time and state of the first stage whose rates are not finite; else a fault that was known there,
/// if there was one. No part of its caller, whose question why goes deep.
#[inline(never)]
fn failing<S: Real, Y: System<S>, T>(
    system: &mut Y,
    again: impl FnOnce(&mut Slopes<'_, Y, Checking<S, Y::State>>) -> Result<T, Fault>,
) -> Result<(S, Y::State), Option<Fault>> {
    let mut checked = Slopes {
        system,
        look: Checking { failed: None },
    };
    let fault = again(&mut checked).err();
    checked.look.failed.ok_or(fault)
}
