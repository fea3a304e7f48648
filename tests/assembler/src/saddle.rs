//! The saddle system that serves all four formulations, assembled and solved at once: for tests,
//! not for speed.
//!
//! ```text
//! [ M   D^T    ] [ u'     ]   [ g                        ]
//! [ D  -eps I  ] [ lambda ] = [ gamma* - eps lambda_prev ]
//! gamma* = gamma - 2 a Phi' - b^2 Phi
//! ```

use nalgebra::{DMatrix, DVector};

use crate::assembler::Assembler;
use crate::formulation::SolveError;
use crate::jacobi::SingularValues;
use crate::rows::Saddle;

/// Coefficients of the saddle system.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coefficients {
    /// `a` (1/s).
    pub a: f64,
    /// `b` (1/s).
    pub b: f64,
    /// `eps`, the compliance (1/kg).
    pub eps: f64,
}

/// The matrix and the solution of the saddle system.
#[derive(Clone, Debug)]
pub struct Solution {
    /// `u'` (m/s^2 in global axes, rad/s^2 in body axes).
    pub accelerations: DVector<f64>,
    /// `lambda`, one per equation.
    pub multipliers: DVector<f64>,
    /// The matrix, velocities first; of size `U + M`.
    pub matrix: DMatrix<f64>,
}

impl Solution {
    /// Largest over smallest singular value of the matrix.
    #[must_use]
    pub fn condition(&self) -> f64 {
        SingularValues::new(&self.matrix).condition()
    }
}

impl Assembler {
    /// The matrix `[M D^T; D -eps I]` at the state `x = (q, u)`.
    #[must_use]
    pub fn saddle_matrix(&self, x: &[f64], eps: f64) -> DMatrix<f64> {
        let (velocities, equations) = (self.velocities(), self.equations());
        let mass = self.mass();
        let diagonal = mass
            .iter()
            .copied()
            .chain(core::iter::repeat_n(-eps, equations));
        let mut matrix =
            DMatrix::from_diagonal(&DVector::from_iterator(velocities + equations, diagonal));
        self.write_jacobian(
            &self.kinematics(x),
            &mut Saddle {
                matrix: &mut matrix,
                velocities,
            },
        );
        matrix
    }

    /// `gamma* = gamma - 2 a Phi' - b^2 Phi` at the state `x = (q, u)` and the time zero.
    #[must_use]
    pub fn stabilised_gamma(&self, x: &[f64], a: f64, b: f64) -> DVector<f64> {
        self.stabilised_gamma_at(0.0, x, a, b)
    }

    /// The same at a time (s).
    #[must_use]
    pub fn stabilised_gamma_at(&self, time: f64, x: &[f64], a: f64, b: f64) -> DVector<f64> {
        self.gamma_at(time, x)
            - 2.0 * a * self.constraint_rates_at(time, x)
            - b * b * self.constraints_at(time, x)
    }

    /// Solves the saddle system at the time zero: see [`Assembler::solve_saddle_at`].
    ///
    /// # Errors
    /// See [`Assembler::solve_saddle_at`].
    pub fn solve_saddle(
        &self,
        x: &[f64],
        coefficients: Coefficients,
        previous: Option<&DVector<f64>>,
    ) -> Result<Solution, SolveError> {
        self.solve_saddle_at(0.0, x, coefficients, previous)
    }

    /// Solves the saddle system at a time (s) by nalgebra's LU with partial pivoting; `previous` is
    /// `lambda_prev`, zero if `None`.
    ///
    /// # Errors
    /// [`SolveError::Singular`] if a pivot is exactly zero. Where rows are redundant and `eps = 0`,
    /// rounding usually leaves a pivot that is only small: look at [`Solution::condition`].
    pub fn solve_saddle_at(
        &self,
        time: f64,
        x: &[f64],
        coefficients: Coefficients,
        previous: Option<&DVector<f64>>,
    ) -> Result<Solution, SolveError> {
        let Coefficients { a, b, eps } = coefficients;
        let velocities = self.velocities();
        let matrix = self.saddle_matrix(x, eps);
        let mut rhs = DVector::zeros(matrix.nrows());
        rhs.rows_mut(0, velocities)
            .copy_from(&self.forces_at(time, x));
        let mut lower = rhs.rows_mut(velocities, self.equations());
        lower.copy_from(&self.stabilised_gamma_at(time, x, a, b));
        if let Some(previous) = previous {
            lower.axpy(-eps, previous, 1.0);
        }
        let solution = matrix
            .clone()
            .lu()
            .solve(&rhs)
            .ok_or(SolveError::Singular)?;
        Ok(Solution {
            accelerations: solution.rows(0, velocities).into_owned(),
            multipliers: solution.rows(velocities, self.equations()).into_owned(),
            matrix,
        })
    }
}
