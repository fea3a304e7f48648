//! The bodies within a step, with their angles counted over turns.
//!
//! Between two instants an angle turns by the mean of both rates, and by half of their difference
//! more or less as long as the rate between is between them. So instants whose rates differ little
//! tell the turns, however many there are. Where they differ more, the step is halved. A step whose
//! rates differ by many turns resolves no motion but a smooth one, of which Simpson's rule tells
//! them.

use core::ops::Deref;

use crate::dynamics::{Bodies, Dynamics, Solvable, State};
use crate::error::Fault;
use crate::integrate::Advance;
use crate::math::scalar::Scalar as _;
use crate::mechanism::turns;

/// So many instants at most are looked at, one after the other.
const LOOKS: usize = 32;

/// The bodies at a time (s) within the last step of an integration, or at its end, which stood near
/// by at another one.
#[inline]
pub(crate) fn bodies_within<P, K>(
    dynamics: &mut Dynamics<P>,
    integration: &mut K,
    (start, near): (P::Number, &Bodies<P>),
    time: P::Number,
) -> Result<Bodies<P>, Fault>
where
    P: Solvable,
    K: Advance<P::Number, Dynamics<P>>,
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
    let at = |dynamics: &mut &mut Dynamics<P>, time: P::Number| {
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
pub(crate) fn bodies_by_halves<D, P>(
    mut dynamics: D,
    (mut before, near): (P::Number, &Bodies<P>),
    time: P::Number,
    mut at: impl FnMut(&mut D, P::Number) -> Result<State<P>, Fault>,
) -> Result<Bodies<P>, Fault>
where
    D: Deref<Target = Dynamics<P>>,
    P: Solvable,
{
    let half = P::Number::constant(0.5);
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
            next = half.fused(next - before, before);
        }
    }
    let middle = at(&mut dynamics, half.fused(time - before, before))?;
    let end = at(&mut dynamics, time)?;
    let middle = dynamics.bodies_near(&middle, &near);
    let mut bodies = dynamics.bodies_near(&end, &near);
    let constants = dynamics.constants();
    turns::count_through::<P::Number, P::Mechanism>(
        constants,
        [&near, &middle],
        time - before,
        &mut bodies,
    );
    Ok(bodies)
}
