//! The four formulations, as small policies over one saddle system.
//!
//! With `gamma* = gamma - 2 a Phi' - b^2 Phi` and a diagonal matrix `E` of compliances,
//!
//! ```text
//! [ M   D^T ] [ u'     ]   [ g                           ]
//! [ D   -E  ] [ lambda ] = [ gamma* - E lambda_previous  ]
//! ```
//!
//! A row in metres, or in radians, has the compliance `e`. A row in another unit has `e` times the
//! square of what a metre is in it at the reference configuration, so that `e` means the same for
//! all: `(2 l)^2 e` for a [`Distance`](crate::joints::Distance) of the length `l`, which is the
//! difference of squares. Where a radian counts as another length `L` than a metre
//! ([`Formulation::radian`]), a row in radians has `e / L^2`.
//!
//! | formulation | a, b | e | lambda_previous |
//! |---|---|---|---|
//! | [`StandardLagrange`] | 0, 0 | 0 | 0 |
//! | [`Baumgarte`] | alpha, beta | 0 | 0 |
//! | [`Penalty`] | omega mu, omega | 1 / alpha | 0 |
//! | [`AugmentedLagrangian`] | omega mu, omega | 1 / alpha | 0 first, then the last iterate |
//!
//! Flores, *Concepts and Formulations for Spatial Multibody Dynamics* (2015), chapters 11 to 14, in
//! the form of a saddle system: eliminating `lambda` gives the textbook's
//! `(M + alpha D^T D) u' = g + alpha D^T gamma*`, which loses digits as `alpha` grows; this form
//! does not.
//!
//! The augmented Lagrangian starts from zero multipliers at every evaluation. In joint coordinates
//! it needs `S z` with `S = D M^-1 D^T`, which follows from two solutions (`joints.rs`), so
//! neither `M` nor `D` leaves the kernels.

mod augmented_lagrangian;
mod baumgarte;
mod consistency;
mod derived;
mod joints;
mod penalty;
mod standard;

pub(crate) use augmented_lagrangian::{add, combine};
pub(crate) use consistency::inconsistency;

pub use augmented_lagrangian::AugmentedLagrangian;
pub use baumgarte::Baumgarte;
pub use joints::{JointSaddle, JointSolution};
pub use penalty::Penalty;
pub use standard::StandardLagrange;

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::constraints::self_stress::{passing, self_stressed};
use crate::error::Fault;
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::{Mechanism, Stabilisation, Terms};
use crate::state::vector::Array;

/// The faster rate of decay of `x'' + 2 a x' + b^2 x = 0`, or the size of both where it oscillates.
fn faster_decay<S: Real>(a: S, b: S) -> S {
    if a > b { a + (a * a - b * b).sqrt() } else { b }
}

/// How constraints enter the equations of motion.
pub trait Formulation<S: Real>: Copy + Debug {
    /// The terms of the saddle system that this formulation has.
    type Terms: Terms;

    /// Whether one evaluation solves the system more than once, see [`Formulation::refine`].
    const ITERATED: bool = false;

    /// The coefficients of the saddle system.
    ///
    /// # Errors
    /// [`Fault::Setting`] for a coefficient that is not finite and positive.
    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault>;

    /// The rate (1/s) at which violations decay, the faster one of two: explicit steps must be
    /// shorter than about two over it. `None` for a formulation that lets them stay.
    fn decay_rate(&self) -> Option<S> {
        None
    }

    /// How many metres a radian counts as where a compliance is given in metres: a row in radians
    /// has it over the square of that.
    fn radian(&self) -> S {
        S::one()
    }

    /// Goes on from a solution of the factorised system, that with `lambda_previous = 0`: leaves it
    /// as it is.
    ///
    /// # Errors
    /// [`Fault::NotConverged`] for a formulation that iterates.
    fn refine<M: Mechanism>(
        &self,
        _saddle: &Saddle<'_, S, M, Self::Terms>,
        _solution: &mut Solution<S, M>,
    ) -> Result<(), Fault> {
        Ok(())
    }

    /// The same in joint coordinates, where the system has been solved once, with
    /// `lambda_previous = 0`: takes that solution.
    ///
    /// # Errors
    /// [`Fault::NotConverged`] for a formulation that iterates.
    fn solve_joints<M: JointCoordinates>(
        &self,
        saddle: &JointSaddle<'_, S, M, Self::Terms>,
    ) -> Result<JointSolution<S, M>, Fault> {
        Ok(saddle.solve())
    }
}

/// The saddle system at one time and state, factorised.
pub struct Saddle<'a, S: Scalar, M: Mechanism, T: Terms> {
    pub(crate) constants: &'a M::Constants<S>,
    pub(crate) coefficients: &'a M::Coefficients<S>,
    pub(crate) factors: &'a M::Factors<S>,
    pub(crate) compliances: &'a M::Multipliers<S>,
    pub(crate) time: S,
    pub(crate) state: &'a M::State<S>,
    pub(crate) upper: &'a M::Velocities<S>,
    pub(crate) lower: &'a M::Multipliers<S>,
    pub(crate) terms: PhantomData<T>,
}

impl<S: Scalar, M: Mechanism, T: Terms> Saddle<'_, S, M, T> {
    /// The solution with `lambda_previous = 0`.
    #[must_use]
    pub fn solve(&self) -> Solution<S, M> {
        let mut solution = Solution {
            accelerations: M::Velocities::zeros(),
            multipliers: M::Multipliers::zeros(),
            iterations: 1,
            excused: false,
        };
        self.solve_for(self.lower, &mut solution);
        solution
    }

    /// The solution with the multipliers of a solution before, in its place.
    #[inline]
    pub fn solve_again(&self, solution: &mut Solution<S, M>) {
        let mut lower = *self.lower;
        let previous = solution.multipliers.as_slice();
        let rows = lower.as_mut_slice().iter_mut().zip(previous);
        for ((element, &lambda), &compliance) in rows.zip(self.compliances.as_slice()) {
            *element = *element - compliance * lambda;
        }
        self.solve_for(&lower, solution);
    }

    /// The row whose accelerations are farthest from `D u' = gamma*`, and how far, relative to its
    /// terms: what a compliance does to the motion, from 0 to about 1.
    #[must_use]
    pub fn inconsistency(&self, solution: &Solution<S, M>) -> (usize, S)
    where
        S: Real,
    {
        let at = (self.time, self.state);
        let accelerations = &solution.accelerations;
        inconsistency::<S, M>(self.constants, at, accelerations, self.upper, self.lower)
    }

    /// Whether the state is on its way through a singular configuration, in which the multipliers
    /// of two solutions differ.
    pub(crate) fn passing(&self, next: &Solution<S, M>, last: &M::Multipliers<S>) -> bool
    where
        S: Real,
    {
        let difference = difference::<S, M>(&next.multipliers, last);
        passing::<S, M>(self.constants, self.time, self.state, &difference)
    }

    /// Whether the multipliers of two solutions differ by what is nearly a state of self-stress.
    pub(crate) fn self_stressed(&self, next: &Solution<S, M>, last: &M::Multipliers<S>) -> bool
    where
        S: Real,
    {
        let difference = difference::<S, M>(&next.multipliers, last);
        self_stressed::<S, M>(self.constants, self.time, self.state, &difference)
    }

    // One piece of code for all solutions of a formulation that iterates, and one stack.
    #[inline(never)]
    fn solve_for(&self, lower: &M::Multipliers<S>, solution: &mut Solution<S, M>) {
        (solution.accelerations, solution.multipliers) = M::solve::<S, T>(
            self.constants,
            self.coefficients,
            self.factors,
            self.upper,
            lower,
        );
    }
}

/// The difference of two sets of multipliers.
fn difference<S: Scalar, M: Mechanism>(
    next: &M::Multipliers<S>,
    last: &M::Multipliers<S>,
) -> M::Multipliers<S> {
    let mut difference = *next;
    let pairs = difference.as_mut_slice().iter_mut();
    for (new, &old) in pairs.zip(last.as_slice()) {
        *new = *new - old;
    }
    difference
}

/// Accelerations and multipliers of the saddle system.
pub struct Solution<S: Scalar, M: Mechanism> {
    /// `u'` (m/s^2 global; rad/s^2 principal body axes).
    pub accelerations: M::Velocities<S>,
    /// `lambda`, one per equation; the reaction on the bodies is `-D^T lambda`.
    pub multipliers: M::Multipliers<S>,
    /// How often the system was solved.
    pub iterations: usize,
    /// Whether an iteration was ended before its tolerance, because what still changed was nearly a
    /// state of self-stress.
    pub excused: bool,
}

impl<S: Scalar, M: Mechanism> Clone for Solution<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Scalar, M: Mechanism> Copy for Solution<S, M> {}
