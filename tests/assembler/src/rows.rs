//! Where joints write the rows of the Jacobian `D`, in place.

use nalgebra::{DMatrix, Matrix3, Vector3};

/// A matrix that holds `D`. Every block is written whole and over what was there, except by `add`;
/// what no joint writes stays as it is.
pub(crate) trait Rows {
    /// Three rows by three columns.
    fn block(&mut self, row: usize, column: usize, block: &Matrix3<f64>);
    /// The diagonal of a block of which the rest is zero.
    fn diagonal(&mut self, row: usize, column: usize, value: f64);
    /// One row by three columns.
    fn line(&mut self, row: usize, column: usize, line: &Vector3<f64>);
    /// One row by three columns, added to what a `line` wrote before.
    fn add(&mut self, row: usize, column: usize, line: &Vector3<f64>);
}

/// `D`, equations by velocities.
pub(crate) struct Jacobian<'a>(pub(crate) &'a mut DMatrix<f64>);

impl Rows for Jacobian<'_> {
    fn block(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        self.0.fixed_view_mut::<3, 3>(row, column).copy_from(block);
    }

    fn diagonal(&mut self, row: usize, column: usize, value: f64) {
        for k in 0..3 {
            self.0[(row + k, column + k)] = value;
        }
    }

    fn line(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        for k in 0..3 {
            self.0[(row, column + k)] = line[k];
        }
    }

    fn add(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        for k in 0..3 {
            self.0[(row, column + k)] += line[k];
        }
    }
}

/// `D^T`, velocities by equations: a row of `D` is contiguous.
pub(crate) struct Transposed<'a>(pub(crate) &'a mut DMatrix<f64>);

impl Rows for Transposed<'_> {
    fn block(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        self.0
            .fixed_view_mut::<3, 3>(column, row)
            .tr_copy_from(block);
    }

    fn diagonal(&mut self, row: usize, column: usize, value: f64) {
        for k in 0..3 {
            self.0[(column + k, row + k)] = value;
        }
    }

    fn line(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        self.0.fixed_view_mut::<3, 1>(column, row).copy_from(line);
    }

    fn add(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        let mut view = self.0.fixed_view_mut::<3, 1>(column, row);
        view += line;
    }
}

/// Both copies of `D` in the matrix `[M D^T; D 0]`, velocities first.
pub(crate) struct Saddle<'a> {
    /// The whole matrix.
    pub(crate) matrix: &'a mut DMatrix<f64>,
    /// Number of velocities, that is the first row of `D`.
    pub(crate) velocities: usize,
}

impl Rows for Saddle<'_> {
    fn block(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        let row = row + self.velocities;
        Jacobian(self.matrix).block(row, column, block);
        Transposed(self.matrix).block(row, column, block);
    }

    fn diagonal(&mut self, row: usize, column: usize, value: f64) {
        let row = row + self.velocities;
        Jacobian(self.matrix).diagonal(row, column, value);
        Transposed(self.matrix).diagonal(row, column, value);
    }

    fn line(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        let row = row + self.velocities;
        Jacobian(self.matrix).line(row, column, line);
        Transposed(self.matrix).line(row, column, line);
    }

    fn add(&mut self, row: usize, column: usize, line: &Vector3<f64>) {
        let row = row + self.velocities;
        Jacobian(self.matrix).add(row, column, line);
        Transposed(self.matrix).add(row, column, line);
    }
}
