//! Singular values and the pseudo-inverse by one-sided Jacobi rotations.
//!
//! nalgebra's `svd` (0.35) is not used: for some matrices with dependent rows, such as `D` of a door on two hinges,
//! its factors give back the matrix with errors of 1e-2 (dimforge/nalgebra, issues 1072 and 1172). One-sided Jacobi is
//! slower and accurate to rounding for any rank (Golub, Van Loan, *Matrix Computations*, section 8.6).

use nalgebra::DMatrix;

/// Singular values and vectors: `matrix = left * diag(values) * right^T`.
#[derive(Clone, Debug)]
pub struct SingularValues {
    /// `left * diag(values)`: rows of the matrix by the smaller of its two sizes, columns orthogonal.
    scaled: DMatrix<f64>,
    /// Orthogonal.
    right: DMatrix<f64>,
    /// Whether `scaled` and `right` belong to the transposed matrix.
    transposed: bool,
    /// Unordered, none negative; as many as the smaller of the two sizes.
    pub values: Vec<f64>,
}

impl SingularValues {
    /// Decomposes a matrix.
    ///
    /// # Panics
    /// If 60 sweeps are not enough, which happens only to entries that are not finite.
    #[must_use]
    pub fn new(matrix: &DMatrix<f64>) -> Self {
        let transposed = matrix.nrows() < matrix.ncols();
        let mut scaled = if transposed {
            matrix.transpose()
        } else {
            matrix.clone()
        };
        let mut right = DMatrix::identity(scaled.ncols(), scaled.ncols());
        let sweeps = (0..60)
            .take_while(|_| sweep(&mut scaled, &mut right))
            .count();
        assert!(sweeps < 60, "Jacobi rotations do not come to rest");
        let values = scaled.column_iter().map(|column| column.norm()).collect();
        Self {
            scaled,
            right,
            transposed,
            values,
        }
    }

    /// Largest over smallest singular value.
    #[must_use]
    pub fn condition(&self) -> f64 {
        let (least, most) = self
            .values
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(least, most), value| {
                (least.min(*value), most.max(*value))
            });
        most / least
    }

    /// Number of singular values above `tolerance` times the largest.
    #[must_use]
    pub fn rank(&self, tolerance: f64) -> usize {
        let bound = self.bound(tolerance);
        self.values.iter().filter(|value| **value > bound).count()
    }

    /// The pseudo-inverse; singular values up to `tolerance` times the largest count as zero.
    #[must_use]
    pub fn pseudo_inverse(&self, tolerance: f64) -> DMatrix<f64> {
        let bound = self.bound(tolerance);
        let mut weighted = self.right.clone();
        for (mut column, value) in weighted.column_iter_mut().zip(&self.values) {
            column *= if *value > bound {
                1.0 / (value * value)
            } else {
                0.0
            };
        }
        if self.transposed {
            &self.scaled * weighted.transpose()
        } else {
            weighted * self.scaled.transpose()
        }
    }

    /// `tolerance` times the largest singular value.
    fn bound(&self, tolerance: f64) -> f64 {
        tolerance
            * self
                .values
                .iter()
                .fold(0.0, |most: f64, value| most.max(*value))
    }
}

/// Makes every pair of columns orthogonal once; returns whether there was anything to do.
fn sweep(columns: &mut DMatrix<f64>, right: &mut DMatrix<f64>) -> bool {
    // Below this a product comes from rounding: it belongs to columns that stand for zero.
    let noise = 1e-17 * columns.norm_squared();
    let mut turned = false;
    for i in 0..columns.ncols() {
        for j in i + 1..columns.ncols() {
            let (a, b) = (columns.column(i), columns.column(j));
            let (aa, bb, ab) = (a.norm_squared(), b.norm_squared(), a.dot(&b));
            if ab.abs() <= noise.max(1e-15 * (aa * bb).sqrt()) {
                continue;
            }
            turned = true;
            // The smaller root of t^2 + 2 z t - 1 = 0.
            let z = (bb - aa) / (2.0 * ab);
            let t = z.signum() / (z.abs() + z.hypot(1.0));
            let cosine = 1.0 / t.hypot(1.0);
            rotate(columns, i, j, cosine, cosine * t);
            rotate(right, i, j, cosine, cosine * t);
        }
    }
    turned
}

/// `(a, b)` becomes `(c a - s b, s a + c b)`.
fn rotate(matrix: &mut DMatrix<f64>, i: usize, j: usize, cosine: f64, sine: f64) {
    for row in 0..matrix.nrows() {
        let (a, b) = (matrix[(row, i)], matrix[(row, j)]);
        matrix[(row, i)] = cosine * a - sine * b;
        matrix[(row, j)] = sine * a + cosine * b;
    }
}
