//! The saddle system of one body, dense: `(D M^-1 D^T + e I) lambda = D M^-1 g - gamma*` by
//! Cholesky's method.

use core::array::from_fn;

use crate::Scalar;
use crate::mechanism::Pivot;

/// `D` with its `D = 6 M` elements, and Cholesky's factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors<S, const D: usize, const M: usize> {
    jacobian: [S; D],
    /// The lower triangle, with the reciprocals of its diagonal.
    lower: [[S; M]; M],
}

pub(super) fn factor<S: Scalar, const D: usize, const M: usize>(
    d: [S; D],
    mass: &[S; 6],
    compliance: Option<&[S; M]>,
) -> (Factors<S, D, M>, Pivot<S>) {
    let mut lower = [[S::zero(); M]; M];
    let mut pivot = Pivot::unchecked();
    for i in 0..M {
        for j in 0..=i {
            let mut sum = (0..6).fold(S::zero(), |sum, k| {
                sum + d[6 * i + k] * d[6 * j + k] * mass[k].reciprocal()
            });
            if let (Some(compliance), true) = (compliance, i == j) {
                sum = sum + compliance[i];
            }
            let full = sum;
            sum = (0..j).fold(sum, |sum, k| sum - lower[i][k] * lower[j][k]);
            if i == j {
                pivot = pivot.and(sum * full.reciprocal(), 0);
                lower[i][i] = sum.sqrt().reciprocal();
            } else {
                lower[i][j] = sum * lower[j][j];
            }
        }
    }
    (Factors { jacobian: d, lower }, pivot)
}

pub(super) fn solve<S: Scalar, const D: usize, const M: usize>(
    factors: &Factors<S, D, M>,
    mass: &[S; 6],
    upper: &[S; 6],
    lower: &[S; M],
) -> ([S; 6], [S; M]) {
    let Factors {
        jacobian: d,
        lower: l,
    } = factors;
    let mut x: [S; M] = from_fn(|i| {
        let sum = (0..6).map(|k| d[6 * i + k] * mass[k].reciprocal() * upper[k]);
        sum.fold(-lower[i], |sum, term| sum + term)
    });
    for i in 0..M {
        x[i] = (0..i).fold(x[i], |sum, k| sum - l[i][k] * x[k]) * l[i][i];
    }
    for i in (0..M).rev() {
        x[i] = (i + 1..M).fold(x[i], |sum, k| sum - l[k][i] * x[k]) * l[i][i];
    }
    let a = from_fn(|k| {
        let sum = (0..M).fold(upper[k], |sum, i| sum - d[6 * i + k] * x[i]);
        sum * mass[k].reciprocal()
    });
    (a, x)
}
