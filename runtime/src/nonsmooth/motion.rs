//! How quantities move at an instant, and which rates are none.

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::sizes::{AT_REST, ROUND_OFF, part};
use crate::nonsmooth::status::Tracked;
use crate::state::vector::{Array, StateParts as _};

/// How a quantity moves at an instant.
pub(super) struct Motion<S> {
    pub(super) rate: S,
    /// The sum of the sizes of the terms of the rate; the largest one so far. What is held has that
    /// of its effort too: a shaft that never turned has rates of nothing but round-off.
    pub(super) size: S,
}

impl<S: Real> Motion<S> {
    pub(super) fn of<M: Mechanism>(tracked: &mut Tracked<S, M>, scene: &Scene<'_, S, M>) -> Self {
        let quantity = &tracked.interaction.quantity;
        let velocities = scene.bodies.velocities().as_slice();
        let mut size = S::zero();
        quantity.each_part(scene, |place, part| {
            let velocity = velocities.get(place).copied().unwrap_or(S::zero());
            size = size + (part * velocity).abs();
        });
        let status = &mut tracked.status;
        status.largest = status.largest.max(size);
        let kept_from = if status.mode.holds() {
            status.kept_from
        } else {
            S::zero()
        };
        Self {
            rate: quantity.rate(scene),
            size: status.largest.max(kept_from),
        }
    }

    /// Friction makes a rate of what drives slip of a size: it is known to the round-off of that.
    pub(super) fn goes_with(&mut self, slip: S) {
        let round_off = S::constant(ROUND_OFF) * S::EPSILON * slip;
        let size = round_off.quotient(part::<S>(AT_REST, ROUND_OFF));
        self.size = self.size.max(size);
    }

    /// A rate up to this is none.
    pub(super) fn none(&self) -> S {
        part::<S>(AT_REST, ROUND_OFF) * self.size
    }
}
