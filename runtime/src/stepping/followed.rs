//! The bodies within a step, with their angles counted over turns.
//!
//! Between two instants an angle turns by the mean of both rates, and by half of their difference
//! more or less as long as the rate between is between them. So instants whose rates differ little
//! tell the turns, however many there are. Where they differ more, the step is halved. A step whose
//! rates differ by many turns resolves no motion but a smooth one, of which Simpson's rule tells
//! them.

use core::ops::Deref;

use crate::dynamics::Dynamics;
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::Advance;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::turns;

/// So many instants at most are looked at, one after the other.
const LOOKS: usize = 32;

/// The bodies at a time (s) within the last step of an integration, or at its end, which stood near
/// by at another one.
#[inline]
pub(crate) fn bodies_within<S, M, F, A, C, K>(
    dynamics: &mut Dynamics<S, M, F, A, C>,
    integration: &mut K,
    (start, near): (S, &M::State<S>),
    time: S,
) -> Result<M::State<S>, Fault>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
    K: Advance<S, Dynamics<S, M, F, A, C>>,
{
    let (bodies, is_known) = if time == integration.time() {
        dynamics.bodies_after(integration.state(), (time - start, near))
    } else {
        let state = integration.at(dynamics, time)?;
        dynamics.bodies_after(&state, (time - start, near))
    };
    if is_known {
        return Ok(bodies);
    }
    let seen = dynamics.seen();
    let at = |dynamics: &mut &mut Dynamics<S, M, F, A, C>, time: S| {
        if time == integration.time() {
            Ok(*integration.state())
        } else {
            integration.at(dynamics, time)
        }
    };
    let bodies = bodies_by_halves(&mut *dynamics, (start, near), time, at);
    dynamics.recall(seen);
    bodies
}

/// The bodies at a time (s) that stood near by at another one, by as many instants between as tell
/// the turns.
#[cold]
#[inline(never)]
pub(crate) fn bodies_by_halves<D, S, M, F, A, C>(
    mut dynamics: D,
    (mut before, near): (S, &M::State<S>),
    time: S,
    mut at: impl FnMut(&mut D, S) -> Result<C::State<S>, Fault>,
) -> Result<M::State<S>, Fault>
where
    D: Deref<Target = Dynamics<S, M, F, A, C>>,
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    C: Coordinates<M>,
{
    let (mut near, mut next) = (*near, time);
    for _ in 0..LOOKS {
        let state = at(&mut dynamics, next)?;
        let (bodies, is_known) = dynamics.bodies_after(&state, (next - before, &near));
        if is_known && next == time {
            return Ok(bodies);
        }
        if is_known {
            (before, near, next) = (next, bodies, time);
        } else {
            next = S::constant(0.5).fused(next - before, before);
        }
    }
    let middle = at(&mut dynamics, S::constant(0.5).fused(time - before, before))?;
    let end = at(&mut dynamics, time)?;
    let middle = dynamics.bodies_near(&middle, &near);
    let mut bodies = dynamics.bodies_near(&end, &near);
    let constants = dynamics.constants();
    turns::count_through::<S, M>(constants, [&near, &middle], time - before, &mut bodies);
    Ok(bodies)
}
