//! What a penalty leaves of the accelerations that its constraints ask for.
//!
//! It costs an evaluation of the bodies in every sixteenth step of a penalty, and nothing with
//! other formulations. Only it finds a penalty that is too small for the masses while the energy
//! is right. A test has its warning, beside others: `tests/tests/sound/told.rs`.

use super::limits::above;
use super::record::RunFacts;
use super::warning::Warning;
use crate::constraints::row_units::RowUnits;
use crate::math::scalar::Real;
use crate::math::vec3::{read, square};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::Array;

/// What a compliance leaves of the accelerations, over the accelerations themselves, times the
/// radians of motion over which it adds up: what is off at the end, as a part of the motion.
const BIAS: f64 = 1e-2;

/// The largest acceleration that a penalty left of its constraints (m/s^2, angles by the length of
/// the mechanism), and the largest of all.
#[derive(Clone, Copy, Debug)]
pub(super) struct Compliance<S> {
    left: S,
    acceleration: S,
}

impl<S: Real> Compliance<S> {
    pub(super) fn none() -> Self {
        Self {
            left: S::zero(),
            acceleration: S::zero(),
        }
    }

    /// Takes an evaluation of a mechanism with such rows and such a length (m), with compliances
    /// and multipliers of the rows.
    pub(super) fn take<M: Mechanism>(
        &mut self,
        (units, extent): (&RowUnits<S, M>, S),
        (compliances, multipliers): (&M::Multipliers<S>, &M::Multipliers<S>),
        accelerations: &M::Velocities<S>,
    ) {
        let rows = multipliers.as_slice().iter().zip(compliances.as_slice());
        let rows = rows.zip(units.factors()).enumerate();
        for (row, ((&multiplier, &compliance), &factor)) in rows {
            let left = (compliance * multiplier * factor).abs();
            let length = if units.is_length(row) {
                S::one()
            } else {
                extent
            };
            self.left = self.left.max(left * length);
        }
        let elements = accelerations.as_slice();
        for body in M::REPORT.bodies {
            let linear = square(&read::<S, 3>(elements, body.velocity)).sqrt();
            self.acceleration = self.acceleration.max(linear);
            if body.kind == BodyKind::Rigid {
                let angular = square(&read::<S, 3>(elements, body.velocity + 3)).sqrt();
                self.acceleration = self.acceleration.max(angular * extent);
            }
        }
    }

    /// The largest acceleration that was left (m/s^2).
    pub(super) fn left(&self) -> S {
        self.left
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        let bias = if self.acceleration > S::zero() {
            self.left.quotient(self.acceleration)
        } else {
            S::zero()
        };
        if bias == S::zero() || run.rests {
            return None;
        }
        above(bias * run.travel, BIAS).then(|| Warning::Compliance {
            bias: bias.to_f64(),
            travel: run.travel.to_f64(),
        })
    }
}
