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

impl<S: Real> Status<S> {
    /// When a step ends at the latest in which slip of a size (m/s) at a time (s) turns.
    pub(super) fn pace_of(&self, size: S, time: S) -> Option<Pace<S>> {
        let Haste {
            turning,
            turns,
            grows,
        } = self.exerted.haste;
        let has_turned = self.has_turned || turns;
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

    /// The size (m/s) up to which slip begins, where steps can resolve it at a time (s). They
    /// cannot of what begins from rest.
    pub(super) fn beginning_at(&self, size: S, time: S) -> Option<S> {
        let least = S::constant(4.0 * LEAST_PACE) * time.ulp() * self.exerted.haste.turning;
        let is_resolved =
            self.begins && size > S::zero() && S::constant(PART_OF_SLIP) * size > least;
        is_resolved.then_some(size)
    }

    /// Whether slip of a size (m/s) is so little that it ends if it would stick.
    pub(super) fn is_little(&self, size: S) -> bool {
        self.follows() && size <= part::<S>(LITTLE_SLIP, ROUND_OFF) * self.largest
    }

    /// Whether it slips in a direction that follows the slip.
    pub(crate) fn follows(&self) -> bool {
        self.mode == InteractionMode::Slipping && !self.begins && !self.ends
    }
}
