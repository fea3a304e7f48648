//! Whether every motion that the constraints leave free has a kinetic energy.
//!
//! Of bodies with mass and inertia every motion has. Where these are as somebody gave them, it is a
//! matter of the whole: a link without mass may carry one that has it. So the mass matrix of the
//! bodies is restricted to the motions that the constraints leave free, and factorised.

use super::dense::{Matrix, dot};
use super::limits::TOLERANCE;
use super::motion::Constraints;
use super::random::Random;
use super::sparse::Rows;
use super::walk::walk;
use crate::model::{BodyKind, Model};

/// The part of what a pivot is made of, sums of sizes, that is round-off.
const ROUND_OFF: f64 = 1e-12;

/// Whether the mass matrix is positive definite at the reference configuration and at some that
/// random motions lead to. `None` where the macro cannot see a number.
#[must_use]
pub fn is_definite(model: &Model) -> Option<bool> {
    let mut random = Random::new();
    let new = Constraints::new(model, |velocities| random.motion(velocities));
    let (constraints, described) = new?;
    let start = constraints.assembled(&described)?;
    let mass = masses(model, constraints.length)?;
    let mut all = true;
    for at in walk(&constraints, start, None, &mut random) {
        let rows = constraints.directions(&at, TOLERANCE)?;
        all &= factorises(&free_motions(&rows, mass.len()), &mass);
    }
    Some(all)
}

/// The diagonal of the mass matrix, over motions without dimension: translations by a length.
fn masses(model: &Model, length: f64) -> Option<Vec<f64>> {
    let mut masses = Vec::new();
    for body in &model.bodies {
        let mass = model.seen(body.mass)? * length * length;
        masses.extend([mass; 3]);
        if body.kind == BodyKind::Rigid {
            for moment in body.inertia {
                masses.push(model.seen(moment)?);
            }
        }
    }
    Some(masses)
}

/// An orthonormal basis of the motions that have no part along any row.
fn free_motions(rows: &Rows, velocities: usize) -> Matrix {
    let mut held = Matrix::new();
    for row in rows {
        let mut vector = row.dense(velocities);
        orthogonalise(&mut vector, &held);
        let length = dot(&vector, &vector).sqrt();
        if length > TOLERANCE {
            vector.iter_mut().for_each(|x| *x /= length);
            held.push(vector);
        }
    }
    // What is left of the unit vectors, the longest first.
    let rest = |held: &Matrix, k: usize| 1.0 - held.iter().map(|row| row[k] * row[k]).sum::<f64>();
    let mut left: Vec<f64> = (0..velocities).map(|k| rest(&held, k)).collect();
    let mut free = Matrix::new();
    while held.len() < velocities {
        let longest = (0..velocities).max_by(|a, b| left[*a].total_cmp(&left[*b]));
        let Some(k) = longest else { break };
        let mut vector = vec![0.0; velocities];
        vector[k] = 1.0;
        orthogonalise(&mut vector, &held);
        let length = dot(&vector, &vector).sqrt();
        vector.iter_mut().for_each(|x| *x /= length);
        for (left, x) in left.iter_mut().zip(&vector) {
            *left -= x * x;
        }
        free.push(vector.clone());
        held.push(vector);
    }
    free
}

/// Takes the parts along unit vectors away; twice, so that round-off goes as well.
fn orthogonalise(vector: &mut [f64], units: &Matrix) {
    for unit in units.iter().chain(units) {
        let along = dot(unit, vector);
        if along != 0.0 {
            for (x, e) in vector.iter_mut().zip(unit) {
                *x -= along * e;
            }
        }
    }
}

/// Whether `Z M Z^T` has positive pivots.
fn factorises(free: &Matrix, mass: &[f64]) -> bool {
    let count = free.len();
    let mut matrix = vec![vec![0.0; count]; count];
    let mut sizes = vec![0.0; count];
    for (i, one) in free.iter().enumerate() {
        let weighted: Vec<f64> = one.iter().zip(mass).map(|(x, m)| x * m).collect();
        let terms = weighted.iter().zip(one).map(|(m, x)| (m * x).abs());
        sizes[i] = terms.sum();
        for (j, other) in free.iter().enumerate() {
            matrix[i][j] = dot(&weighted, other);
        }
    }
    for k in 0..count {
        let pivot = matrix[k][k];
        if pivot.is_nan() || pivot <= ROUND_OFF * sizes[k] {
            return false;
        }
        let row = matrix[k].clone();
        for below in matrix.iter_mut().skip(k + 1) {
            let share = below[k] / pivot;
            for (entry, x) in below.iter_mut().zip(&row).skip(k) {
                *entry -= share * x;
            }
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::{factorises, free_motions};
    use crate::rank::sparse::Row;

    #[test]
    fn a_mass_that_is_negative_may_be_held() {
        let rows = vec![Row::of(&[0.0, 0.6, 0.8])];
        let free = free_motions(&rows, 3);
        assert_eq!(free.len(), 2);
        // Along the row nothing moves: there is `0.64 * 1 + 0.36 * m` left across.
        assert!(factorises(&free, &[1.0, 1.0, -1.7]));
        assert!(!factorises(&free, &[1.0, 1.0, -1.8]));
        assert!(!factorises(&free, &[0.0, 1.0, 1.0]));
    }
}
