//! The implicit midpoint rule.

use core::mem::swap;

use super::{ErrorModel, Look, NoStages, OneStep, Scheme, Slopes, StepStart, System};
use crate::error::step::counted;
use crate::error::{Fault, StepFault};
use crate::math::scalar::Real;
use crate::state::vector::Vector;

/// The implicit midpoint rule of order 2: `y1 = y0 + h k`, `k = f(t0 + h/2, y0 + h/2 k)`. No
/// estimate of the error.
///
/// Hairer, Lubich and Wanner, *Geometric Numerical Integration*, (I.1.7). It is symmetric: a step
/// back from the end leads to the start. It keeps quadratic invariants (IV.2.1), both up to
/// round-off: a step of Euler parameters at a constant angular velocity multiplies `|p|^2` by 1.
/// And it is symplectic (VI.4.2) where coordinates and momenta are the state.
///
/// The slope `k` is found by fixed-point iteration from that at the start (VIII.6), until it
/// changes by round-off only. An iteration is an evaluation: about seven where `h L` is 0.01, with
/// `L` the largest rate (1/s) of what the system does, sixteen at 0.2; at 2 it does not converge,
/// and such a step ends with [`StepFault::NoFixedPoint`]. Output within a step is by the cubic
/// through states and slopes at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ImplicitMidpoint;

/// Iterations that a step may take: enough for a factor of two thirds each, in `f64`.
const ITERATIONS: usize = 100;

/// From here on changes that do not fall are taken for divergence: what decays critically may
/// change by more before.
const TRANSIENT: usize = 10;

/// Changes that are no more than so many times what the last digit of the state changes are
/// round-off, however large they are beside the state: forces that balance each other leave nothing
/// but that.
const ROUND_OFF: f64 = 16.0;

/// A state whose elements are changed in their last digits: of about one at least, for an element
/// may be near zero beside the lengths that it is added to.
fn shaken<S: Real, X: Vector<S>>(state: &X) -> X {
    let mut is_up = false;
    state.zip(state, |x, _| {
        is_up = !is_up;
        let change = S::constant(ROUND_OFF) * S::EPSILON * x.abs().max(S::one());
        if is_up { x + change } else { x - change }
    })
}

impl<S: Real> Scheme<S> for ImplicitMidpoint {
    type Stages<X: Vector<S>> = NoStages;

    fn stages<X: Vector<S>>(&self, _like: &X) -> NoStages {
        NoStages
    }

    /// `|p|` stays what it is and says nothing of the angle, which is off by `z^3 / 12` after a
    /// step, with `z` the angle of the step.
    fn error_model(&self) -> ErrorModel {
        ErrorModel {
            angle_error: 1.0,
            phase_error: 1.0 / 12.0,
            ..Default::default()
        }
    }
}

impl<S: Real, Y: System<S>> OneStep<S, Y> for ImplicitMidpoint {
    #[inline]
    fn advanced<L: Look<S, Y::State>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        StepStart { time, state, slope }: StepStart<'_, S, Y::State>,
        step: S,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let half = S::constant(0.5) * step;
        let too_long = |iterations| {
            Fault::Step(StepFault::NoFixedPoint {
                step: step.to_f64(),
                iterations: counted(iterations),
            })
        };
        // Elements that are small beside the largest may be round-off throughout.
        let small = S::EPSILON.sqrt();
        let mut floor = S::smallest();
        state.for_each(|element| floor = floor.max(small * element.abs()));
        let (mut middle, mut next) = (slope.clone(), slope.clone());
        // Changes go down every other time: coordinates and velocities may take turns.
        let mut changes = [S::constant(f64::INFINITY); 2];
        let mut falls = true;
        for iteration in 1..=ITERATIONS {
            let stage = state.plus([(half, &middle)]);
            if let Err(fault) = system.stage(time + half, &stage, &mut next) {
                return Err(if falls { fault } else { too_long(iteration) });
            }
            let terms = [(step, &next), (-step, &middle)];
            let change = state.weighted_norm(&stage, floor, terms);
            swap(&mut middle, &mut next);
            let [before, last] = changes;
            let fell = change < before;
            let is_known = change <= S::EPSILON
                || (change <= small && !fell)
                || (!change.is_finite() && falls);
            if is_known {
                return Ok(state.plus([(step, &middle)]));
            }
            falls = fell;
            if !fell && !change.is_finite() {
                return Err(too_long(iteration));
            }
            if !fell && iteration >= TRANSIENT {
                let shaken = shaken(&stage);
                system.stage(time + half, &shaken, &mut next)?;
                let terms = [(step, &next), (-step, &middle)];
                let noise = state.weighted_norm(&stage, floor, terms);
                if change <= S::constant(ROUND_OFF) * noise {
                    return Ok(state.plus([(step, &middle)]));
                }
                return Err(too_long(iteration));
            }
            changes = [last, change];
        }
        Err(too_long(ITERATIONS))
    }
}
