//! A pose in which the equations do not determine how the motion goes on, or not to the digits that
//! a pose has: a dead point, a change point.
//!
//! The motion goes straight on through it. Poses a little before and behind are determined, and
//! tell position and velocity between them, by cubic interpolation of what they are and of their
//! rates. What it takes has no limit there, so that the sample refuses it by name.

use super::motion::{Found, Motion};
use crate::dynamics::Problem;
use crate::error::{Fault, StepFault};
use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::coordinates::Absolute;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::with_unit_orientations;
use crate::state::vector::{Array, StateParts};

/// How far before and behind (rad, or lengths of the mechanism) the poses are. Interpolation then
/// errs by `0.01^4 / 384`.
const SPAN: f64 = 0.005;

/// How often that is doubled, where so near a pose is not determined either: with few digits.
const DOUBLINGS: u8 = 5;

/// Poses that are looked at around a pivot that is least: each halves the rest of the way.
const LOOKS: u8 = 8;

impl<M, F, S, A> Motion<Problem<M, F, S, Absolute, A>>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    A: AppliedForces<S, M>,
{
    /// The pose at a time at which the equations do not determine one, and how far (rad) it led;
    /// `None` where the motion does not go on behind it.
    #[cold]
    #[inline(never)]
    pub(super) fn across(&mut self, from: &Found<S, M>, time: S) -> Option<(Found<S, M>, S)> {
        let mut span = self.duration(from, S::constant(SPAN));
        for _ in 0..=DOUBLINGS {
            if let Some(found) = self.between(from, time, span) {
                return Some(found);
            }
            span = span + span;
        }
        None
    }

    /// Looks for the least pivot between three poses; the middle one is given, and has the least of
    /// theirs. Steps over a dead point need not come near to it.
    #[cold]
    #[inline(never)]
    pub(super) fn look_into(&mut self, middle: &Found<S, M>, poses: [(S, S); 3]) {
        let ([mut first, mut least, mut last], mut from) = (poses, *middle);
        let mut joint = self
            .pivot(middle)
            .map_or(0, |pivot| pivot.joint.to_f64() as usize);
        for _ in 0..LOOKS {
            let is_behind = last.0 - least.0 > least.0 - first.0;
            let side = if is_behind { last.0 } else { first.0 };
            let time = S::constant(0.5) * (least.0 + side);
            let Ok((found, _)) = self.step(&from, time) else {
                break;
            };
            let Some(pivot) = self.pivot(&found) else {
                break;
            };
            let here = (time, pivot.relative);
            if here.1 < least.1 {
                if is_behind {
                    first = least;
                } else {
                    last = least;
                }
                (least, from) = (here, found);
                joint = pivot.joint.to_f64() as usize;
            } else if is_behind {
                last = here;
            } else {
                first = here;
            }
        }
        self.passage.look_between([first, least, last], joint);
    }

    fn between(&mut self, from: &Found<S, M>, time: S, span: S) -> Option<(Found<S, M>, S)> {
        let (before, first) = if time - from.time > span + span {
            self.step(from, time - span).ok()?
        } else {
            (*from, S::zero())
        };
        let (behind, second) = self.step(&before, time + span).ok()?;
        let length = behind.time - before.time;
        let share = (time - before.time).quotient(length);
        let cubic = Cubic { share, length };
        let [(q, dq), (r, dr)] = [&before, &behind].map(|at| {
            let rates = M::coordinate_rates(self.dynamics.constants(), &at.state);
            (*at.state.coordinates(), rates)
        });
        let (coordinates, _) = cubic.of([&q, &dq, &r, &dr]);
        let (velocities, accelerations) = cubic.of([
            before.state.velocities(),
            &before.accelerations,
            behind.state.velocities(),
            &behind.accelerations,
        ]);
        let state = M::State::from_parts(coordinates, velocities);
        let mut state = with_unit_orientations::<S, M>(&state);
        M::rewrap(self.dynamics.constants(), &mut state);
        let pivot = self.dynamics.rigid_pivot(time, &state);
        let joint = pivot.joint.to_f64() as usize;
        let found = Found {
            time,
            state,
            accelerations,
            evaluation: Err(Fault::Step(StepFault::Singular {
                joint,
                name: M::REPORT.joints.get(joint).map_or("", |info| info.name),
                relative_pivot: pivot.relative.to_f64(),
            })),
        };
        Some((found, first + second))
    }
}

/// The cubic through two values with their rates, at a share of the time between them (s).
struct Cubic<S> {
    share: S,
    length: S,
}

impl<S: Real> Cubic<S> {
    /// Values and rates there, of values and rates at one end and at the other.
    fn of<X: Array<S>>(&self, ends: [&X; 4]) -> (X, X) {
        let (t, h) = (self.share, self.length);
        let [one, two, three] = [1.0, 2.0, 3.0].map(S::constant);
        let rest = one - t;
        // Of the step between the values, and of the two rates.
        let weights = [
            t * t * (three - two * t),
            h * t * rest * rest,
            -h * t * t * rest,
        ];
        let slopes = [
            (two * three * t * rest).quotient(h),
            rest * (one - three * t),
            t * (three * t - two),
        ];
        let [a, da, b, db] = ends.map(Array::as_slice);
        let (mut values, mut rates) = (*ends[0], *ends[1]);
        let places = values.as_mut_slice().iter_mut();
        let places = places
            .zip(rates.as_mut_slice())
            .zip(a.iter().zip(da))
            .zip(b.iter().zip(db));
        for (((value, rate), (&a, &da)), (&b, &db)) in places {
            let parts = [b - a, da, db];
            let sum = |weights: &[S; 3]| {
                let products = weights.iter().zip(parts);
                products.fold(S::zero(), |sum, (&weight, part)| weight.fused(part, sum))
            };
            *value = a + sum(&weights);
            *rate = sum(&slopes);
        }
        (values, rates)
    }
}
