//! Why a step is refused: its stages once more, with a look at the rates of each.

use super::System;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// A fault of a stage that says why; else that of the same once more, with a look at the rates of
/// every stage.
pub(super) fn named<S: Real, X: Vector<S>, T>(
    fault: Option<Fault>,
    system: &mut dyn System<S, State = X>,
    again: impl FnOnce(&mut Checked<'_, S, X>) -> Result<T, Fault>,
) -> Option<Fault> {
    if let Some(known) = fault
        && !matches!(known, Fault::StateNotFinite)
    {
        return Some(known);
    }
    match failing(system, again) {
        Ok((time, state)) => system.why(time, &state).or(fault),
        Err(known) => known.or(fault),
    }
}

/// Time and state of the first stage whose rates are not finite; else a fault that was known there,
/// if there was one. No part of its caller, whose question why goes deep.
#[inline(never)]
fn failing<S: Real, X: Vector<S>, T>(
    system: &mut dyn System<S, State = X>,
    again: impl FnOnce(&mut Checked<'_, S, X>) -> Result<T, Fault>,
) -> Result<(S, X), Option<Fault>> {
    let mut checked = Checked {
        system,
        failed: None,
    };
    let fault = again(&mut checked).err();
    checked.failed.ok_or(fault)
}

/// A system that looks at the rates of every stage; one piece of code for all systems with such
/// states.
pub(super) struct Checked<'a, S, X> {
    system: &'a mut dyn System<S, State = X>,
    /// The first stage whose rates are not finite.
    failed: Option<(S, X)>,
}

impl<S: Copy, X: Clone> Checked<'_, S, X> {
    // Once a run: no part of a stage, and of its stack.
    #[inline(never)]
    fn remember(&mut self, time: S, state: &X) {
        self.failed = Some((time, state.clone()));
    }
}

impl<S: Real, X: Vector<S>> System<S> for Checked<'_, S, X> {
    type State = X;

    fn rates(&mut self, time: S, state: &X) -> Result<X, Fault> {
        let mut rates = state.clone();
        self.stage(time, state, &mut rates)?;
        Ok(rates)
    }

    fn stage(&mut self, time: S, state: &X, rates: &mut X) -> Result<(), Fault> {
        match self.system.stage(time, state, rates) {
            Ok(()) if rates.is_finite() => Ok(()),
            Ok(()) | Err(Fault::StateNotFinite) => {
                self.remember(time, state);
                Err(Fault::StateNotFinite)
            }
            Err(known) => Err(known),
        }
    }

    fn with_new_velocities(
        &mut self,
        time: S,
        state: &X,
        step: S,
        rates: &mut X,
    ) -> Result<(), Fault> {
        self.system.with_new_velocities(time, state, step, rates)
    }
}
