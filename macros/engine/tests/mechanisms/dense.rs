//! Dense systems of equations.

/// A square matrix, row by row.
pub(crate) type Matrix = Vec<Vec<f64>>;

/// A matrix taken apart by Gaussian elimination with complete pivoting.
pub(crate) struct Factors {
    matrix: Matrix,
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Factors {
    /// `None` for a matrix that is singular or not finite.
    pub(crate) fn new(mut matrix: Matrix) -> Option<Self> {
        let size = matrix.len();
        let (mut rows, mut columns): (Vec<usize>, Vec<usize>) =
            ((0..size).collect(), (0..size).collect());
        for k in 0..size {
            let (mut row, mut column) = (k, k);
            for i in k..size {
                for j in k..size {
                    if matrix[i][j].abs() > matrix[row][column].abs() {
                        (row, column) = (i, j);
                    }
                }
            }
            let pivot = matrix[row][column];
            if pivot == 0.0 || !pivot.is_finite() {
                return None;
            }
            matrix.swap(k, row);
            rows.swap(k, row);
            columns.swap(k, column);
            matrix.iter_mut().for_each(|line| line.swap(k, column));
            let (done, rest) = matrix.split_at_mut(k + 1);
            let upper = &done[k];
            for line in rest {
                let factor = line[k] / pivot;
                line[k] = factor;
                if factor != 0.0 {
                    for j in k + 1..size {
                        line[j] -= factor * upper[j];
                    }
                }
            }
        }
        Some(Self {
            matrix,
            rows,
            columns,
        })
    }

    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let size = right.len();
        let mut x: Vec<f64> = self.rows.iter().map(|&row| right[row]).collect();
        for k in 0..size {
            for j in 0..k {
                x[k] -= self.matrix[k][j] * x[j];
            }
        }
        for k in (0..size).rev() {
            for j in k + 1..size {
                x[k] -= self.matrix[k][j] * x[j];
            }
            x[k] /= self.matrix[k][k];
        }
        let mut solution = vec![0.0; size];
        for (value, &column) in x.into_iter().zip(&self.columns) {
            solution[column] = value;
        }
        solution
    }

    /// The largest sum of a row of the inverse.
    pub(crate) fn size_of_inverse(&self) -> f64 {
        let size = self.rows.len();
        let mut sums = vec![0.0; size];
        for k in 0..size {
            let mut unit = vec![0.0; size];
            unit[k] = 1.0;
            for (sum, entry) in sums.iter_mut().zip(self.solve(&unit)) {
                *sum += f64::abs(entry);
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }
}

/// The largest sum of a row.
pub(crate) fn size(matrix: &Matrix) -> f64 {
    let sums = matrix
        .iter()
        .map(|row| row.iter().map(|entry| entry.abs()).sum());
    sums.fold(0.0, f64::max)
}
