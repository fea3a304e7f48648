//! Stability of an equilibrium at rest, by the eigenvalues of its stiffness.

use nalgebra::{SMatrix, SVector};

use super::jacobi::symmetric;
use crate::math::scalar::Real;

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
    let (mut found, _) = symmetric(k.map(|entry| entry.quotient(most)));
    found.sort_unstable_by(|a, b| a.to_f64().total_cmp(&b.to_f64()));
    Some(found)
}

/// How many of them are negative, beyond round-off.
pub(super) fn negative<S: Real>(eigenvalues: &[S]) -> usize {
    let bound = -S::EPSILON.powf(0.75);
    eigenvalues.iter().filter(|&&value| value < bound).count()
}
