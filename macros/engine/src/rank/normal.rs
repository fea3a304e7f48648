//! Steps of least length: `(A A^T + damping I) y = b` by Cholesky's method, where almost all
//! entries are zero.

use super::sparse::Row;

/// Entries by number, in any order.
type Entries = Vec<(usize, f64)>;

/// A row has nobody above it in the tree of the elimination.
const NOBODY: usize = usize::MAX;

/// A factorised matrix `A A^T + damping I`, to which rows of `A` are added one by one.
///
/// A row of the factor `L` is not zero where the row of the matrix is not, and at everything above
/// these places in the tree of the elimination (Davis 2006, section 4.2).
#[derive(Default)]
pub(super) struct Normal {
    /// The rows of `A` that are not zero in a column, with their values there.
    touching: Vec<Entries>,
    /// `L` by rows and by columns, without the diagonal.
    rows: Vec<Entries>,
    columns: Vec<Entries>,
    diagonal: Vec<f64>,
    /// The first row behind each that its column reaches.
    above: Vec<usize>,
    /// Zero between calls.
    known: Vec<f64>,
    /// The last call that met each row.
    met: Vec<usize>,
    calls: usize,
}

/// What is left of a row beside those before it.
pub(super) struct Reduced {
    /// Its row of `L`.
    entries: Entries,
    /// The square of the part that stands out, with the damping.
    pub(super) square: f64,
}

impl Normal {
    /// Factorises; `None` where the matrix is not positive definite.
    pub(super) fn new(a: &[Row], damping: f64) -> Option<Self> {
        let mut normal = Self::default();
        for row in a {
            let reduced = normal.reduced(row, damping);
            if reduced.square.is_nan() || reduced.square <= 0.0 {
                return None;
            }
            normal.push(row, reduced);
        }
        Some(normal)
    }

    /// What would be left of one more row of `A`.
    pub(super) fn reduced(&mut self, row: &Row, damping: f64) -> Reduced {
        self.calls += 1;
        let (order, mut square) = self.reach(row);
        square += damping;
        let mut entries = Entries::with_capacity(order.len());
        let known = self.known.as_mut_slice();
        let mut place = order.len();
        while place > 0 {
            place -= 1;
            let j = order[place];
            let value = known[j] / self.diagonal[j];
            known[j] = 0.0;
            let (column, mut k) = (self.columns[j].as_slice(), 0);
            while k < column.len() {
                known[column[k].0] -= value * column[k].1;
                k += 1;
            }
            entries.push((j, value));
            square -= value * value;
        }
        Reduced { entries, square }
    }

    /// The places of a row of `L`, from the last to be worked out to the first, with the row of the
    /// matrix in `known`; and its diagonal element.
    fn reach(&mut self, row: &Row) -> (Vec<usize>, f64) {
        let mut order = Vec::new();
        let mut path = Vec::new();
        let mut square = 0.0;
        for &(column, own) in row.entries() {
            square += own * own;
            let Some(touching) = self.touching.get(column) else {
                continue;
            };
            let (touching, mut k) = (touching.as_slice(), 0);
            while k < touching.len() {
                let (j, other) = touching[k];
                self.known[j] += own * other;
                let mut next = j;
                while next != NOBODY && self.met[next] != self.calls {
                    self.met[next] = self.calls;
                    path.push(next);
                    next = self.above[next];
                }
                while let Some(j) = path.pop() {
                    order.push(j);
                }
                k += 1;
            }
        }
        (order, square)
    }

    /// Adds a row of `A`, of which the given is left.
    pub(super) fn push(&mut self, row: &Row, Reduced { entries, square }: Reduced) {
        let number = self.diagonal.len();
        for &(column, own) in row.entries() {
            if column >= self.touching.len() {
                self.touching.resize(column + 1, Vec::new());
            }
            self.touching[column].push((number, own));
        }
        for &(j, value) in &entries {
            self.columns[j].push((number, value));
            if self.above[j] == NOBODY {
                self.above[j] = number;
            }
        }
        self.rows.push(entries);
        self.columns.push(Vec::new());
        self.diagonal.push(square.sqrt());
        self.above.push(NOBODY);
        self.known.push(0.0);
        self.met.push(0);
    }

    /// By how much each row stands out from those before it.
    pub(super) fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    /// `A x` of a row `x`.
    pub(super) fn products(&self, row: &Row) -> Vec<f64> {
        let mut products = vec![0.0; self.diagonal.len()];
        for &(column, own) in row.entries() {
            let Some(touching) = self.touching.get(column) else {
                continue;
            };
            for &(j, other) in touching {
                products[j] += own * other;
            }
        }
        products
    }

    /// `y`.
    pub(super) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut y = b.to_vec();
        let (known, diagonal) = (y.as_mut_slice(), self.diagonal.as_slice());
        let count = diagonal.len();
        let mut i = 0;
        while i < count {
            let (row, mut k) = (self.rows[i].as_slice(), 0);
            let mut left = known[i];
            while k < row.len() {
                left -= row[k].1 * known[row[k].0];
                k += 1;
            }
            known[i] = left / diagonal[i];
            i += 1;
        }
        while i > 0 {
            i -= 1;
            let value = known[i] / diagonal[i];
            known[i] = value;
            let (row, mut k) = (self.rows[i].as_slice(), 0);
            while k < row.len() {
                known[row[k].0] -= row[k].1 * value;
                k += 1;
            }
        }
        y
    }
}

/// `y` with `(A A^T + damping I) y = b`; `None` where the matrix is not positive definite.
pub(super) fn solve_normal(a: &[Row], b: &[f64], damping: f64) -> Option<Vec<f64>> {
    Some(Normal::new(a, damping)?.solve(b))
}

#[cfg(test)]
mod tests {
    use super::super::sparse::{Rows, transposed};
    use super::*;

    fn sparse(rows: &[&[f64]]) -> Rows {
        rows.iter().map(|row| Row::of(row)).collect()
    }

    #[test]
    fn a_step_solves_and_is_of_least_length() {
        let a = sparse(&[
            &[1.0, 0.0, 2.0, 0.0],
            &[0.0, 3.0, 0.0, 0.0],
            &[0.5, -1.0, 0.0, 4.0],
        ]);
        let b = [1.0, -2.0, 0.3];
        let x = transposed(&a, &solve_normal(&a, &b, 0.0).expect("independent"), 4);
        for (row, wanted) in a.iter().zip(b) {
            assert!((row.along(&x) - wanted).abs() < 1e-14);
        }
        // Perpendicular to what the rows leave free.
        let free = Row::of(&[-2.0, 0.0, 1.0, 0.25]);
        assert!(free.along(&x).abs() < 1e-14);
    }

    #[test]
    fn damping_makes_dependent_rows_solvable() {
        let a = sparse(&[&[1.0, 0.0], &[1.0, 0.0], &[0.0, 0.0]]);
        assert_eq!(solve_normal(&a, &[1.0, 1.0, 0.0], 0.0), None);
        let y = solve_normal(&a, &[1.0, 1.0, 0.0], 1e-10).expect("damped");
        assert!((transposed(&a, &y, 2)[0] - 1.0).abs() < 1e-6);
        assert_eq!(solve_normal(&[], &[], 0.0), Some(Vec::new()));
    }

    /// Of all orders of sparse and dense rows, so that the factor fills in.
    #[test]
    fn what_fills_in_is_solved() {
        for pattern in 1..6 {
            let a: Rows = (0..12)
                .map(|i| {
                    let entry = |j: usize| match (pattern * i * i + 3 * j) % (pattern + 3) {
                        _ if j == i => 3.0 + i as f64,
                        0 => 1.0 - j as f64,
                        _ => 0.0,
                    };
                    Row::of(&(0..14).map(entry).collect::<Vec<f64>>())
                })
                .collect();
            let b: Vec<f64> = (0..12).map(|k| 0.5 - f64::from(k)).collect();
            let damping = 0.01;
            let y = solve_normal(&a, &b, damping).expect("damped");
            let x = transposed(&a, &y, 14);
            let terms: f64 = a.iter().zip(&y).map(|(row, y)| row.norm() * y.abs()).sum();
            for ((row, y), b) in a.iter().zip(&y).zip(&b) {
                let left = (row.along(&x) + damping * y - b).abs();
                assert!(left < 1e-14 * (1.0 + row.norm() * terms), "{left}");
            }
            let normal = Normal::new(&a, 0.0).expect("independent");
            assert!((normal.products(&a[3])[3] - a[3].norm().powi(2)).abs() < 1e-12);
        }
    }

    /// What is left of a row that is not added has no part in the others.
    #[test]
    fn a_row_that_is_only_tried_leaves_nothing_behind() {
        let a = sparse(&[&[1.0, 0.0, 2.0], &[0.0, 1.0, 1.0], &[1.0, 0.0, 1.0]]);
        let mut tried = Normal::default();
        for row in [0, 2] {
            for other in [1, 0, 2] {
                tried.reduced(&a[other], 0.0);
            }
            let reduced = tried.reduced(&a[row], 0.0);
            tried.push(&a[row], reduced);
        }
        let plain = Normal::new(&[a[0].clone(), a[2].clone()], 0.0).expect("independent");
        assert_eq!(tried.solve(&[1.0, 2.0]), plain.solve(&[1.0, 2.0]));
        assert_eq!(tried.diagonal(), plain.diagonal());
    }
}
