//! What a step of the generalized-alpha method is solved for.

use super::secants::{Change, Secants};
use crate::constraints::retract::displaced;
use crate::formulation::add;
use crate::integrate::{AlphaStep, AlphaWeights};
use crate::math::scalar::Real;
use crate::math::vec3::square;
use crate::math::vec3::{cross, read, write};
use crate::mechanism::blocks::add_loads;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};

/// What an iteration displaces bodies by, at most, in radians or sizes of the mechanism, and twice
/// as much after every one that is held to it: stiff springs would throw bodies beyond where what
/// is known of them holds.
const FARTHEST: f64 = 0.02;

/// What a step is solved for.
pub(super) struct Trial<'a, S: Real, M: Mechanism> {
    pub(super) asked: &'a AlphaStep<'a, S, M::State<S>>,
    /// `u1'`.
    pub(super) accelerations: M::Velocities<S>,
    /// `-M^-1 (D0 + D1)^T eta / 2`.
    correction: M::Velocities<S>,
    /// `D0`.
    first: M::Jacobian<S>,
    secants: Secants<S, M>,
    /// What the next iteration may displace bodies by.
    farthest: S,
}

impl<'a, S: Real, M: Mechanism> Trial<'a, S, M> {
    pub(super) fn new(asked: &'a AlphaStep<'a, S, M::State<S>>, first: M::Jacobian<S>) -> Self {
        Self {
            asked,
            accelerations: *asked.slope.velocities(),
            correction: Array::zeros(),
            first,
            secants: Secants::new(),
            farthest: S::constant(FARTHEST),
        }
    }

    /// Begins where bodies go on at their velocities, if their accelerations would throw them:
    /// those of stiff springs last a part of the step only.
    pub(super) fn begin_nearby(&mut self, size: S) {
        let AlphaWeights {
            alpha_m,
            alpha_f,
            beta,
            ..
        } = self.asked.weights;
        let mut thrown = Change::<S, M>::none();
        let square = self.asked.step * self.asked.step;
        let accelerations = self.asked.slope.velocities().as_slice();
        add(thrown.farther.as_mut_slice(), square, accelerations);
        if self.reach(&thrown, size) <= self.farthest {
            return;
        }
        // (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) u1' + alpha_f u0' with beta a1 = (beta -
        // 1/2) a0.
        let rest = (S::one() - alpha_f).reciprocal();
        let share = (beta - S::constant(0.5)).quotient(beta);
        let before = ((S::one() - alpha_m) * share + alpha_m) * rest;
        let mut begin = M::Velocities::<S>::zeros();
        let elements = begin.as_mut_slice();
        add(
            elements,
            before,
            self.asked.auxiliary.velocities().as_slice(),
        );
        add(elements, -alpha_f * rest, accelerations);
        self.accelerations = begin;
    }

    /// `(1 - alpha_f) / (1 - alpha_m)`: what `a1` changes by for a change of `u1'`.
    fn share(&self) -> S {
        let AlphaWeights {
            alpha_m, alpha_f, ..
        } = self.asked.weights;
        (S::one() - alpha_f).quotient(S::one() - alpha_m)
    }

    /// What velocities change by for a change of `u1'`.
    pub(super) fn weight(&self) -> S {
        self.asked.step * self.asked.weights.gamma * self.share()
    }

    /// `a1`.
    pub(super) fn auxiliary(&self) -> M::Velocities<S> {
        let AlphaWeights {
            alpha_m, alpha_f, ..
        } = self.asked.weights;
        let rest = S::one() - alpha_m;
        let mut auxiliary = M::Velocities::<S>::zeros();
        let elements = auxiliary.as_mut_slice();
        add(elements, self.share(), self.accelerations.as_slice());
        let first = self.asked.slope.velocities().as_slice();
        add(elements, alpha_f.quotient(rest), first);
        let before = self.asked.auxiliary.velocities().as_slice();
        add(elements, -alpha_m.quotient(rest), before);
        auxiliary
    }

    /// The displacement `d`.
    fn displacement(&self, auxiliary: &M::Velocities<S>) -> M::Velocities<S> {
        let AlphaStep {
            weights,
            step,
            state,
            auxiliary: before,
            ..
        } = self.asked;
        let (step, square) = (*step, *step * *step);
        let mut displacement = self.correction;
        let elements = displacement.as_mut_slice();
        add(elements, step, state.velocities().as_slice());
        let rest = S::constant(0.5) - weights.beta;
        add(elements, square * rest, before.velocities().as_slice());
        add(elements, square * weights.beta, auxiliary.as_slice());
        displacement
    }

    /// `(q1, u1)`.
    pub(super) fn state(&self, constants: &M::Constants<S>) -> M::State<S> {
        let AlphaStep {
            weights,
            step,
            state,
            auxiliary: before,
            ..
        } = self.asked;
        let auxiliary = self.auxiliary();
        let displacement = self.displacement(&auxiliary);
        let mut end = displaced::<S, M>(constants, state, &displacement, S::one());
        let velocities = end.velocities_mut().as_mut_slice();
        let rest = S::one() - weights.gamma;
        add(velocities, *step * rest, before.velocities().as_slice());
        add(velocities, *step * weights.gamma, auxiliary.as_slice());
        end
    }

    /// `-M^-1 (D0 + D1)^T eta / 2` from `-M^-1 D1^T eta`.
    pub(super) fn on_both_sides(
        &self,
        last: &M::Velocities<S>,
        multipliers: &M::Multipliers<S>,
        mass: &M::Velocities<S>,
    ) -> M::Velocities<S> {
        let mut loads = M::Velocities::<S>::zeros();
        let elements = loads.as_mut_slice();
        add_loads(
            M::REPORT.blocks,
            self.first.as_slice(),
            multipliers.as_slice(),
            elements,
        );
        let mut both = *last;
        let half = S::constant(0.5);
        let loads = loads.as_slice().iter().zip(mass.as_slice());
        for (element, (&load, &mass)) in both.as_mut_slice().iter_mut().zip(loads) {
            *element = half * (*element - load.quotient(mass));
        }
        both
    }

    /// Takes what an iteration changes of velocities and of positions, as former ones let expect
    /// the rest.
    pub(super) fn take(
        &mut self,
        faster: &M::Velocities<S>,
        farther: &M::Velocities<S>,
        (size, mass): (S, &M::Velocities<S>),
    ) {
        let displacement = self.displacement(&self.auxiliary());
        let weight = self.weight().reciprocal();
        let mut farther = *farther;
        add_to_rotations::<S, M>(&displacement, &mut farther);
        let change = Change {
            faster: *faster,
            farther,
        };
        let mut step = self.secants.step(&change, (self.asked.step, mass));
        let far = self.reach(&step, size);
        if far > self.farthest {
            step = step.scaled(self.farthest.quotient(far));
            self.secants.shortened(step);
            self.farthest = self.farthest + self.farthest;
        }
        let accelerations = self.accelerations.as_mut_slice();
        add(accelerations, weight, step.faster.as_slice());
        let correction = self.correction.as_mut_slice();
        add(correction, S::one(), step.farther.as_slice());
    }

    /// How far bodies are displaced by a step of the iteration, at most: in radians, or in sizes of
    /// the mechanism (its extent, or its distance from the origin).
    fn reach(&self, step: &Change<S, M>, size: S) -> S {
        let AlphaWeights { beta, gamma, .. } = self.asked.weights;
        let share = self.asked.step * beta.quotient(gamma);
        let mut moved = step.farther;
        add(moved.as_mut_slice(), share, step.faster.as_slice());
        let length = |place| square(&read::<S, 3>(moved.as_slice(), place)).sqrt();
        let mut far = S::zero();
        for body in M::REPORT.bodies {
            if size > S::zero() {
                far = far.max(length(body.velocity).quotient(size));
            }
            if body.kind == BodyKind::Rigid {
                far = far.max(length(body.velocity + 3));
            }
        }
        far
    }
}

/// Makes rotations that follow rotations `d` the changes of `d` that lead there:
/// `z + d x z / 2 + d x (d x z) / 12`, by the first terms of Baker, Campbell and Hausdorff.
fn add_to_rotations<S: Real, M: Mechanism>(
    displacement: &M::Velocities<S>,
    step: &mut M::Velocities<S>,
) {
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.velocity + 3;
            let d: [S; 3] = read(displacement.as_slice(), place);
            let z: [S; 3] = read(step.as_slice(), place);
            let once = cross(&d, &z);
            let [a, b, c] = cross(&d, &once);
            let (half, twelfth) = (S::constant(0.5), S::constant(1.0 / 12.0));
            let change = |z: S, once: S, twice: S| once.fused(half, twice.fused(twelfth, z));
            let ([z1, z2, z3], [o1, o2, o3]) = (z, once);
            let changed = [change(z1, o1, a), change(z2, o2, b), change(z3, o3, c)];
            write(step.as_mut_slice(), place, changed);
        }
    }
}
