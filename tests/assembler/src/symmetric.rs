//! Symmetric matrices `sum of w d d^T`, formed and factorised in their storage. Only the lower
//! triangle is used.

use core::mem;

use nalgebra::linalg::Cholesky;
use nalgebra::{DMatrix, Dyn};

use crate::formulation::SolveError;

/// Adds `weight d d^T` to the lower triangle. Zeros of `d` cost nothing but a comparison: a row of
/// a Jacobian has a dozen entries however many bodies there are.
pub(crate) fn add_outer_product(matrix: &mut DMatrix<f64>, weight: f64, d: &[f64]) {
    let n = d.len();
    for (j, column) in matrix.as_mut_slice().chunks_exact_mut(n).enumerate() {
        let factor = weight * d[j];
        if factor != 0.0 {
            for (entry, d) in column[j..].iter_mut().zip(&d[j..]) {
                *entry += factor * d;
            }
        }
    }
}

/// Cholesky factors in the storage of `matrix`, which is left empty; `unpack_dirty` gives the
/// storage back.
///
/// If the matrix is not positive definite, its storage is allocated anew.
pub(crate) fn factor_in_place(matrix: &mut DMatrix<f64>) -> Result<Cholesky<f64, Dyn>, SolveError> {
    let size = matrix.nrows();
    Cholesky::new(mem::replace(matrix, DMatrix::zeros(0, 0))).ok_or_else(|| {
        *matrix = DMatrix::zeros(size, size);
        SolveError::Singular
    })
}
