//! Corrections near singular configurations, in runs without a stabilisation.
//!
//! Of joints that are open by a little no two branches cross, and the motion bends from one to the
//! other. So a run closes them on its way through: `docs/decisions/034-straight-on.md`.

use crate::constraints::projection::Projection;
use crate::dynamics::{Dynamics, Solvable, State};
use crate::integrate::Memory;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;

/// A relative pivot, as the square of a distance, that is far from zero. Of a pendulum by bodies
/// pivots fall to a hundredth, where nothing is singular.
const FAR: f64 = 1e-3;

/// The change of a pivot in a step, relative, from which on ten steps or so may reach zero.
const CHANGED: f64 = 0.2;

/// A pivot from which on it is asked whatever a step changes.
const CLOSE: f64 = 1e-4;

/// The part of a pivot, where the motion passed no singular configuration, from which on it is
/// asked again.
const AGAIN: f64 = 0.5;

/// Whether steps end near to a singular configuration that the motion passes.
#[derive(Clone, Copy)]
pub(crate) struct Branching<S> {
    /// The pivot at the end of the last step.
    last: Option<S>,
    is_near: bool,
    /// Whether the end of the last step was looked at: with a compliance every second one is.
    is_due: bool,
    /// The pivot from which on it is asked.
    asked: S,
    /// Whether the error of steps is controlled.
    is_controlled: bool,
}

impl<S: Real> Branching<S> {
    /// Of steps whose error is controlled, or of fixed ones.
    ///
    /// Control shortens steps on the way to a singular configuration until a stage falls upon it,
    /// so equations yield on the way there. No stage of a fixed step does, or one by chance:
    /// equations hold as they are, and yield where a pivot vanishes.
    pub(crate) fn of(is_controlled: bool) -> Self {
        Self {
            is_controlled,
            last: None,
            is_near: false,
            is_due: false,
            asked: S::constant(FAR),
        }
    }

    /// Hands over what it remembers between two steps, and `near` of the dynamics.
    pub(crate) fn remember(&mut self, memory: &mut Memory<'_, S>, near: &mut S) {
        memory.number(near);
        memory.optional(&mut self.last);
        memory.flag(&mut self.is_near);
        memory.flag(&mut self.is_due);
        memory.number(&mut self.asked);
    }

    /// Whether the last step ended near to one.
    #[inline]
    pub(crate) fn is_near(&self) -> bool {
        self.is_near
    }

    /// Sees the end of a step.
    #[inline]
    pub(crate) fn step<P: Solvable<Number = S>>(
        &mut self,
        dynamics: &mut Dynamics<P>,
        time: S,
        state: &State<P>,
    ) {
        if !const { Dynamics::<P>::CLOSES } {
            return;
        }
        self.is_due = !self.is_due;
        let is_asked = self.is_due || self.is_near;
        let Some(pivot) = dynamics.pivot_at_end(time, state, is_asked) else {
            return;
        };
        let last = self.last.replace(pivot);
        if pivot >= S::constant(FAR) {
            self.is_near = false;
            self.asked = S::constant(FAR);
            if self.is_controlled {
                dynamics.be_near();
            }
        } else if self.is_near || pivot < self.asked {
            let changed = last
                .is_some_and(|last| (pivot - last).abs() > S::constant(CHANGED) * pivot.min(last));
            let is_asked = changed || pivot < S::constant(CLOSE);
            self.is_near = is_asked && dynamics.is_crossing(time, *state, pivot);
            if is_asked {
                self.asked = if self.is_near {
                    S::constant(FAR)
                } else {
                    S::constant(AGAIN) * pivot
                };
            }
        }
    }
}

/// A state, with its joints closed where it is near to one. It stays as it is where that is not
/// possible.
#[cold]
#[inline(never)]
pub(crate) fn closed<S: Real, M: Mechanism>(
    constants: &M::Constants<S>,
    time: S,
    state: &M::State<S>,
) -> M::State<S> {
    let mut closed = *state;
    match Projection::default().correct_in_motion::<M>(constants, time, &mut closed) {
        Ok(_) => closed,
        Err(_) => *state,
    }
}
