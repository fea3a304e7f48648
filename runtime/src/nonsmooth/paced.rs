//! Slip of a contact that turns near its zero, in a run: see `pace.rs`.

use crate::integrate::Tolerance;
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::pace::{Haste, Pace};
use crate::nonsmooth::sizes::{ROUND_OFF, part};
use crate::nonsmooth::status::{Status, Tracked};

/// Within a step slip changes by this part of itself at the most.
const PART_OF_SLIP: f64 = 0.5;

/// Slip below this part of what it is the sum of is little.
const LITTLE_SLIP: f64 = 1e-7;

/// Slip is led where its direction goes over into that of what drives it within this part of a
/// fixed step. Of a method that controls its error: of the longest step so far, or of the time that
/// is left.
const LED: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// Slip that is led may grow to so many times of that before its direction is its own again; where
/// that was found it is within this part.
const LED_UP_TO: f64 = 4.0;
const BEYOND_LED: f64 = 0.99;

/// Slip that begins has the direction of its acceleration up to this part of what it is the sum of.
/// The error of its velocity goes with the power 3/2 of that. How many steps then follow its
/// direction goes with the power -1/2.
const BEGUN: f64 = 1e-6;

/// The least step, in units in the last place of the time.
const LEAST_PACE: f64 = 64.0;

/// When (s) a step ends at the latest that begins at a time and may end at another, by a method
/// with a tolerance or one of fixed steps.
pub(crate) fn end_of_step<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    (from, until): (S, S),
    tolerance: Option<Tolerance<S>>,
) -> S {
    let paces = list.iter().filter_map(|tracked| tracked.status.pace);
    let ends = paces.filter_map(|pace| pace.end_of_step(tolerance));
    ends.filter(|&end| end > from).fold(until, S::min)
}

/// How long (s) what drives slip takes at the most to turn slip that it leads. It goes by a fixed
/// step (s), or else by the longest one so far and by the time until the end of a run.
pub(crate) fn moment<S: Real>(fixed_step: Option<S>, longest: S, left: S) -> S {
    let [fixed, controlled, of_run] = LED.map(S::constant);
    let left = if left.is_finite() { left } else { S::zero() };
    let by_control = (controlled * longest).max(of_run * left);
    fixed_step.map_or(by_control, |step| fixed * step)
}

impl<S: Real> Status<S> {
    /// The size (m/s) up to which slip of a size is led by what drives it, if it is. It then stays
    /// nearly as it is, and has the direction of what drives it within a moment (s).
    pub(super) fn led(&self, size: S, moment: S) -> Option<S> {
        let most = moment * self.exerted.haste.steady;
        let is_led = self.follows() && size < most;
        is_led.then_some(S::constant(LED_UP_TO) * most)
    }

    /// The size (m/s) up to which slip of a size is led after an instant, if it was before or is by
    /// the last reading.
    pub(super) fn goes_on_led(&self, size: S) -> Option<S> {
        let is_within = |most: &S| size < S::constant(BEYOND_LED) * *most;
        let before = self.beginning.filter(|most| self.begins && is_within(most));
        self.last_led.or(before)
    }

    /// When a step ends at the latest in which slip of a size (m/s) at a time (s) turns.
    pub(super) fn pace_of(&self, size: S, time: S) -> Option<Pace<S>> {
        let Haste {
            turning,
            turns,
            grows,
            steady,
        } = self.exerted.haste;
        let has_turned = self.has_turned || turns || steady > S::zero();
        let is_paced = self.follows() && has_turned && turning > S::zero();
        is_paced.then(|| {
            let step = (S::constant(PART_OF_SLIP) * size).quotient(turning);
            Pace {
                until: time + step.max(S::constant(LEAST_PACE) * time.ulp()),
                grown: if grows { size } else { S::zero() },
                largest: self.largest,
            }
        })
    }

    /// Begins to follow slip of a size (m/s) at a time (s), which may be led up to another size.
    pub(super) fn pace_from(&mut self, time: S, size: S, led: Option<S>) {
        let begun = S::constant(BEGUN) * self.largest;
        self.beginning = led.or(self.beginning_at(begun, time));
        self.last_led = None;
        self.pace = self.pace_of(size, time);
        self.known_pace = self.pace;
        self.has_turned |= self.pace.is_some();
    }

    /// The size (m/s) up to which slip begins, where steps can resolve it at a time (s). They
    /// cannot of what begins from rest.
    fn beginning_at(&self, size: S, time: S) -> Option<S> {
        let least = S::constant(4.0 * LEAST_PACE) * time.ulp() * self.exerted.haste.turning;
        let is_resolved =
            self.begins && size > S::zero() && S::constant(PART_OF_SLIP) * size > least;
        is_resolved.then_some(size)
    }

    /// Whether slip of a size (m/s) is so little that it ends if it would stick.
    pub(super) fn is_little(&self, size: S) -> bool {
        size <= part::<S>(LITTLE_SLIP, ROUND_OFF) * self.largest
    }

    /// Whether it slips in a direction that follows the slip.
    pub(crate) fn follows(&self) -> bool {
        self.mode == InteractionMode::Slipping && !self.begins && !self.ends
    }
}
