//! Gaussian elimination with partial pivoting in the storage of the matrix.
//!
//! nalgebra's own `LU` takes the matrix, allocates its permutation, and does not give the storage
//! back: two allocations per evaluation. This one needs none and is faster, see [`solve_in_place`];
//! a test compares the two.

use nalgebra::DMatrix;

/// Overwrites `rhs` with the solution of `matrix x = rhs` and `matrix` with its triangular factor.
///
/// Columns are worked on whole because they are contiguous; those with a zero in the pivot row are
/// skipped, of which a matrix `[M D^T; D 0]` has many. Returns false if a pivot is zero or not a
/// number; what is left in `matrix` and `rhs` is then without meaning.
///
/// # Panics
/// If `matrix` is not square or `rhs` has another size.
#[must_use]
pub fn solve_in_place(matrix: &mut DMatrix<f64>, rhs: &mut [f64]) -> bool {
    let n = rhs.len();
    assert_eq!(matrix.shape(), (n, n));
    let entries = matrix.as_mut_slice();
    for k in 0..n {
        let (done, rest) = entries.split_at_mut((k + 1) * n);
        let factors = &mut done[k * n..];
        let row = largest(factors, k);
        let pivot = factors[row];
        if pivot == 0.0 || pivot.is_nan() {
            return false;
        }
        factors.swap(k, row);
        let reciprocal = 1.0 / pivot;
        let factors = &mut factors[k + 1..];
        factors.iter_mut().for_each(|factor| *factor *= reciprocal);
        for column in rest.chunks_exact_mut(n) {
            eliminate(column, factors, k, row);
        }
        eliminate(rhs, factors, k, row);
    }
    for k in (0..n).rev() {
        let (rest, last) = rhs.split_at_mut(k);
        last[0] /= entries[k * n + k];
        for (value, entry) in rest.iter_mut().zip(&entries[k * n..]) {
            *value -= last[0] * entry;
        }
    }
    true
}

/// The row, from `first` on, with the entry that is largest in absolute value.
fn largest(column: &[f64], first: usize) -> usize {
    let mut row = first;
    for candidate in first + 1..column.len() {
        if column[candidate].abs() > column[row].abs() {
            row = candidate;
        }
    }
    row
}

/// Brings row `row` to place `k` of a column and subtracts it from those below.
fn eliminate(column: &mut [f64], factors: &[f64], k: usize, row: usize) {
    column.swap(k, row);
    let top = column[k];
    if top != 0.0 {
        for (value, factor) in column[k + 1..].iter_mut().zip(factors) {
            *value -= top * factor;
        }
    }
}
