//! Steps of least length: `(A A^T + damping I) y = b` by Cholesky's method, where almost all entries are zero.

use super::dense::support;

/// The rows of a factor `L`, without the diagonal: places and values.
type Sparse = Vec<Vec<(usize, f64)>>;

/// A factorised matrix `A A^T + damping I`.
pub(super) struct Normal {
    rows: Sparse,
    diagonal: Vec<f64>,
}

impl Normal {
    /// Factorises; `None` where the matrix is not positive definite.
    ///
    /// Row by row: entry `j` of a row is known when those before it are, and then takes its part in those behind it.
    pub(super) fn new(a: &[Vec<f64>], damping: f64) -> Option<Self> {
        let count = a.len();
        let width = a.first().map_or(0, Vec::len);
        // The rows so far that are not zero in a column.
        let mut touching: Vec<Vec<usize>> = vec![Vec::new(); width];
        // What is known of `L`, by columns.
        let mut columns: Sparse = vec![Vec::new(); count];
        let mut rows: Sparse = Vec::with_capacity(count);
        let mut diagonal: Vec<f64> = Vec::with_capacity(count);
        let (mut row, mut known) = (vec![0.0; count], vec![0.0; count]);
        for (i, own) in a.iter().enumerate() {
            let mut first = i;
            for k in support(own) {
                touching[k].push(i);
                first = first.min(touching[k][0]);
                for &j in &touching[k] {
                    row[j] += own[k] * a[j][k];
                }
            }
            let mut entries = Vec::new();
            let (mut j, mut square) = (first, 0.0);
            while j < i {
                if row[j] != 0.0 || known[j] != 0.0 {
                    let value = (row[j] - known[j]) / diagonal[j];
                    (row[j], known[j]) = (0.0, 0.0);
                    if value != 0.0 {
                        for &(m, entry) in &columns[j] {
                            known[m] += value * entry;
                        }
                        columns[j].push((i, value));
                        entries.push((j, value));
                        square += value * value;
                    }
                }
                j += 1;
            }
            let pivot = row[i] + damping - square;
            (row[i], known[i]) = (0.0, 0.0);
            if pivot.is_nan() || pivot <= 0.0 {
                return None;
            }
            diagonal.push(pivot.sqrt());
            rows.push(entries);
        }
        Some(Self { rows, diagonal })
    }

    /// `y`.
    pub(super) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut y = b.to_vec();
        for (i, row) in self.rows.iter().enumerate() {
            let mut known = 0.0;
            for &(k, entry) in row {
                known += entry * y[k];
            }
            y[i] = (y[i] - known) / self.diagonal[i];
        }
        for (i, row) in self.rows.iter().enumerate().rev() {
            y[i] /= self.diagonal[i];
            let value = y[i];
            for &(k, entry) in row {
                y[k] -= entry * value;
            }
        }
        y
    }
}

/// `y` with `(A A^T + damping I) y = b`; `None` where the matrix is not positive definite.
pub(super) fn solve_normal(a: &[Vec<f64>], b: &[f64], damping: f64) -> Option<Vec<f64>> {
    Some(Normal::new(a, damping)?.solve(b))
}

#[cfg(test)]
mod tests {
    use super::super::dense::{dot, transposed};
    use super::*;

    #[test]
    fn a_step_solves_and_is_of_least_length() {
        let a = vec![
            vec![1.0, 0.0, 2.0, 0.0],
            vec![0.0, 3.0, 0.0, 0.0],
            vec![0.5, -1.0, 0.0, 4.0],
        ];
        let b = [1.0, -2.0, 0.3];
        let x = transposed(&a, &solve_normal(&a, &b, 0.0).expect("independent"));
        for (row, wanted) in a.iter().zip(b) {
            assert!((dot(row, &x) - wanted).abs() < 1e-14);
        }
        // Perpendicular to what the rows leave free.
        let free = [-2.0, 0.0, 1.0, 0.25];
        assert!(dot(&free, &x).abs() < 1e-14);
    }

    #[test]
    fn damping_makes_dependent_rows_solvable() {
        let a = vec![vec![1.0, 0.0], vec![1.0, 0.0], vec![0.0, 0.0]];
        assert_eq!(solve_normal(&a, &[1.0, 1.0, 0.0], 0.0), None);
        let y = solve_normal(&a, &[1.0, 1.0, 0.0], 1e-10).expect("damped");
        assert!((transposed(&a, &y)[0] - 1.0).abs() < 1e-6);
        assert_eq!(solve_normal(&[], &[], 0.0), Some(Vec::new()));
    }

    /// The matrix is dense but for some rows, and fills in.
    #[test]
    fn what_fills_in_is_solved() {
        let a: Vec<Vec<f64>> = (0..7)
            .map(|i| {
                let entry = |j: usize| match (i * i + 3 * j) % 5 {
                    _ if j == i => 3.0 + i as f64,
                    0 => 1.0 - j as f64,
                    _ => 0.0,
                };
                (0..9).map(entry).collect()
            })
            .collect();
        let b: Vec<f64> = (0..7).map(|k| 0.5 - f64::from(k)).collect();
        let damping = 0.01;
        let y = solve_normal(&a, &b, damping).expect("damped");
        let x = transposed(&a, &y);
        for ((row, y), b) in a.iter().zip(&y).zip(b) {
            assert!((dot(row, &x) + damping * y - b).abs() < 1e-12);
        }
    }
}
