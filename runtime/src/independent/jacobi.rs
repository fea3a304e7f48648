//! Eigenvalues of symmetric matrices, by Jacobi's rotations.

use nalgebra::SMatrix;

use crate::math::scalar::Real;

/// Sweeps that Jacobi's method may take: a few suffice.
const SWEEPS: usize = 40;

/// The eigenvalues of a symmetric matrix, and their vectors, which are orthonormal to round-off
/// however near to each other the eigenvalues are.
///
/// Golub and Van Loan, *Matrix Computations*, 8.5.
pub(super) fn symmetric<S: Real, const N: usize>(
    mut a: SMatrix<S, N, N>,
) -> ([S; N], SMatrix<S, N, N>) {
    let one = |row, column| if row == column { S::one() } else { S::zero() };
    let mut vectors = SMatrix::<S, N, N>::from_fn(one);
    let size = a
        .iter()
        .fold(S::zero(), |most: S, entry| Real::max(most, entry.abs()));
    let negligible = S::EPSILON * S::constant(1e-3) * size;
    for _ in 0..SWEEPS {
        let mut is_diagonal = true;
        let pairs = (0..N).flat_map(|p| (p + 1..N).map(move |q| (p, q)));
        for (p, q) in pairs {
            let entry = a[(p, q)];
            if entry.abs() <= negligible {
                continue;
            }
            is_diagonal = false;
            // The tangent of the lesser angle that takes the entry away.
            let half = (a[(q, q)] - a[(p, p)]).quotient(entry + entry);
            let root = half.abs() + half.fused(half, S::one()).sqrt();
            let t = if half < S::zero() { -root } else { root }.reciprocal();
            let c = t.fused(t, S::one()).sqrt().reciprocal();
            let s = t * c;
            for matrix in [&mut a, &mut vectors] {
                for row in 0..N {
                    let (x, y) = (matrix[(row, p)], matrix[(row, q)]);
                    (matrix[(row, p)], matrix[(row, q)]) = (c * x - s * y, s * x + c * y);
                }
            }
            for column in 0..N {
                let (x, y) = (a[(p, column)], a[(q, column)]);
                (a[(p, column)], a[(q, column)]) = (c * x - s * y, s * x + c * y);
            }
        }
        if is_diagonal {
            break;
        }
    }
    (a.diagonal().into(), vectors)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix1, Matrix2, Matrix4};

    use super::symmetric;

    #[test]
    fn eigenvalues_of_known_matrices() {
        let near = |found: &mut [f64], wanted: &[f64]| {
            found.sort_unstable_by(f64::total_cmp);
            let pairs = found.iter().zip(wanted);
            pairs.for_each(|(found, wanted)| assert!((found - wanted).abs() < 1e-14, "{found}"));
        };
        near(
            &mut symmetric(Matrix2::new(0.0, 1.0, 1.0, 0.0)).0,
            &[-1.0, 1.0],
        );
        near(&mut symmetric(Matrix1::new(-0.25)).0, &[-0.25]);
        // A chain of springs: 2 - 2 cos(k pi / 5).
        let chain = Matrix4::from_fn(|row, column| match row.abs_diff(column) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let angles = [0.2, 0.4, 0.6, 0.8].map(|share| share * core::f64::consts::PI);
        near(
            &mut symmetric(chain).0,
            &angles.map(|angle: f64| 2.0 - 2.0 * angle.cos()),
        );
    }

    /// Vectors of equal and of nearly equal eigenvalues are orthonormal, and eigenvectors.
    #[test]
    fn vectors_are_orthonormal() {
        let turn = Matrix4::from_fn(|row, column| {
            let one = if row == column { 1.0 } else { 0.0 };
            one - 2.0 * [0.1, 0.5, 0.5, 0.7][row] * [0.1, 0.5, 0.5, 0.7][column]
        });
        for near in [0.0, 1e-14, 1e-8, 1e-3] {
            let values = [2.0, 2.0 + near, 2.0 - near, -1.0];
            let matrix: Matrix4<f64> = turn * Matrix4::from_diagonal(&values.into()) * turn;
            let (found, vectors) = symmetric(matrix);
            let off = (vectors.transpose() * vectors - Matrix4::identity()).amax();
            assert!(off < 1e-14, "{near}: {off}");
            let back = vectors * Matrix4::from_diagonal(&found.into()) * vectors.transpose();
            assert!((back - matrix).amax() < 1e-14, "{near}");
        }
    }
}
