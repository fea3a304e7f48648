//! A step of the generalized-alpha method, solved on the constraints.

use super::trial::Trial;
use super::{Dynamics, Problem, singular, vanishes};
use crate::constraints::extent::extent;
use crate::constraints::extent::farthest;
use crate::error::step::counted;
use crate::error::{Fault, LeavesOut, StartFault, StepFault};
use crate::formulation::{Formulation, add};
use crate::integrate::{AlphaEnd, AlphaStep, RigidConstraints};
use crate::math::scalar::Real;
use crate::math::vec3::{read, write};
use crate::measure::load::AppliedForces;
use crate::mechanism::blocks::add_product;
use crate::mechanism::coordinates::Absolute;
use crate::mechanism::kernels::{Mechanism, Orientation, Rigid, bodies_alone};
use crate::state::vector::{Array, StateParts, Vector};

/// Iterations that a step may take.
const ITERATIONS: usize = 100;

/// From here on changes that do not fall are taken for divergence.
const TRANSIENT: usize = 30;

/// Solutions for a displacement by the gradients at both ends: with those at the end alone one
/// would do.
const BOTH_SIDES: usize = 3;

/// A pivot that has lost this part of its size.
const NEARLY_VANISHED: f64 = 1e-2;

/// A change of so many `EPSILON`, relative, is none.
const ROUND_OFF: f64 = 4.0;

/// Changes fall where they are less than so many iterations before: positions and velocities may
/// take turns.
const TURNS: usize = 4;

/// Below this power of `EPSILON` changes that no longer fall are round-off.
const NOISE: f64 = 0.6;

impl<M, F, S, A, O> RigidConstraints<S> for Dynamics<Problem<M, F, S, Absolute<O>, A>>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    F::Terms: Rigid,
    A: AppliedForces<S, M>,
    O: Orientation,
{
    fn step_on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, M::State<S>>,
    ) -> Result<AlphaEnd<M::State<S>>, Fault> {
        if A::INTERACTS {
            return Err(Fault::Start(StartFault::NoInteractions));
        }
        self.solved_on_constraints(&asked)
    }
}

impl<M, F, S, A, O> Dynamics<Problem<M, F, S, Absolute<O>, A>>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    O: Orientation,
{
    /// See [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    ///
    /// # Errors
    /// [`StepFault::Singular`], [`StepFault::NotSolved`] where the iteration does not converge,
    /// what is not finite.
    #[inline(never)]
    pub(super) fn solved_on_constraints(
        &mut self,
        asked: &AlphaStep<'_, S, M::State<S>>,
    ) -> Result<AlphaEnd<M::State<S>>, Fault> {
        bodies_alone::<M>(LeavesOut::StepMethod)?;
        let mass = M::mass(self.constants());
        let first = M::jacobian(self.constants(), asked.end - asked.step, asked.state);
        let mut trial = Trial::<S, M>::new(asked, first);
        let noise = S::EPSILON.powf(NOISE);
        // The extent alone may be that of one point.
        let size = extent::<S, M>(self.constants(), asked.state).max(farthest(
            M::REPORT.bodies,
            asked.state.coordinates().as_slice(),
        ));
        trial.begin_nearby(size);
        let mut changes = [S::constant(f64::INFINITY); TURNS];
        for iteration in 1..=ITERATIONS {
            let state = trial.state(self.constants());
            let seen = match self.iterate(&mut trial, &state, (size, &mass)) {
                Ok(seen) => seen,
                // What is wrong where the iteration begins is wrong with the motion, later with the
                // iteration.
                Err(fault) if iteration == 1 => return Err(fault),
                Err(_) => return Err(self.unsolved(asked, iteration)),
            };
            let [before, ..] = changes;
            let fell = seen.change < S::constant(0.9) * before;
            let is_solved = seen.change <= S::constant(ROUND_OFF) * S::EPSILON
                || seen.resolved <= noise && !fell;
            if is_solved {
                self.look(seen.pivot);
                return self.ended(&trial, iteration);
            }
            if !fell && iteration >= TRANSIENT {
                return Err(self.unsolved(asked, iteration));
            }
            changes.rotate_left(1);
            if let Some(last) = changes.last_mut() {
                *last = seen.change;
            }
        }
        Err(self.unsolved(asked, ITERATIONS))
    }

    /// That the iteration does not converge, and the joint whose pivot has nearly vanished at the
    /// start of the step.
    #[cold]
    fn unsolved(&self, asked: &AlphaStep<'_, S, M::State<S>>, iterations: usize) -> Fault {
        let (constants, start) = (self.constants(), asked.end - asked.step);
        let (_, pivot) =
            M::factor::<S, F::Terms>(constants, &self.absolute.coefficients, start, asked.state);
        let is_near = pivot.relative < S::constant(NEARLY_VANISHED);
        let joint = M::REPORT.joints.get(pivot.joint.to_f64() as usize);
        Fault::Step(StepFault::NotSolved {
            step: asked.step.to_f64(),
            iterations: counted(iterations),
            joint: joint.filter(|_| is_near).map(|info| info.name),
        })
    }

    /// One iteration.
    ///
    /// ```text
    /// [ M  D^T ] [ y  ]   [ w (g - M u') ]      [ M  D^T ] [ z   ]   [  0   ]
    /// [ D   0  ] [ mu ] = [    -Phi'     ]      [ D   0  ] [ eta ] = [ -Phi ]
    /// ```
    ///
    /// with `w` the change of velocities for one of accelerations. Positions take half of the loads
    /// of `eta` as they were at the start.
    fn iterate(
        &self,
        trial: &mut Trial<'_, S, M>,
        state: &M::State<S>,
        (size, mass): (S, &M::Velocities<S>),
    ) -> Result<Iteration<S>, Fault> {
        let (constants, coefficients) = (&self.absolute.constants, &self.absolute.coefficients);
        let end = trial.asked.end;
        let (factors, pivot) = M::factor::<S, F::Terms>(constants, coefficients, end, state);
        if vanishes::<S, F::Terms>(pivot.relative) {
            return Err(singular::<S, M>(&pivot));
        }
        let weight = trial.weight();
        let forces = self.all_forces(end, state);
        let mut upper = forces;
        let elements = upper.as_mut_slice().iter_mut().zip(mass.as_slice());
        for ((force, &mass), &acceleration) in elements.zip(trial.accelerations.as_slice()) {
            *force = weight * (*force - mass * acceleration);
        }
        let phi = M::constraints(constants, end, state);
        let phi_rate = negative(M::constraint_rates(constants, end, state));
        let solve = |upper: &M::Velocities<S>, lower: &M::Multipliers<S>| {
            M::solve::<S, F::Terms>(constants, coefficients, &factors, upper, lower)
        };
        let (faster, mut multipliers) = solve(&upper, &phi_rate);
        let jacobian = M::jacobian(constants, end, state);
        let mut farther = M::Velocities::<S>::zeros();
        let mut left = phi;
        // By the gradients at the end alone: what vanishes with the violation, however those at the
        // start are.
        let mut violation = None;
        for _ in 0..BOTH_SIDES {
            let (last, eta) = solve(&Array::zeros(), &negative(left));
            violation.get_or_insert(last);
            let more = trial.on_both_sides(&last, &eta, mass);
            add(farther.as_mut_slice(), S::one(), more.as_slice());
            left = phi;
            let (step, sum) = (farther.as_slice(), left.as_mut_slice());
            add_product(M::REPORT.blocks, jacobian.as_slice(), step, sum);
        }
        for multiplier in multipliers.as_mut_slice() {
            *multiplier = multiplier.quotient(weight);
        }
        trial.take(&faster, &farther, (size, mass));
        let norm = |vector: &M::Velocities<S>| norm(vector.as_slice(), mass.as_slice());
        let mut free = forces;
        let elements = free.as_mut_slice().iter_mut().zip(mass.as_slice());
        elements.for_each(|(x, &mass)| *x = x.quotient(mass));
        let speed = norm(state.velocities()) + trial.asked.step * norm(&free);
        let place = norm(&places::<S, M>(state));
        let violation = norm(&violation.unwrap_or(farther));
        let (change, opened) = (norm(&faster), ratio(violation, place));
        let coarse = speed + place.quotient(trial.asked.step);
        let sum = change + norm(&farther) + violation + coarse;
        if !sum.is_finite() {
            return Err(self.evaluator().fault(end, state));
        }
        Ok(Iteration {
            change: ratio(change, speed).max(opened),
            resolved: ratio(change, coarse).max(opened),
            pivot: pivot.relative,
        })
    }

    /// The end of a step that was solved.
    fn ended(
        &mut self,
        trial: &Trial<'_, S, M>,
        iterations: usize,
    ) -> Result<AlphaEnd<M::State<S>>, Fault> {
        let end = trial.asked.end;
        let state = trial.state(self.constants());
        let coordinate_rates = M::coordinate_rates(self.constants(), &state);
        let slope = M::State::from_parts(coordinate_rates, trial.accelerations);
        if !(state.is_finite() && slope.is_finite()) {
            return Err(self.evaluator().fault(end, &state));
        }
        Ok(AlphaEnd {
            auxiliary: M::State::from_parts(Array::zeros(), trial.auxiliary()),
            state,
            slope,
            evaluations: iterations,
        })
    }
}

/// What an iteration tells.
struct Iteration<S> {
    /// By how much velocities have changed and positions are off, relative to what they are.
    change: S,
    /// The same, but a velocity that passes over all positions in a step counts as one: what
    /// positions do not resolve, stiff springs show in velocities.
    resolved: S,
    /// The smallest relative pivot.
    pivot: S,
}

/// What the digits of positions are of: places of centres of mass, and one radian.
fn places<S: Real, M: Mechanism>(state: &M::State<S>) -> M::Velocities<S> {
    let mut places = M::Velocities::<S>::zeros();
    let elements = places.as_mut_slice();
    elements.fill(S::one());
    for body in M::REPORT.bodies {
        let centre: [S; 3] = read(state.coordinates().as_slice(), body.coordinate);
        write(elements, body.velocity, centre);
    }
    places
}

fn negative<S: Real, X: Array<S>>(mut vector: X) -> X {
    vector.as_mut_slice().iter_mut().for_each(|x| *x = -*x);
    vector
}

/// The norm in the metric of the mass.
fn norm<S: Real>(vector: &[S], mass: &[S]) -> S {
    let pairs = vector.iter().zip(mass);
    let sum = pairs.fold(S::zero(), |sum, (&x, &mass)| (x * x).fused(mass, sum));
    sum.sqrt()
}

/// A change relative to what changes; none of nothing.
fn ratio<S: Real>(change: S, size: S) -> S {
    if change == S::zero() {
        change
    } else {
        change.quotient(size)
    }
}
