//! The saddle system of the equations that remain in joint coordinates, and the augmented
//! Lagrangian of it.

use core::marker::PhantomData;

use super::AugmentedLagrangian;
use super::augmented_lagrangian::{add, combine};
use crate::error::{Fault, NotFinite};
use crate::math::scalar::{Real, Scalar};
use crate::math::vec3::square;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{Compliant, Terms};
use crate::state::vector::Array;

/// The saddle system in joint coordinates at one time and state: factorised, and solved once.
pub struct JointSaddle<'a, S: Scalar, M: JointCoordinates, T: Terms> {
    pub(crate) constants: &'a M::JointConstants<S>,
    pub(crate) coefficients: &'a M::JointCoefficients<S>,
    pub(crate) factors: &'a M::JointFactors<S>,
    pub(crate) compliances: &'a M::ClosingMultipliers<S>,
    /// The solution with `lambda_previous = 0`.
    pub(crate) first: JointSolution<S, M>,
    pub(crate) terms: PhantomData<T>,
}

impl<S: Scalar, M: JointCoordinates, T: Terms> JointSaddle<'_, S, M, T> {
    /// The solution with `lambda_previous = 0`.
    #[must_use]
    pub fn solve(&self) -> JointSolution<S, M> {
        self.first
    }

    /// The solution with the multipliers of a solution before.
    #[must_use]
    pub fn solve_after(&self, previous: &M::ClosingMultipliers<S>) -> JointSolution<S, M> {
        let mut lower = self.yielded(previous);
        lower.as_mut_slice().iter_mut().for_each(|row| *row = -*row);
        let (accelerations, multipliers) = M::solve_joints::<S, T>(
            self.constants,
            self.coefficients,
            self.factors,
            &Array::zeros(),
            &lower,
        );
        let mut solution = self.first;
        add(
            solution.accelerations.as_mut_slice(),
            S::one(),
            accelerations.as_slice(),
        );
        add(
            solution.multipliers.as_mut_slice(),
            S::one(),
            multipliers.as_slice(),
        );
        solution
    }

    /// `E lambda`.
    fn yielded(&self, multipliers: &M::ClosingMultipliers<S>) -> M::ClosingMultipliers<S> {
        let mut yielded = *multipliers;
        let rows = yielded.as_mut_slice().iter_mut();
        for (row, &compliance) in rows.zip(self.compliances.as_slice()) {
            *row = *row * compliance;
        }
        yielded
    }
}

/// Accelerations and multipliers of the saddle system in joint coordinates.
pub struct JointSolution<S: Scalar, M: JointCoordinates> {
    /// The rates of the velocities.
    pub accelerations: M::JointVelocities<S>,
    /// `lambda`, one per equation that remains.
    pub multipliers: M::ClosingMultipliers<S>,
    /// How often the system was solved.
    pub iterations: usize,
}

impl<S: Scalar, M: JointCoordinates> Clone for JointSolution<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: JointCoordinates> Copy for JointSolution<S, M> {}

/// A difference of two solutions.
struct Change<S: Scalar, M: JointCoordinates> {
    accelerations: M::JointVelocities<S>,
    multipliers: M::ClosingMultipliers<S>,
}

impl<S: Real, M: JointCoordinates> Change<S, M> {
    fn nothing() -> Self {
        Self {
            accelerations: Array::zeros(),
            multipliers: Array::zeros(),
        }
    }

    fn between(next: &JointSolution<S, M>, last: &JointSolution<S, M>) -> Self {
        let mut change = Self {
            accelerations: next.accelerations,
            multipliers: next.multipliers,
        };
        let back = -S::one();
        add(
            change.accelerations.as_mut_slice(),
            back,
            last.accelerations.as_slice(),
        );
        add(
            change.multipliers.as_mut_slice(),
            back,
            last.multipliers.as_slice(),
        );
        change
    }
}

impl<S: Real> AugmentedLagrangian<S> {
    /// The iteration in joint coordinates, plain and then, where equations nearly depend on each
    /// other, by conjugate gradients.
    ///
    /// With `S = D M^-1 D^T`, a solution after `lambda` changes the multipliers by
    /// `z = (S + E)^-1 r`, where `r = D u' - gamma*` is what is missing at `lambda`. What is
    /// missing after it is `E z`, and so `S z = r - E z`: the mass matrix is not needed.
    pub(super) fn iterate<M: JointCoordinates>(
        &self,
        saddle: &JointSaddle<'_, S, M, Compliant>,
    ) -> Result<JointSolution<S, M>, Fault> {
        let mut last = saddle.solve();
        if last.multipliers.as_slice().is_empty() {
            return Ok(last);
        }
        if self.is_exact {
            let mut before = last;
            for _ in 1..self.max_iterations {
                before = last;
                last = saddle.solve_after(&last.multipliers);
            }
            last.iterations = self.max_iterations;
            let change = Change::between(&last, &before);
            let [change, size] = [&change.accelerations, &last.accelerations]
                .map(|vector| square(vector.as_slice()).sqrt());
            self.ended(change, size)?;
            return Ok(last);
        }
        let mut missing = saddle.yielded(&last.multipliers);
        let mut direction = Change::<S, M>::nothing();
        // What the direction changes of what is missing, with the other sign: `S` times it.
        let mut answered = M::ClosingMultipliers::<S>::zeros();
        let mut length = S::zero();
        let mut size = S::zero();
        for iterations in 2..=2 * self.max_iterations {
            let mut next = saddle.solve_after(&last.multipliers);
            next.iterations = iterations;
            let change = Change::between(&next, &last);
            size = square(change.accelerations.as_slice()).sqrt();
            if !size.is_finite() {
                let origin = NotFinite::Unknown;
                return Err(Fault::RatesNotFinite { origin });
            }
            let whole = square(next.accelerations.as_slice()).sqrt();
            if size <= self.tolerance * (S::one() + whole) {
                return Ok(next);
            }
            let left = saddle.yielded(&change.multipliers);
            if iterations <= self.max_iterations {
                (last, missing) = (next, left);
                continue;
            }
            let before = length;
            length = product(missing.as_slice(), change.multipliers.as_slice());
            let conjugate = if before > S::zero() {
                length.quotient(before)
            } else {
                S::zero()
            };
            let mut answer = missing;
            add(answer.as_mut_slice(), -S::one(), left.as_slice());
            let along = &mut direction;
            combine(
                along.accelerations.as_mut_slice(),
                conjugate,
                change.accelerations.as_slice(),
            );
            combine(
                along.multipliers.as_mut_slice(),
                conjugate,
                change.multipliers.as_slice(),
            );
            combine(answered.as_mut_slice(), conjugate, answer.as_slice());
            let stiffness = product(along.multipliers.as_slice(), answered.as_slice());
            let step = length.quotient(stiffness);
            let step = if step.is_finite() { step } else { S::one() };
            add(
                last.accelerations.as_mut_slice(),
                step,
                along.accelerations.as_slice(),
            );
            add(
                last.multipliers.as_mut_slice(),
                step,
                along.multipliers.as_slice(),
            );
            add(missing.as_mut_slice(), -step, answered.as_slice());
        }
        let rows = missing.as_slice().iter().zip(M::JOINT_REPORT.closing);
        let worst = rows.fold(
            (S::zero(), None),
            |worst: (S, Option<&'static str>), (&row, &joint)| {
                if row.abs() > worst.0 {
                    (row.abs(), Some(joint))
                } else {
                    worst
                }
            },
        );
        Err(Fault::NotConverged {
            iterations: 2 * self.max_iterations,
            residual: size.to_f64(),
            joint: worst.1,
            alpha: Some(self.alpha.to_f64()),
        })
    }
}

/// `x . y`.
fn product<S: Real>(x: &[S], y: &[S]) -> S {
    let pairs = x.iter().zip(y);
    pairs.fold(S::zero(), |sum, (&x, &y)| x.fused(y, sum))
}
