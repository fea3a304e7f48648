//! States of a mechanism: as it is described, and some way from there.

use crate::reading::Described;
use crate::reference::State;
use crate::writing::Dice;

impl State {
    /// As the mechanism is described.
    pub(crate) fn start(described: &Described, angles: usize) -> Self {
        let bodies = described.bodies.iter();
        Self {
            time: 0.0,
            poses: bodies
                .clone()
                .map(|body| (body.position, body.orientation))
                .collect(),
            rates: bodies
                .map(|body| (body.velocity, body.angular_velocity))
                .collect(),
            turns: vec![0.0; angles],
        }
    }

    /// Some way from there.
    pub(crate) fn random(described: &Described, angles: usize, dice: &mut Dice) -> Self {
        let mut state = Self::start(described, angles);
        state.time = 0.4 + 0.3 * dice.number();
        for ((r, p), (v, w)) in state.poses.iter_mut().zip(&mut state.rates) {
            let (by, turn) = (dice.vector(0.3), dice.unit_quaternion());
            *r = [0, 1, 2].map(|k| r[k] + by[k]);
            let blended = [0, 1, 2, 3].map(|k| p[k] + 0.4 * turn[k]);
            let length = blended.iter().map(|e| e * e).sum::<f64>().sqrt();
            *p = blended.map(|e| e / length);
            (*v, *w) = (dice.vector(1.0), dice.vector(1.0));
        }
        state
            .turns
            .iter_mut()
            .for_each(|turns| *turns = dice.below(7) as f64 - 3.0);
        state
    }

    /// With Euler parameters some percent too long or too short.
    pub(crate) fn stretched(&self, dice: &mut Dice) -> Self {
        let mut state = self.clone();
        for (_, p) in &mut state.poses {
            let factor = 1.0 + 0.05 * dice.number();
            *p = p.map(|e| factor * e);
        }
        state
    }
}
