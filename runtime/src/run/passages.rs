//! What a run does where lengths pass through zero: see `passing.rs`.

use crate::constraints::extent::largest;
use crate::error::{Fault, ModeFault};
use crate::math::scalar::Real;
use crate::math::vec3::minus;
use crate::mechanism::at::{At, StateAt};
use crate::mechanism::kernels::Mechanism;
use crate::run::driver::Driver;
use crate::run::passing::{CLOSE, dot, judged};
use crate::state::vector::{Array, StateParts as _, Vector as _};

impl<S: Real, M: Mechanism> Driver<'_, S, M> {
    /// Whether the last step is taken, which began at a time where the bodies stood near by: no
    /// direction of a force has turned round in it.
    #[inline]
    pub(super) fn is_taken(&mut self, start: (S, &M::State<S>), end: S) -> Result<bool, Fault> {
        if M::SEPARATIONS.is_empty() {
            return Ok(true);
        }
        if self.course.passing.skipped > 0 {
            self.course.passing.skipped -= 1;
            return Ok(true);
        }
        self.look_for_passages(start, end)
    }

    #[inline(never)]
    fn look_for_passages(
        &mut self,
        (start, near): (S, &M::State<S>),
        end: S,
    ) -> Result<bool, Fault> {
        let bodies = self.march.bodies_near(near);
        let ends = [(start, near), (end, &bodies)];
        let mut judged = judged::<S, M>(
            self.march.equations().constants(),
            ends,
            &self.course.passing,
        );
        if let (false, Some(monitor)) = (judged.is_far, &mut self.course.monitor) {
            monitor.comes_close();
            if judged.passes {
                monitor.passes(judged.turns.is_some());
            }
        }
        if self.course.passing.takes_all {
            return Ok(true);
        }
        if judged.turns.is_none() && !judged.is_far && self.course.passing.last.is_some() {
            judged.turns = self.misses([(start, near), (end, &bodies)]);
        }
        let is_near = judged.turns.is_some() || self.course.passing.limit.is_some();
        let size = if is_near {
            self.places(&bodies)
        } else {
            S::zero()
        };
        let taken = self.course.passing.takes(&judged, (start, end), size);
        taken.map_err(|place| holds::<S, M>(place, end))
    }

    /// The place of a length that may have passed through zero twice in a step: it ends far, by the
    /// distance there, from where the velocities at the start lead. Asked after a first passage.
    fn misses(&self, [(start, near), (end, bodies)]: [(S, &M::State<S>); 2]) -> Option<usize> {
        let constants = self.march.equations().constants();
        let rates = M::coordinate_rates(constants, near);
        let rates = M::State::from_parts(rates, Array::zeros());
        let ahead = near.plus([(end - start, &rates)]);
        let mut missed = None;
        M::separations(constants, [(end, &ahead), (end, bodies)], &mut |place,
                                                                        [
            ahead,
            there,
        ]| {
            let off = minus(&there, &ahead);
            if dot(&off, &off) > S::constant(CLOSE) * dot(&there, &there) {
                missed = Some(place);
            }
        });
        missed
    }

    /// How large places are, of bodies here and where they were described.
    fn places(&self, bodies: &M::State<S>) -> S {
        let described = M::initial_state(self.march.equations().constants());
        let size = |state: &M::State<S>| largest(state.coordinates().as_slice());
        size(bodies).max(size(&described))
    }

    /// Whether a step that has failed, of so many seconds at the most, is tried again, shorter: by
    /// their velocities two points meet within it.
    #[cold]
    #[inline(never)]
    pub(super) fn tries_again(&mut self, (time, state): (S, &M::State<S>), step: S) -> bool {
        let step = self.course.passing.limit.unwrap_or(step).min(step);
        if M::SEPARATIONS.is_empty() {
            return false;
        }
        let constants = self.march.equations().constants();
        let rates = M::coordinate_rates(constants, state);
        let rates = M::State::from_parts(rates, Array::zeros());
        let end = time + S::constant(2.0) * step;
        let later = state.plus([(end - time, &rates)]);
        let ends = [(time, state), (end, &later)];
        let judged = judged::<S, M>(constants, ends, &self.course.passing);
        let Some(place) = judged.turns else {
            return false;
        };
        let size = self.places(state);
        let least = self.course.passing.least_of(&judged, (time, end), size);
        let next = (judged.from_start * (end - time)).min(S::constant(0.5) * step);
        // It has failed though it has just gone across.
        if self.course.passing.last == Some(time) {
            return false;
        }
        self.course.passing.plan(next, least, place);
        self.course.passing.refuse(time)
    }

    /// Goes across a length of zero by the velocities, up to a time (s) at the most; whether that
    /// was planned. No method can: its stages would meet the zero. Refused where it takes longer
    /// than any step, and leads farther than the mechanism is large.
    pub(super) fn goes_across(
        &mut self,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
        until: S,
    ) -> Result<bool, Fault> {
        let Some(step) = self.course.passing.across.take() else {
            return Ok(false);
        };
        self.course.passing.next = self.course.passing.limit.take();
        self.course.passing.ends_with_a_jump();
        let end = until.min(*time + step);
        let constants = self.march.equations().constants();
        let rates = M::coordinate_rates(constants, state);
        let rates = M::State::from_parts(rates, Array::zeros());
        let longest = self.course.passing.longest;
        if longest > S::zero() && step > longest {
            // Numbers that have grown so far tell no place from another on the way of a step.
            let way = largest(rates.coordinates().as_slice()) * step;
            let is_within = way <= largest(M::initial_state(constants).coordinates().as_slice());
            if !is_within {
                return Err(holds::<S, M>(self.course.passing.place, *time));
            }
        }
        *state = state.plus([(end - *time, &rates)]);
        *time = end;
        self.course.unseen += 1;
        let counted = self.course.passing.count(end, self.course.passing.place);
        counted.map_err(|place| holds::<S, M>(place, end))?;
        Ok(true)
    }

    /// Leaves a length that is exactly zero on the way of the motion, as little as can be told: its
    /// direction is then that way. One at rest at zero has none, and keeps none.
    pub(super) fn leave_zeros(
        &mut self,
        At {
            time,
            bodies: state,
        }: &mut StateAt<S, M>,
        left: S,
    ) {
        if M::SEPARATIONS.is_empty() {
            return;
        }
        let constants = self.march.equations().constants();
        let mut is_zero = false;
        let ends = [(*time, &*state); 2];
        M::separations(constants, ends, &mut |_, [at, _]| {
            is_zero |= dot(&at, &at) <= S::zero();
        });
        if is_zero {
            let longest = self.course.passing.longest;
            let step = if longest > S::zero() { longest } else { left };
            let rates = M::coordinate_rates(constants, state);
            let rates = M::State::from_parts(rates, Array::zeros());
            let (end, later) = (*time + step, state.plus([(step, &rates)]));
            let ends = [(*time, &*state), (end, &later)];
            let judged = judged::<S, M>(constants, ends, &self.course.passing);
            let size = self.places(state);
            let least = self.course.passing.least_of(&judged, (*time, end), size);
            *state = state.plus([(least.min(step), &rates)]);
        }
    }
}

/// What a force along a line has as its switch.
pub(super) const LENGTH: &str = "length";

/// A force that leads its points together again and again.
#[cold]
fn holds<S: Real, M: Mechanism>(place: usize, time: S) -> Fault {
    Fault::Mode(ModeFault::SlidingLaw {
        law: M::SEPARATIONS.get(place).copied().unwrap_or_default(),
        expression: LENGTH,
        time: time.to_f64(),
    })
}
