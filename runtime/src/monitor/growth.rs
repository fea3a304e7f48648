//! Whether derivatives that a run carries grow as errors of an unstable motion do.
//!
//! It costs a comparison for each derivative of a state, and nothing in a run without. Only it
//! finds what the values do not show: a pendulum that stands upright exactly, and steps that are
//! too long for what is at rest (`tests/tests/sensitivities/at_rest.rs`).

use super::limits::above;
use super::record::{MonitoredStep, RunFacts};
use super::warning::Warning;
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::state::sums::greater;
use crate::state::vector::{Array as _, StateParts as _};

/// What derivatives by a number of the size of one grow to at most in a motion of a radian, times
/// some safety. Those by a length or a rate grow with the radians.
const LARGE: f64 = 1e3;

/// What is left of the digits where errors have grown as derivatives have.
const LOST: f64 = 1e-2;

/// By how much derivatives grow while the time doubles that do so as a power of it, up to the
/// sixth.
const BY_POWERS: f64 = 1e2;

/// The derivatives along all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Growth<S> {
    start: S,
    /// The relative tolerance of a control.
    relative: Option<S>,
    /// The time since the start when it doubled last.
    doubled: S,
    /// The largest derivatives while it doubled, and since: those of these numbers.
    before: S,
    since: S,
    /// The directions along which they have grown too much, one bit each.
    grew: u64,
}

impl<S: Real> Growth<S> {
    pub(super) fn from(start: S) -> Self {
        Self {
            start,
            relative: None,
            doubled: S::zero(),
            before: S::zero(),
            since: S::zero(),
            grew: 0,
        }
    }

    /// Of a run with this method.
    pub(super) fn over<I: Method<S>>(mut self, integrator: &I) -> Self {
        self.relative = integrator.tolerance().map(|tolerance| tolerance.relative);
        self
    }

    /// Takes a step, after so many radians of motion.
    #[inline]
    pub(super) fn step<M: Mechanism>(&mut self, step: &MonitoredStep<'_, S, M>, travel: S) {
        if S::CARRIES_DERIVATIVES {
            self.look::<M>((step.end, step.state), travel);
        }
    }

    #[inline(never)]
    fn look<M: Mechanism>(&mut self, (time, state): (S, &M::State<S>), travel: S) {
        let coordinates = state.coordinates().as_slice();
        let numbers = coordinates.iter().chain(state.velocities().as_slice());
        self.since = numbers.fold(self.since, |sizes, &number| {
            sizes.with_larger_derivatives(number)
        });
        let duration = (time - self.start).plain();
        if duration >= self.doubled + self.doubled {
            self.doubled = duration;
            let grown = self.grown(travel);
            self.grew = grown.fold(self.grew, |grew, direction| grew | bit(direction));
            (self.before, self.since) = (self.since, S::zero());
        }
    }

    /// The largest derivatives along each direction while the time doubled, and since.
    fn all(&self) -> impl Iterator<Item = [S; 2]> {
        let sizes = [self.before, self.since];
        (0..).map_while(
            move |direction| match sizes.map(|size| size.derivative(direction)) {
                [Some(before), Some(since)] => Some([before, since]),
                _ => None,
            },
        )
    }

    /// The directions along which derivatives are beyond what a motion of so many radians makes of
    /// them.
    fn grown(&self, travel: S) -> impl Iterator<Item = usize> {
        let mut large = S::constant(LARGE) * (S::one() + travel);
        if let Some(relative) = self.relative {
            large = greater(large, S::constant(LOST).quotient(relative));
        }
        let has_grown = move |&(_, [before, since]): &(_, [S; 2])| {
            since > large && before > S::zero() && above(since.quotient(before), BY_POWERS)
        };
        let all = self.all().enumerate();
        all.filter(has_grown).map(|(direction, _)| direction)
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        let before = (0..64).find(|&direction| self.grew & bit(direction) != 0);
        let direction = before.or_else(|| self.grown(run.travel).next())?;
        let [before, since] = self.all().nth(direction)?;
        Some(Warning::GrowingDerivatives {
            direction,
            size: greater(before, since).to_f64(),
        })
    }
}

/// The bit of a direction; none beyond the sixty-fourth.
fn bit(direction: usize) -> u64 {
    1_u64.checked_shl(direction as u32).unwrap_or(0)
}
