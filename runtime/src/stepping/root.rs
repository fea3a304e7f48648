//! Where a step ends early: the first zero that a guard passes within it.

use super::guard::Guards;
use super::interval::Interval;
use super::locate::{MOST, locate};
use super::watch::{is_same, looks};
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;

/// The first time (s) in a step at which a guard passes zero, with the bodies there; `None` of a
/// step that no guard ends. `is_fresh` where guards may be at zero at its start.
///
/// Every guard that passes there knows it. It is the end of the step where it is there to
/// round-off.
#[inline(never)]
pub(crate) fn first_root<S: Real, M: Mechanism>(
    interval: &mut dyn Interval<S, M>,
    guards: &mut dyn Guards<S, M>,
    (start, end): (S, S),
    is_fresh: bool,
) -> Result<Option<StateAt<S, M>>, Fault> {
    let mut before = start;
    for time in looks(start, end, is_fresh) {
        let bodies = interval.bodies_at(time)?;
        let mut first: Option<S> = None;
        guards.each(&mut |guard| {
            let value = guard.value(interval.equations(), time, &bodies)?;
            let mut root = None;
            if guard.is_passed(value) {
                let beyond = guard.beyond(value);
                let read = |time: S| {
                    let bodies = interval.bodies_at(time)?;
                    let value = guard.value(interval.equations(), time, &bodies)?;
                    Ok::<S, Fault>(guard.beyond(value))
                };
                root = Some(locate((before, time), beyond, read, MOST)?.plain());
            }
            first = match (first, root) {
                (Some(first), Some(root)) => Some(first.min(root)),
                (first, root) => first.or(root),
            };
            guard.keep(interval.equations(), value, root);
            Ok(())
        })?;
        let Some(root) = first else {
            guards.each(&mut |guard| {
                guard.go_on(interval.equations());
                Ok(())
            })?;
            interval.look_from(time, bodies);
            before = time;
            continue;
        };
        let is_end = time == end && is_same(root, time);
        let root = if is_end { time } else { root };
        let bodies = interval.bodies_at(root)?;
        guards.each(&mut |guard| {
            let value = guard.value(interval.equations(), root, &bodies)?;
            guard.take(interval.equations(), root, value)
        })?;
        interval.look_from(root, bodies);
        return Ok(Some(At { time: root, bodies }));
    }
    Ok(None)
}
