//! The strongest baseline with run-time matrices: multipliers from
//! `(D M^-1 D^T) lambda = D M^-1 g - gamma*`.
//!
//! `M` is diagonal, so the matrix is a sum over the columns of `D` and factorised by Cholesky in
//! its storage; then `u' = M^-1 (g - D^T lambda)` (Flores 2015, chapter 11; the rows of `D` must be
//! independent).

use nalgebra::linalg::Cholesky;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::assembler::Assembler;
use crate::formulation::{SolveError, write_target};
use crate::kinematics::Kinematics;
use crate::rows::Jacobian;
use crate::symmetric::{add_outer_product, factor_in_place};

/// An [`Assembler`] with the work space for Lagrange multipliers or Baumgarte by the Schur
/// complement.
///
/// Allocates nothing per evaluation.
#[derive(Clone, Debug)]
pub struct SchurEvaluator {
    assembler: Assembler,
    /// `(a, b)`.
    stabilisation: (f64, f64),
    at: Kinematics,
    /// The diagonal of `M^-1`.
    mobility: DVector<f64>,
    /// `D`, equations by velocities.
    jacobian: DMatrix<f64>,
    matrix: DMatrix<f64>,
    forces: DVector<f64>,
    accelerations: DVector<f64>,
    /// `gamma*`.
    target: DVector<f64>,
    scratch: DVector<f64>,
    multipliers: DVector<f64>,
}

impl SchurEvaluator {
    /// Allocates the work space. `a` and `b` (1/s) are Baumgarte's, both zero for plain Lagrange
    /// multipliers.
    #[must_use]
    pub fn new(assembler: Assembler, a: f64, b: f64) -> Self {
        let (velocities, equations) = (assembler.velocities(), assembler.equations());
        Self {
            at: assembler.workspace(),
            mobility: assembler.mass().map(f64::recip),
            jacobian: DMatrix::zeros(equations, velocities),
            matrix: DMatrix::zeros(equations, equations),
            forces: DVector::zeros(velocities),
            accelerations: DVector::zeros(velocities),
            target: DVector::zeros(equations),
            scratch: DVector::zeros(equations),
            multipliers: DVector::zeros(equations),
            assembler,
            stabilisation: (a, b),
        }
    }

    /// `lambda` of the last evaluation, with `M u' + D^T lambda = g`.
    #[must_use]
    pub fn multipliers(&self) -> &DVector<f64> {
        &self.multipliers
    }

    /// The right-hand side `x' = (q', u')` of `x = (q, u)`, all coordinates first, then all
    /// velocities.
    ///
    /// # Errors
    /// [`SolveError::Singular`] if the rows of `D` are not independent.
    ///
    /// # Panics
    /// If `x` or `out` has another size.
    pub fn rates(&mut self, time: f64, x: &[f64], out: &mut [f64]) -> Result<(), SolveError> {
        assert_eq!(x.len(), out.len());
        assert_eq!(
            x.len(),
            self.assembler.coordinates() + self.assembler.velocities()
        );
        let (assembler, at) = (&self.assembler, &mut self.at);
        assembler.update(time, x, at);
        write_target(
            assembler,
            at,
            self.stabilisation,
            &mut self.scratch,
            &mut self.target,
        );
        assembler.write_jacobian(at, &mut Jacobian(&mut self.jacobian));

        // forces = g, accelerations = M^-1 g, multipliers = D M^-1 g - gamma*
        assembler.write_forces(at, self.forces.as_mut_slice());
        self.accelerations.copy_from(&self.forces);
        self.accelerations.component_mul_assign(&self.mobility);
        self.multipliers.copy_from(&self.target);
        self.multipliers
            .gemv(1.0, &self.jacobian, &self.accelerations, -1.0);
        let factors = self.factor()?;
        factors.solve_mut(&mut self.multipliers);
        self.matrix = factors.unpack_dirty();
        // accelerations = M^-1 (g - D^T lambda)
        self.accelerations.copy_from(&self.forces);
        self.accelerations
            .gemv_tr(-1.0, &self.jacobian, &self.multipliers, 1.0);
        self.accelerations.component_mul_assign(&self.mobility);

        let (positions, velocities) = out.split_at_mut(self.assembler.coordinates());
        self.assembler
            .write_coordinate_rates(&self.at, x, positions);
        velocities.copy_from_slice(self.accelerations.as_slice());
        Ok(())
    }

    /// Cholesky factors of `D M^-1 D^T` in the storage of `matrix`.
    fn factor(&mut self) -> Result<Cholesky<f64, Dyn>, SolveError> {
        self.matrix.as_mut_slice().fill(0.0);
        // Without joints there is nothing to cut, but the size of a piece must not be zero.
        let size = self.target.len().max(1);
        let columns = self.jacobian.as_slice().chunks_exact(size);
        for (column, mobility) in columns.zip(self.mobility.iter()) {
            add_outer_product(&mut self.matrix, *mobility, column);
        }
        factor_in_place(&mut self.matrix)
    }
}
