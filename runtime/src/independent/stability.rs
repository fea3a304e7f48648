//! Stability of an equilibrium at rest, by the eigenvalues of its stiffness.

use nalgebra::{SMatrix, SVector};

use crate::math::scalar::Real;

/// Sweeps that Jacobi's method may take: a few suffice.
const SWEEPS: usize = 40;

/// The eigenvalues of the stiffness `-M A` in units of the coordinates, over its largest entry, in
/// ascending order. `None` in motion and where the stiffness is not symmetric: there they do not
/// decide. A coordinate on which nothing depends counts as stable.
pub(super) fn eigenvalues<S: Real, const N: usize>(
    mass: &SMatrix<S, N, N>,
    by_positions: &SMatrix<S, N, N>,
    rates: &SVector<S, N>,
    scales: &[S; N],
) -> Option<[S; N]> {
    if rates.iter().any(|&rate| rate != S::zero()) {
        return None;
    }
    let mut k = SMatrix::<S, N, N>::from_fn(|row, column| {
        let sum = (0..N).fold(S::zero(), |sum, inner| {
            mass[(row, inner)].fused(by_positions[(inner, column)], sum)
        });
        -sum * scales[row] * scales[column]
    });
    let largest = |entries: &[S]| {
        let sizes = entries.iter().map(|entry| entry.abs());
        sizes.fold(S::zero(), Real::max)
    };
    let most = largest(k.as_slice());
    if most <= S::zero() {
        return Some([S::one(); N]);
    }
    let off = k.zip_map(&k.transpose(), |a, b| a - b);
    if largest(off.as_slice()) > most * S::EPSILON.sqrt() {
        return None;
    }
    let noise = most * S::EPSILON * S::constant(100.0);
    for number in 0..N {
        if k.row(number).iter().all(|entry| entry.abs() <= noise) {
            k[(number, number)] = most;
        }
    }
    let mut found = symmetric(k.map(|entry| entry.quotient(most)));
    found.sort_unstable_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    Some(found)
}

/// How many of them are negative, beyond round-off.
pub(super) fn negative<S: Real>(eigenvalues: &[S]) -> usize {
    let bound = -S::EPSILON.powf(0.75);
    eigenvalues.iter().filter(|&&value| value < bound).count()
}

/// The eigenvalues of a symmetric matrix, by Jacobi's rotations.
fn symmetric<S: Real, const N: usize>(mut a: SMatrix<S, N, N>) -> [S; N] {
    let negligible = S::EPSILON * S::constant(1e-3);
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
            for row in 0..N {
                let (x, y) = (a[(row, p)], a[(row, q)]);
                (a[(row, p)], a[(row, q)]) = (c * x - s * y, s * x + c * y);
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
    a.diagonal().into()
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
            &mut symmetric(Matrix2::new(0.0, 1.0, 1.0, 0.0)),
            &[-1.0, 1.0],
        );
        near(&mut symmetric(Matrix1::new(-0.25)), &[-0.25]);
        // A chain of springs: 2 - 2 cos(k pi / 5).
        let chain = Matrix4::from_fn(|row, column| match row.abs_diff(column) {
            0 => 2.0,
            1 => -1.0,
            _ => 0.0,
        });
        let angles = [0.2, 0.4, 0.6, 0.8].map(|share| share * core::f64::consts::PI);
        near(
            &mut symmetric(chain),
            &angles.map(|angle: f64| 2.0 - 2.0 * angle.cos()),
        );
    }
}
