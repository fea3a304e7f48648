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
//! The augmented Lagrangian starts from zero multipliers at every evaluation. All are written once,
//! over [`Coordinates`]: in relative coordinates the system is that of the equations that remain.

mod augmented_lagrangian;
mod baumgarte;
mod consistency;
mod derived;
mod penalty;
mod standard;
mod straight_on;

pub(crate) use augmented_lagrangian::add;
pub(crate) use consistency::inconsistency;
pub(crate) use straight_on::StraightOn;

pub use augmented_lagrangian::AugmentedLagrangian;
pub use baumgarte::Baumgarte;
pub use penalty::Penalty;
pub use standard::StandardLagrange;

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::error::Fault;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::{copied, opaque};
use crate::mechanism::coordinates::{Absolute, ByAllRows, Coordinates, RightSide};
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
    /// [`StartFault::Setting`](crate::error::StartFault::Setting) for a coefficient that is not
    /// finite and positive.
    fn stabilisation(&self) -> Result<Stabilisation<S>, Fault>;

    /// The rate (1/s) at which violations decay, the faster one of two: explicit steps must be
    /// shorter than about two over it. `None` for a formulation that lets them stay.
    fn decay_rate(&self) -> Option<S> {
        None
    }

    /// The formulation for a second run, by which the error of the first is estimated
    /// ([`Simulation::verified`](crate::Simulation::verified)): nearer to the constraints, for what
    /// does not go with the steps. A penalty has half its compliance there: both differ by half of
    /// what the first is off by.
    #[must_use]
    fn companion(&self) -> Self {
        *self
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
    /// [`StepFault::NotConverged`](crate::error::StepFault::NotConverged) for a formulation that
    /// iterates.
    #[inline(always)]
    fn refine<M: Mechanism, C: Coordinates<M>>(
        &self,
        _saddle: &Saddle<'_, S, M, C, Self::Terms>,
        _solution: &mut Solution<S, M, C>,
    ) -> Result<(), Fault> {
        Ok(())
    }
}

/// The saddle system at one time and state, factorised.
pub struct Saddle<'a, S: Scalar, M: Mechanism, C: Coordinates<M>, T: Terms> {
    pub(crate) constants: &'a C::Constants<S>,
    /// In absolute coordinates.
    pub(crate) absolute: &'a M::Constants<S>,
    pub(crate) coefficients: &'a C::Coefficients<S>,
    pub(crate) compliances: &'a C::Multipliers<S>,
    pub(crate) factors: &'a C::Factors<S>,
    pub(crate) right: RightSide<'a, S, M, C>,
    pub(crate) time: S,
    /// As the kernels read it.
    pub(crate) state: &'a C::State<S>,
    pub(crate) terms: PhantomData<T>,
}

opaque! {
    [S: Scalar, M: Mechanism, C: Coordinates<M>, T: Terms] Saddle<'_, S, M, C, T>, "Saddle";
    [S: Scalar, M: Mechanism, C: Coordinates<M>] Solution<S, M, C>, "Solution";
}

impl<S: Scalar, M: Mechanism, C: Coordinates<M>, T: Terms> Saddle<'_, S, M, C, T> {
    /// The solution with the multipliers of a solution before, in its place.
    // One piece of code for all solutions of a formulation that iterates, and one stack.
    #[inline(never)]
    pub fn solve_again(&self, solution: &mut Solution<S, M, C>) {
        let yielded = self.yielded(&solution.multipliers);
        (solution.accelerations, solution.multipliers) = C::solve_after::<S, T>(
            (self.constants, self.coefficients),
            self.factors,
            self.right,
            &yielded,
        );
    }

    /// `E lambda`.
    pub(crate) fn yielded(&self, multipliers: &C::Multipliers<S>) -> C::Multipliers<S> {
        let mut yielded = *multipliers;
        let rows = yielded.as_mut_slice().iter_mut();
        for (row, &compliance) in rows.zip(self.compliances.as_slice()) {
            *row = compliance * *row;
        }
        yielded
    }

    /// A solution by the rows of all joints; `None` in coordinates that do not have them.
    pub(crate) fn by_all_rows<'s>(
        &'s self,
        accelerations: &'s C::Velocities<S>,
        multipliers: &'s C::Multipliers<S>,
    ) -> Option<ByAllRows<'s, S, M>> {
        C::by_all_rows(
            self.constants,
            self.state,
            self.right,
            accelerations,
            multipliers,
        )
    }
}

/// Accelerations and multipliers of the saddle system.
#[non_exhaustive]
pub struct Solution<S: Scalar, M: Mechanism, C: Coordinates<M> = Absolute> {
    /// The rates of the velocities; in absolute coordinates `u'` (m/s^2 global; rad/s^2 principal
    /// body axes).
    pub accelerations: C::Velocities<S>,
    /// `lambda`, one per equation that is solved; in absolute coordinates the reaction on the
    /// bodies is `-D^T lambda`.
    pub multipliers: C::Multipliers<S>,
    /// How often the system was solved.
    pub iterations: usize,
    /// Whether an iteration was ended before its tolerance, because what still changed was nearly a
    /// state of self-stress.
    pub unconverged: bool,
}

copied! {
    [S: Scalar, M: Mechanism, C: Coordinates<M>, T: Terms] Saddle<'_, S, M, C, T>;
    [S: Scalar, M: Mechanism, C: Coordinates<M>] Solution<S, M, C>;
}
