//! States of a mechanism: as it is described, and some way from there.

use crate::reading::Described;
use crate::reference::{State, euler_rates};
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

    /// After a small motion of all bodies; `None` for one that is not small.
    pub(crate) fn moved(&self, described: &Described, motion: &[f64]) -> Option<Self> {
        let mut state = self.clone();
        let mut motion = motion.iter().copied();
        let mut next = || {
            let parts = [(); 3].map(|()| motion.next().unwrap_or(f64::NAN));
            // Not a number is not small.
            parts.iter().all(|x| x.abs() < 3.0).then_some(parts)
        };
        for ((r, p), body) in state.poses.iter_mut().zip(&described.bodies) {
            let way = next()?;
            *r = [0, 1, 2].map(|k| r[k] + way[k]);
            if body.inertia.is_some() {
                let rates = euler_rates(*p, next()?);
                let turned = [0, 1, 2, 3].map(|k| p[k] + rates[k]);
                let length = turned.iter().map(|e| e * e).sum::<f64>().sqrt();
                *p = turned.map(|e| e / length);
            }
        }
        Some(state)
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
