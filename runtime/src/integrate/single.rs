//! A single step: whether it leads anywhere, and why not.

#[cfg(feature = "std")]
use super::Evaluated;
use super::{OneStep, Slopes, StepStart, System, named, room_for};
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::state::vector::Vector as _;

/// A step, if it leads to a state that is finite; else why not, if that is known. No part of its
/// caller: its stack is free again where a step is looked into that was refused.
#[inline(never)]
pub(super) fn attempt<S: Real, K: OneStep<S, Y>, Y: System<S>>(
    scheme: &K,
    system: &mut Y,
    (time, state): (S, &mut Y::State),
    step: S,
) -> Result<(), Option<Fault>> {
    let mut slope = room_for(state);
    system.stage(time, state, &mut slope)?;
    let start = StepStart {
        time,
        state,
        slope: &slope,
    };
    let unlooked = &mut Slopes::new(system);
    let mut next = scheme.advanced(unlooked, start, step, &mut scheme.stages(&slope))?;
    if !next.is_finite() {
        return Err(None);
    }
    system.follow(state, step, &mut next);
    *state = next;
    system.renormalise(state, None);
    Ok(())
}

/// Takes a step as [`OneStep::step`] does, and adds the times and states at which it evaluated
/// slopes: the start, and then those of its stages.
///
/// # Errors
/// A fault of the system. The state is then as before.
#[cfg(feature = "std")]
pub(crate) fn recorded<S: Real, K: OneStep<S, Y>, Y: System<S>>(
    scheme: &K,
    system: &mut Y,
    time: S,
    state: &mut Y::State,
    step: S,
    stages: &mut std::vec::Vec<Evaluated<S, Y::State>>,
) -> Result<(), Fault> {
    let begun = stages.len();
    let mut take = |system: &mut Y| {
        let mut slopes = Slopes::recorded(system, stages);
        let mut slope = room_for(state);
        slopes.stage(time, state, &mut slope)?;
        let start = StepStart {
            time,
            state,
            slope: &slope,
        };
        let mut next = scheme.advanced(&mut slopes, start, step, &mut scheme.stages(&slope))?;
        if !next.is_finite() {
            return Err(None);
        }
        system.follow(state, step, &mut next);
        system.renormalise(&mut next, None);
        Ok(next)
    };
    match take(system) {
        Ok(next) => {
            *state = next;
            Ok(())
        }
        Err(fault) => {
            stages.truncate(begun);
            Err(refused(scheme, system, (time, state), step, fault))
        }
    }
}

/// Why a step failed, or led to a state that is not finite.
#[cold]
#[inline(never)]
pub(super) fn refused<S: Real, K: OneStep<S, Y>, Y: System<S>>(
    scheme: &K,
    system: &mut Y,
    (time, state): (S, &Y::State),
    step: S,
    fault: Option<Fault>,
) -> Fault {
    named(fault, system, |system| {
        let slope = &system.rates(time, state)?;
        let start = StepStart { time, state, slope };
        scheme.advanced(system, start, step, &mut scheme.stages(slope))
    })
    .unwrap_or(Fault::Step(StepFault::StateNotFinite))
}
