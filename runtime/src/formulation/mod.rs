//! The four formulations, as small policies over one saddle system.
//!
//! With `gamma* = gamma - 2 a Phi' - b^2 Phi` and a compliance `e`,
//!
//! ```text
//! [ M   D^T ] [ u'     ]   [ g                           ]
//! [ D  -e I ] [ lambda ] = [ gamma* - e lambda_previous  ]
//! ```
//!
//! | formulation | a, b | e | lambda_previous |
//! |---|---|---|---|
//! | [`StandardLagrange`] | 0, 0 | 0 | 0 |
//! | [`Baumgarte`] | alpha, beta | 0 | 0 |
//! | [`Penalty`] | omega mu, omega | 1 / alpha | 0 |
//! | [`AugmentedLagrangian`] | omega mu, omega | 1 / alpha | 0 first, then the last iterate |
//!
//! Flores, *Concepts and Formulations for Spatial Multibody Dynamics* (2015), chapters 11 to 14, in the form of a saddle
//! system: eliminating `lambda` gives the textbook's `(M + alpha D^T D) u' = g + alpha D^T gamma*`, which loses digits as
//! `alpha` grows; this form does not.

mod augmented_lagrangian;
mod baumgarte;
mod penalty;
mod standard;

pub use augmented_lagrangian::AugmentedLagrangian;
pub use baumgarte::Baumgarte;
pub use penalty::Penalty;
pub use standard::StandardLagrange;

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::array::Array;
use crate::error::Fault;
use crate::mechanism::{Mechanism, Stabilisation, Terms};
use crate::project::row_of_largest;
use crate::scalar::{Real, Scalar};
use crate::self_stress::self_stressed;

/// The faster rate of decay of `x'' + 2 a x' + b^2 x = 0`, or the size of both where it oscillates.
fn faster_decay<S: Real>(a: S, b: S) -> S {
    if a > b { a + (a * a - b * b).sqrt() } else { b }
}

/// How constraints enter the equations of motion.
pub trait Formulation<S: Real>: Copy + Debug {
    /// The terms of the saddle system that this formulation has.
    type Terms: Terms;

    /// Whether one evaluation solves the system more than once, see [`Formulation::solve`].
    const ITERATED: bool = false;

    /// The coefficients of the saddle system.
    ///
    /// # Errors
    /// [`Fault::Setting`] for a coefficient that is not finite and positive.
    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault>;

    /// The rate (1/s) at which violations decay, the faster one of two: explicit steps must be shorter than about two over it. `None` for a formulation
    /// that lets them stay.
    fn decay_rate(&self) -> Option<S> {
        None
    }

    /// Accelerations and multipliers from the factorised system: solves it once, with `lambda_previous = 0`.
    ///
    /// # Errors
    /// [`Fault::NotConverged`] for a formulation that iterates.
    fn solve<M: Mechanism>(
        &self,
        saddle: &Saddle<'_, S, M, Self::Terms>,
    ) -> Result<Solution<S, M>, Fault> {
        Ok(saddle.solve())
    }
}

/// The saddle system at one time and state, factorised.
pub struct Saddle<'a, S: Scalar, M: Mechanism, T: Terms> {
    pub(crate) constants: &'a M::Constants<S>,
    pub(crate) coefficients: &'a M::Coefficients<S>,
    pub(crate) factors: &'a M::Factors<S>,
    pub(crate) compliance: S,
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
        self.solve_for(self.lower)
    }

    /// The solution with the multipliers of a solution before.
    #[must_use]
    pub fn solve_after(&self, previous: &M::Multipliers<S>) -> Solution<S, M> {
        let mut lower = *self.lower;
        for (element, lambda) in lower.as_mut_slice().iter_mut().zip(previous.as_slice()) {
            *element = *element - self.compliance * *lambda;
        }
        self.solve_for(&lower)
    }

    /// Whether the multipliers of two solutions differ by what is nearly a state of self-stress.
    pub(crate) fn self_stressed(&self, next: &Solution<S, M>, last: &Solution<S, M>) -> bool
    where
        S: Real,
    {
        let difference = difference::<S, M>(next, last);
        self_stressed::<S, M>(self.constants, self.time, self.state, &difference)
    }

    /// The row that the accelerations of `next`, the solution after `last`, violate most: `D u' - gamma* = e (lambda - lambda_last)`.
    #[cold]
    pub(crate) fn least_satisfied(&self, next: &Solution<S, M>, last: &Solution<S, M>) -> usize
    where
        S: Real,
    {
        row_of_largest(difference::<S, M>(next, last).as_slice())
    }

    fn solve_for(&self, lower: &M::Multipliers<S>) -> Solution<S, M> {
        let (accelerations, multipliers) = M::solve::<S, T>(
            self.constants,
            self.coefficients,
            self.factors,
            self.upper,
            lower,
        );
        Solution {
            accelerations,
            multipliers,
            iterations: 1,
        }
    }
}

/// The difference of the multipliers of two solutions.
fn difference<S: Scalar, M: Mechanism>(
    next: &Solution<S, M>,
    last: &Solution<S, M>,
) -> M::Multipliers<S> {
    let mut difference = next.multipliers;
    let pairs = difference.as_mut_slice().iter_mut();
    for (new, &old) in pairs.zip(last.multipliers.as_slice()) {
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
}
