//! Angles that do not count turns, followed from look to look, so that limits on them hold
//! whatever a step turns.
//!
//! Between two looks an angle turns by the mean of both rates, and by half of their difference more
//! or less as long as the rate between is between them. So looks whose rates differ little tell the
//! turns, however many there are.

use core::f64::consts::{FRAC_PI_2, TAU};

use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::interaction::{Law, Limits};
use crate::nonsmooth::quantity::nearest;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{Tracked, Turning};

impl<S: Real, M: Mechanism> Tracked<S, M> {
    /// The value of its quantity, with the turns since the last look of an angle that wraps.
    pub(super) fn value(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> S {
        let quantity = &self.interaction.quantity;
        let value = quantity.value(scene);
        if !quantity.wraps(scene) {
            return value;
        }
        let half = S::constant(0.5);
        let Some(last) = self.status.get().turning else {
            let [lower, upper] = limits.bounds;
            let is_between = lower.is_finite() && upper.is_finite();
            let middle = lower + half * (upper - lower);
            return nearest(value, if is_between { middle } else { S::zero() });
        };
        let mean = half * (last.rate + quantity.rate(scene));
        let turned = mean * (scene.time - last.time);
        nearest(value, last.angle + turned)
    }

    /// The same at the instant of the last look, whatever the rate is now.
    pub(super) fn value_now(&self, limits: &Limits<S>, scene: &Scene<'_, S, M>) -> S {
        let quantity = &self.interaction.quantity;
        match self.status.get().turning {
            Some(last) if quantity.wraps(scene) => nearest(quantity.value(scene), last.angle),
            _ => self.value(limits, scene),
        }
    }

    /// The value a turn further on where that is between the limits.
    pub(super) fn other_turn(
        &self,
        value: S,
        limits: &Limits<S>,
        scene: &Scene<'_, S, M>,
    ) -> Option<S> {
        if !self.interaction.quantity.wraps(scene) {
            return None;
        }
        let turn = S::constant(TAU);
        let [lower, upper] = limits.bounds;
        let others = [value + turn, value - turn];
        others
            .into_iter()
            .find(|&other| other >= lower && other <= upper)
    }

    /// Follows an angle from here on, with a value that is known.
    pub(super) fn begin_turning(&self, angle: S, scene: &Scene<'_, S, M>) {
        let quantity = &self.interaction.quantity;
        if quantity.wraps(scene) {
            let turning = Turning {
                time: scene.time,
                angle,
                rate: quantity.rate(scene),
            };
            self.update(|status| (status.turning, status.ahead) = (Some(turning), None));
        }
    }

    /// Looks ahead; whether the turns from the last look to this one are known.
    pub(crate) fn look_ahead(&self, scene: &Scene<'_, S, M>) -> bool {
        let quantity = &self.interaction.quantity;
        let Law::Limits(limits) = &self.interaction.law else {
            return true;
        };
        let Some(last) = self.status.get().turning else {
            return true;
        };
        let ahead = Turning {
            time: scene.time,
            angle: self.value(limits, scene),
            rate: quantity.rate(scene),
        };
        self.update(|status| status.ahead = Some(ahead));
        let spread = (ahead.rate - last.rate) * (ahead.time - last.time);
        let is_wide = spread.abs() > S::constant(FRAC_PI_2);
        !is_wide
    }
}
