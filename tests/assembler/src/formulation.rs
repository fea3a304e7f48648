//! The four formulations in their textbook forms, as right-hand sides that allocate nothing.
//!
//! Sources: Flores (2015), chapters 11 to 14; Baumgarte (1972); Bayo, Garcia de Jalon, Serna (1988)
//! for penalty and augmented Lagrangian.

use core::fmt;

use nalgebra::linalg::Cholesky;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::assembler::Assembler;
use crate::bodies::Kind;
use crate::kinematics::Kinematics;
use crate::lu::solve_in_place;
use crate::rows::{Saddle, Transposed};
use crate::symmetric::{add_outer_product, factor_in_place};

/// How the constraints enter the equations of motion. `gamma* = gamma - 2 a Phi' - b^2 Phi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Formulation {
    /// Lagrange multipliers: `[M D^T; D 0] (u', lambda) = (g, gamma)`.
    Standard,
    /// The same matrix with `gamma*` for `gamma`, `a = alpha`, `b = beta` (both 1/s).
    Baumgarte {
        /// `alpha` (1/s).
        alpha: f64,
        /// `beta` (1/s).
        beta: f64,
    },
    /// `(M + alpha D^T D) u' = g + alpha D^T gamma*`, `lambda = alpha (D u' - gamma*)`,
    /// `a = mu omega`, `b = omega`. Rows in metres or radians: others are brought to these units
    /// first.
    Penalty {
        /// `alpha` (kg).
        alpha: f64,
        /// `omega` (1/s).
        omega: f64,
        /// `mu`, a damping ratio.
        mu: f64,
    },
    /// `(M + alpha D^T D) u'_(k+1) = M u'_k + alpha D^T gamma*` from `M u'_0 = g` until
    /// `|u'_(k+1) - u'_k| <= tolerance (1 + |u'_(k+1)|)`; `lambda` is the sum of
    /// `alpha (D u'_k - gamma*)`, `k >= 1`.
    AugmentedLagrangian {
        /// `alpha` (kg).
        alpha: f64,
        /// `omega` (1/s).
        omega: f64,
        /// `mu`, a damping ratio.
        mu: f64,
        /// Change of the accelerations at which the iteration stops.
        tolerance: f64,
        /// Largest number of iterations.
        max_iterations: usize,
    },
}

impl Formulation {
    /// `(a, b)` of `gamma* = gamma - 2 a Phi' - b^2 Phi`.
    #[must_use]
    pub fn stabilisation(&self) -> (f64, f64) {
        match *self {
            Self::Standard => (0.0, 0.0),
            Self::Baumgarte { alpha, beta } => (alpha, beta),
            Self::Penalty { omega, mu, .. } | Self::AugmentedLagrangian { omega, mu, .. } => {
                (mu * omega, omega)
            }
        }
    }
}

/// Why there are no accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolveError {
    /// The matrix has a zero pivot, is not positive definite, or holds something that is not a
    /// number.
    Singular,
    /// The iteration of the augmented Lagrangian did not come to rest. The rates of the last
    /// iterate were written.
    NotConverged,
}

impl fmt::Display for SolveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Singular => "the matrix of the equations of motion is singular",
            Self::NotConverged => "the augmented Lagrangian iteration did not converge",
        })
    }
}

impl core::error::Error for SolveError {}

/// An [`Assembler`] with a formulation and the work space for its right-hand side.
///
/// Everything is allocated once. The matrix has the size `U + M` for multipliers (Gaussian
/// elimination in place) and `U` for penalty and augmented Lagrangian (nalgebra's Cholesky, which
/// gives its storage back).
#[derive(Clone, Debug)]
pub struct Evaluator {
    assembler: Assembler,
    formulation: Formulation,
    at: Kinematics,
    mass: DVector<f64>,
    /// `D^T`, velocities by equations, where the matrix does not hold it.
    transposed: DMatrix<f64>,
    matrix: DMatrix<f64>,
    /// Right-hand side, then solution: `(u', lambda)` or `u'`.
    solution: DVector<f64>,
    /// The accelerations of the iteration before.
    previous: DVector<f64>,
    /// `gamma*`.
    target: DVector<f64>,
    /// `alpha D^T gamma*`.
    pull: DVector<f64>,
    /// `Phi` or `Phi'`, or `alpha (D u' - gamma*)`.
    scratch: DVector<f64>,
    multipliers: DVector<f64>,
    /// What the rows are multiplied by, so that `alpha` acts in metres, or in radians.
    units: DVector<f64>,
    iterations: usize,
}

/// One over the largest gradient of each row in the reference configuration: with respect to the
/// position of a body, or to the rotation of one where it does not depend on positions.
fn units(assembler: &Assembler) -> DVector<f64> {
    let jacobian = assembler.jacobian(assembler.initial_state().as_slice());
    let gradient = |row: usize, first: usize| jacobian.fixed_view::<1, 3>(row, first).norm();
    DVector::from_fn(assembler.equations(), |row, _| {
        let (mut translation, mut rotation) = (0.0_f64, 0.0_f64);
        for (body, _, velocity) in assembler.bodies() {
            translation = translation.max(gradient(row, velocity));
            if body.kind == Kind::Rigid {
                rotation = rotation.max(gradient(row, velocity + 3));
            }
        }
        1.0 / if translation > 1e-9 {
            translation
        } else {
            rotation
        }
    })
}

impl Evaluator {
    /// Allocates the work space.
    #[must_use]
    pub fn new(assembler: Assembler, formulation: Formulation) -> Self {
        let (velocities, equations) = (assembler.velocities(), assembler.equations());
        let (size, rows) = match formulation {
            Formulation::Standard | Formulation::Baumgarte { .. } => (velocities + equations, 0),
            Formulation::Penalty { .. } | Formulation::AugmentedLagrangian { .. } => {
                (velocities, equations)
            }
        };
        Self {
            at: assembler.workspace(),
            mass: assembler.mass(),
            transposed: DMatrix::zeros(velocities, rows),
            matrix: DMatrix::zeros(size, size),
            solution: DVector::zeros(size),
            previous: DVector::zeros(velocities),
            target: DVector::zeros(equations),
            pull: DVector::zeros(velocities),
            scratch: DVector::zeros(equations),
            multipliers: DVector::zeros(equations),
            units: if rows > 0 {
                units(&assembler)
            } else {
                DVector::zeros(0)
            },
            iterations: 0,
            assembler,
            formulation,
        }
    }

    /// The mechanism.
    #[must_use]
    pub fn assembler(&self) -> &Assembler {
        &self.assembler
    }

    /// `lambda` of the last evaluation, with `M u' + D^T lambda = g`.
    #[must_use]
    pub fn multipliers(&self) -> &DVector<f64> {
        &self.multipliers
    }

    /// Solutions with the matrix of the last evaluation: 1, or the iterations of the augmented
    /// Lagrangian.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// The right-hand side `x' = (q', u')` of `x = (q, u)`, all coordinates first, then all
    /// velocities.
    ///
    /// # Errors
    /// See [`SolveError`].
    ///
    /// # Panics
    /// If `x` or `out` has another size.
    pub fn rates(&mut self, time: f64, x: &[f64], out: &mut [f64]) -> Result<(), SolveError> {
        assert_eq!(x.len(), out.len());
        assert_eq!(
            x.len(),
            self.assembler.coordinates() + self.assembler.velocities()
        );
        self.assembler.update(time, x, &mut self.at);
        write_target(
            &self.assembler,
            &self.at,
            self.formulation.stabilisation(),
            &mut self.scratch,
            &mut self.target,
        );
        let result = match self.formulation {
            Formulation::Standard | Formulation::Baumgarte { .. } => self.eliminate(),
            Formulation::Penalty { alpha, .. } => self.penalise(alpha, 0.0, 1),
            Formulation::AugmentedLagrangian {
                alpha,
                tolerance,
                max_iterations,
                ..
            } => self.penalise(alpha, tolerance, max_iterations),
        };
        let (positions, velocities) = out.split_at_mut(self.assembler.coordinates());
        self.assembler
            .write_coordinate_rates(&self.at, x, positions);
        velocities.copy_from_slice(&self.solution.as_slice()[..velocities.len()]);
        result
    }

    /// `[M D^T; D 0] (u', lambda) = (g, gamma*)`.
    fn eliminate(&mut self) -> Result<(), SolveError> {
        let velocities = self.mass.len();
        self.matrix.as_mut_slice().fill(0.0);
        for (k, mass) in self.mass.iter().enumerate() {
            self.matrix[(k, k)] = *mass;
        }
        let mut saddle = Saddle {
            matrix: &mut self.matrix,
            velocities,
        };
        self.assembler.write_jacobian(&self.at, &mut saddle);

        let rhs = self.solution.as_mut_slice();
        self.assembler
            .write_forces(&self.at, &mut rhs[..velocities]);
        rhs[velocities..].copy_from_slice(self.target.as_slice());
        if !solve_in_place(&mut self.matrix, rhs) {
            return Err(SolveError::Singular);
        }
        self.multipliers
            .as_mut_slice()
            .copy_from_slice(&rhs[velocities..]);
        self.iterations = 1;
        Ok(())
    }

    /// `(M + alpha D^T D) u' = M u'_previous + alpha D^T gamma*`, `max_iterations` times or until
    /// the accelerations come to rest; penalty is one iteration without a test.
    fn penalise(
        &mut self,
        alpha: f64,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<(), SolveError> {
        self.assembler
            .write_jacobian(&self.at, &mut Transposed(&mut self.transposed));
        for (mut column, unit) in self.transposed.column_iter_mut().zip(self.units.iter()) {
            column *= *unit;
        }
        self.target.component_mul_assign(&self.units);
        let factors = self.factor_penalty(alpha)?;
        self.pull.gemv(alpha, &self.transposed, &self.target, 0.0);
        // M u'_0 = g: the first right-hand side is g + alpha D^T gamma*.
        self.assembler
            .write_forces(&self.at, self.solution.as_mut_slice());
        self.previous.copy_from(&self.solution);
        self.previous.component_div_assign(&self.mass);
        self.multipliers.fill(0.0);

        let single = matches!(self.formulation, Formulation::Penalty { .. });
        let mut converged = single;
        for iteration in 1..=max_iterations {
            self.solution += &self.pull;
            factors.solve_mut(&mut self.solution);
            // lambda += alpha (D u' - gamma*)
            self.scratch.copy_from(&self.target);
            self.scratch
                .gemv_tr(alpha, &self.transposed, &self.solution, -alpha);
            self.multipliers += &self.scratch;
            self.iterations = iteration;
            if single {
                break;
            }
            self.previous -= &self.solution;
            if self.previous.norm() <= tolerance * (1.0 + self.solution.norm()) {
                converged = true;
                break;
            }
            self.previous.copy_from(&self.solution);
            if iteration < max_iterations {
                self.solution.component_mul_assign(&self.mass);
            }
        }
        self.multipliers.component_mul_assign(&self.units);
        self.matrix = factors.unpack_dirty();
        if converged {
            Ok(())
        } else {
            Err(SolveError::NotConverged)
        }
    }

    /// Cholesky factors of `M + alpha D^T D` in the storage of `matrix`.
    fn factor_penalty(&mut self, alpha: f64) -> Result<Cholesky<f64, Dyn>, SolveError> {
        self.matrix.as_mut_slice().fill(0.0);
        self.matrix.set_diagonal(&self.mass);
        for row in self
            .transposed
            .as_slice()
            .chunks_exact(self.mass.len().max(1))
        {
            add_outer_product(&mut self.matrix, alpha, row);
        }
        factor_in_place(&mut self.matrix)
    }
}

/// Writes `gamma* = gamma - 2 a Phi' - b^2 Phi`; a term with the coefficient zero is not computed.
pub(crate) fn write_target(
    assembler: &Assembler,
    at: &Kinematics,
    (a, b): (f64, f64),
    scratch: &mut DVector<f64>,
    target: &mut DVector<f64>,
) {
    assembler.write_gamma(at, target.as_mut_slice());
    if a != 0.0 {
        assembler.write_constraint_rates(at, scratch.as_mut_slice());
        target.axpy(-2.0 * a, scratch, 1.0);
    }
    if b != 0.0 {
        assembler.write_constraints(at, scratch.as_mut_slice());
        target.axpy(-b * b, scratch, 1.0);
    }
}
