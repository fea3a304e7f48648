//! Singular values and the pseudo-inverse by one-sided Jacobi rotations.
//!
//! nalgebra's `svd` (0.35) is not used: for some matrices with dependent rows, such as `D` of a
//! door on two hinges, its factors give back the matrix with errors of 1e-2 (dimforge/nalgebra,
//! issues 1072 and 1172). One-sided Jacobi is slower and accurate to rounding for any rank (Golub,
//! Van Loan, *Matrix Computations*, section 8.6).

use nalgebra::DMatrix;

/// Singular values and vectors: `matrix = left * diag(values) * right^T`.
#[derive(Clone, Debug)]
pub struct SingularValues {
    /// `left * diag(values)`: rows of the matrix by the smaller of its two sizes, columns
    /// orthogonal.
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
    // Those of columns that were turned are a little off, and are computed anew in the next sweep;
    // the last one turns none.
    let mut squares: Vec<f64> = columns.column_iter().map(|c| c.norm_squared()).collect();
    let mut turned = false;
    for i in 0..columns.ncols() {
        for j in i + 1..columns.ncols() {
            let (aa, bb) = (squares[i], squares[j]);
            let (a, b) = pair(columns, i, j);
            let ab = product(a, b);
            if ab.abs() <= noise.max(1e-15 * (aa * bb).sqrt()) {
                continue;
            }
            turned = true;
            // The smaller root of t^2 + 2 z t - 1 = 0.
            let z = (bb - aa) / (2.0 * ab);
            let t = z.signum() / (z.abs() + (z * z + 1.0).sqrt());
            let cosine = 1.0 / (t * t + 1.0).sqrt();
            rotate(pair(columns, i, j), cosine, cosine * t);
            rotate(pair(right, i, j), cosine, cosine * t);
            squares[i] = (aa - t * ab).max(0.0);
            squares[j] = bb + t * ab;
        }
    }
    turned
}

/// Two columns, the first before the second.
fn pair(matrix: &mut DMatrix<f64>, i: usize, j: usize) -> (&mut [f64], &mut [f64]) {
    let rows = matrix.nrows();
    let (before, after) = matrix.as_mut_slice().split_at_mut(j * rows);
    (&mut before[i * rows..(i + 1) * rows], &mut after[..rows])
}

/// The product of two columns, in four sums.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (a, a_rest) = a.as_chunks::<4>();
    let (b, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for ([a0, a1, a2, a3], [b0, b1, b2, b3]) in a.iter().zip(b) {
        let [s0, s1, s2, s3] = sums;
        sums = [s0 + a0 * b0, s1 + a1 * b1, s2 + a2 * b2, s3 + a3 * b3];
    }
    let rest = a_rest.iter().zip(b_rest);
    let rest: f64 = rest.map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// `(a, b)` becomes `(c a - s b, s a + c b)`.
fn rotate((a, b): (&mut [f64], &mut [f64]), cosine: f64, sine: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}
