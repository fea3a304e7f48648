//! What acts at the start of a run: forces, and what round-off makes of accelerations.

use crate::math::scalar::Real;
use crate::math::vec3::{read, square};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What the monitor is told before the first step, beside the state.
pub(crate) struct Beginning<'a, S: Real, M: Mechanism> {
    /// Accelerations at the start, and where every coordinate is changed in its last digit.
    pub(crate) accelerations: [&'a M::Velocities<S>; 2],
    /// Forces and moments that act, reactions aside.
    pub(crate) forces: &'a M::Velocities<S>,
    pub(crate) mass: &'a M::Velocities<S>,
    /// By what part of their terms accelerations miss the constraints.
    pub(crate) bias: S,
}

/// A state whose coordinates are changed in their last digit, without a pattern that a mechanism
/// could share.
pub(super) fn shaken<S: Real, M: Mechanism>(state: &M::State<S>, length: S) -> M::State<S> {
    const SIGNS: u32 = 0b1011_0010_0111_0100_0110_1110_1010_0011;
    let mut shaken = *state;
    let change = |place: usize, x: S, size: S| {
        let change = S::EPSILON * x.abs().max(size);
        let is_up = SIGNS >> (place % 32) & 1 == 1;
        if is_up { x + change } else { x - change }
    };
    let elements = shaken.coordinates_mut().as_mut_slice();
    for body in M::REPORT.bodies {
        let place = body.coordinate;
        let ends = match body.kind {
            BodyKind::Rigid => place + 7,
            BodyKind::Particle => place + 3,
        };
        for k in place..ends {
            let size = if k < place + 3 {
                length
            } else {
                S::constant(0.5)
            };
            if let Some(element) = elements.get_mut(k) {
                *element = change(k + 1, *element, size);
            }
        }
    }
    shaken
}

impl<S: Real, M: Mechanism> Beginning<'_, S, M> {
    /// What the last digit of the coordinates changes of the accelerations (m/s^2, angles by the
    /// length of the mechanism), and that of the forces that may meet in the lightest body.
    pub(super) fn noise(&self, length: S) -> S {
        let [here, there] = self.accelerations;
        let mut noise = M::Velocities::<S>::zeros();
        let pairs = here.as_slice().iter().zip(there.as_slice());
        for (x, (&a, &b)) in noise.as_mut_slice().iter_mut().zip(pairs) {
            *x = b - a;
        }
        largest::<S, M>(&noise, length).max(S::EPSILON * self.of_the_lightest())
    }

    /// The acceleration (m/s^2) of the lightest body by all forces: reactions that carry them may
    /// cancel there.
    fn of_the_lightest(&self) -> S {
        let bodies = M::REPORT.bodies.iter();
        let loads = bodies.map(|body| {
            let [mass]: [S; 1] = read(self.mass.as_slice(), body.velocity);
            let force = square(&read::<S, 3>(self.forces.as_slice(), body.velocity)).sqrt();
            (mass, force)
        });
        let lighter = |(least, sum): (S, S), (mass, force): (S, S)| (least.min(mass), sum + force);
        match loads.reduce(lighter) {
            Some((least, sum)) if least > S::zero() => sum.quotient(least),
            _ => S::zero(),
        }
    }

    /// The largest acceleration without constraints (m/s^2).
    pub(super) fn free(&self, length: S) -> S {
        let mut free = M::Velocities::<S>::zeros();
        let pairs = self.forces.as_slice().iter().zip(self.mass.as_slice());
        for (x, (&force, &mass)) in free.as_mut_slice().iter_mut().zip(pairs) {
            *x = force.quotient(mass);
        }
        largest::<S, M>(&free, length)
    }

    /// The work (J) of all forces over a length, and of all moments over a radian, whatever their
    /// directions.
    pub(super) fn work_over(&self, length: S) -> S {
        let elements = self.forces.as_slice();
        M::REPORT.bodies.iter().fold(S::zero(), |sum, body| {
            let force = square(&read::<S, 3>(elements, body.velocity)).sqrt();
            let moment = if body.kind == BodyKind::Rigid {
                square(&read::<S, 3>(elements, body.velocity + 3)).sqrt()
            } else {
                S::zero()
            };
            force.fused(length, moment) + sum
        })
    }
}

/// The largest translation (m, of so many derivatives) or rotation, by the length of the mechanism.
pub(super) fn largest<S: Real, M: Mechanism>(velocities: &M::Velocities<S>, length: S) -> S {
    let elements = velocities.as_slice();
    M::REPORT.bodies.iter().fold(S::zero(), |largest, body| {
        let largest = largest.max(square(&read::<S, 3>(elements, body.velocity)).sqrt());
        if body.kind == BodyKind::Rigid {
            let turn = square(&read::<S, 3>(elements, body.velocity + 3)).sqrt();
            largest.max(turn * length)
        } else {
            largest
        }
    })
}
