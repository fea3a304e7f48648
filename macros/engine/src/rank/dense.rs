//! Dense linear algebra on a few rows: which of them are independent, and a damped step of least length.

/// The rows of a matrix.
pub(super) type Rows = Vec<Vec<f64>>;

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// How far a row must stand out from those taken before it, pass by pass: what is clearly independent is taken first, so that
/// the rows taken are well conditioned; within a pass the order of the rows decides.
const PASSES: [f64; 6] = [0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6];

/// A maximal set of rows that are independent in each of some matrices of equal shape, in order. Rows are of unit
/// length, or zero.
///
/// Gram and Schmidt, modified, and done twice where a row loses most of its length.
pub(super) fn independent(matrices: &[Rows], tolerance: f64) -> Vec<usize> {
    let count = matrices.first().map_or(0, Vec::len);
    let mut rest: Vec<Rows> = matrices.to_vec();
    let mut bases: Vec<Rows> = vec![Rows::new(); matrices.len()];
    let mut taken = Vec::new();
    let passes = PASSES.into_iter().filter(|&pass| pass > tolerance);
    for threshold in passes.chain([tolerance]) {
        for row in 0..count {
            let stands_out = |rest: &[Rows]| {
                rest.iter()
                    .map(|rows| norm(&rows[row]))
                    .fold(f64::INFINITY, f64::min)
                    > threshold
            };
            if taken.contains(&row) || !stands_out(&rest) {
                continue;
            }
            for (rows, basis) in rest.iter_mut().zip(&bases) {
                for direction in basis {
                    remove(&mut rows[row], direction);
                }
            }
            if !stands_out(&rest) {
                continue;
            }
            taken.push(row);
            for (rows, basis) in rest.iter_mut().zip(&mut bases) {
                let length = norm(&rows[row]);
                let direction: Vec<f64> = rows[row].iter().map(|x| x / length).collect();
                for (other, vector) in rows.iter_mut().enumerate() {
                    if !taken.contains(&other) {
                        remove(vector, &direction);
                    }
                }
                basis.push(direction);
            }
        }
    }
    taken.sort_unstable();
    taken
}

/// Unit vectors at right angles to each other that span the rows, which are of unit length or zero.
pub(super) fn orthonormal(rows: &Rows, tolerance: f64) -> Rows {
    let mut basis = Rows::new();
    for row in rows {
        let mut rest = row.clone();
        remove_all(&mut rest, &basis);
        let length = norm(&rest);
        if length > tolerance {
            basis.push(rest.iter().map(|x| x / length).collect());
        }
    }
    basis
}

/// Rows for columns.
pub(super) fn transpose(rows: &Rows) -> Rows {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| rows.iter().map(|row| row[column]).collect())
        .collect()
}

/// By elimination with the largest pivot of each column.
pub(super) fn determinant(mut rows: Rows) -> f64 {
    let mut product = 1.0;
    for k in 0..rows.len() {
        let size = |row: &usize| rows[*row][k].abs();
        let largest = (k..rows.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        let pivot = largest.unwrap_or(k);
        if pivot != k {
            rows.swap(k, pivot);
            product = -product;
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let row = &above[k];
        product *= row[k];
        if row[k] == 0.0 {
            return 0.0;
        }
        for other in below {
            let factor = other[k] / row[k];
            for (x, y) in other.iter_mut().zip(row).skip(k) {
                *x -= factor * y;
            }
        }
    }
    product
}

/// Takes the parts along unit vectors away, twice because the first time leaves round-off.
pub(super) fn remove_all(vector: &mut [f64], basis: &Rows) {
    for direction in basis.iter().chain(basis) {
        remove(vector, direction);
    }
}

/// Takes the part along a unit vector away.
pub(super) fn remove(vector: &mut [f64], direction: &[f64]) {
    let along = dot(vector, direction);
    if along != 0.0 {
        for (x, d) in vector.iter_mut().zip(direction) {
            *x -= along * d;
        }
    }
}

/// `y` with `(A A^T + damping I) y = b`, by Cholesky's method within the envelope; `None` where the matrix is not positive
/// definite.
pub(super) fn solve_normal(a: &[Vec<f64>], b: &[f64], damping: f64) -> Option<Vec<f64>> {
    let supports: Vec<Vec<usize>> = a
        .iter()
        .map(|row| (0..row.len()).filter(|&k| row[k] != 0.0).collect())
        .collect();
    let product = |i: usize, j: usize| supports[i].iter().map(|&k| a[i][k] * a[j][k]).sum::<f64>();
    // Row by row from the first entry that is not zero to the diagonal.
    let mut lower: Vec<(usize, Vec<f64>)> = Vec::new();
    for i in 0..a.len() {
        let mut row: Vec<f64> = (0..=i).map(|j| product(i, j)).collect();
        row[i] += damping;
        let first = row.iter().position(|&x| x != 0.0)?;
        row.drain(..first);
        for j in first..i {
            let (start, other) = &lower[j];
            let from = first.max(*start);
            let known = dot(&row[from - first..j - first], &other[from - start..]);
            row[j - first] = (row[j - first] - known) / other[j - start];
        }
        let before = &row[..i - first];
        let pivot = row[i - first] - dot(before, before);
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        row[i - first] = pivot.sqrt();
        lower.push((first, row));
    }
    let mut y = b.to_vec();
    for (i, (first, row)) in lower.iter().enumerate() {
        let known = dot(&row[..i - first], &y[*first..i]);
        y[i] = (y[i] - known) / row[i - first];
    }
    for (i, (first, row)) in lower.iter().enumerate().rev() {
        y[i] /= row[i - first];
        let value = y[i];
        for (k, entry) in (*first..i).zip(row) {
            y[k] -= entry * value;
        }
    }
    Some(y)
}

/// `A^T y`.
pub(super) fn transposed(a: &[Vec<f64>], y: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; a.first().map_or(0, Vec::len)];
    for (row, factor) in a.iter().zip(y) {
        for (sum, entry) in x.iter_mut().zip(row) {
            *sum += factor * entry;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(mut row: Vec<f64>) -> Vec<f64> {
        let length = norm(&row);
        row.iter_mut().for_each(|x| *x /= length);
        row
    }

    #[test]
    fn what_follows_from_others_is_left_out() {
        let rows = vec![
            unit(vec![1.0, 2.0, 0.0, 0.0]),
            vec![0.0; 4],
            unit(vec![2.0, 4.0, 0.0, 0.0]),
            unit(vec![0.0, 1.0, 3.0, 0.0]),
            unit(vec![1.0, 3.0, 3.0, 0.0]),
            unit(vec![0.0, 0.0, 0.0, -1.0]),
        ];
        assert_eq!(independent(&[rows], 1e-7), [0, 3, 5]);
        assert_eq!(independent(&[], 1e-7), [0; 0]);
        assert_eq!(independent(&[Rows::new()], 1e-7), [0; 0]);
    }

    #[test]
    fn what_is_clearly_independent_is_taken_first() {
        let rows = vec![vec![1.0, 0.0], unit(vec![1.0, 1e-3]), unit(vec![1.0, 1.0])];
        assert_eq!(independent(&[rows], 1e-7), [0, 2]);
        let near = vec![vec![1.0, 0.0], unit(vec![1.0, 1e-5])];
        assert_eq!(independent(std::slice::from_ref(&near), 1e-7), [0, 1]);
        assert_eq!(independent(&[near], 1e-4), [0]);
    }

    #[test]
    fn a_row_must_be_independent_in_every_matrix() {
        let (x, y) = (vec![1.0, 0.0], vec![0.0, 1.0]);
        let first = vec![x.clone(), y.clone(), unit(vec![1.0, 1.0])];
        let second = vec![x.clone(), x, y];
        assert_eq!(independent(&[first, second], 1e-7), [0, 2]);
    }

    #[test]
    fn a_hilbert_matrix_has_the_rank_that_the_tolerance_sees() {
        let rows: Rows = (1..=10)
            .map(|i| unit((0..10).map(|j| 1.0 / f64::from(i + j)).collect()))
            .collect();
        let counts = [1e-1, 1e-3, 1e-5, 1e-7]
            .map(|tolerance| independent(std::slice::from_ref(&rows), tolerance).len());
        assert!(
            counts.is_sorted() && counts[0] >= 2 && counts[3] <= 8,
            "{counts:?}"
        );
    }

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
    fn determinants_have_the_sign_of_the_order() {
        let rows = vec![
            vec![0.0, 2.0, 1.0],
            vec![3.0, 0.0, 4.0],
            vec![1.0, 1.0, 0.0],
        ];
        assert!((determinant(rows.clone()) - 11.0).abs() < 1e-14);
        assert!((determinant(transpose(&rows)) - 11.0).abs() < 1e-14);
        assert_eq!(determinant(vec![vec![1.0, 2.0], vec![2.0, 4.0]]), 0.0);
        assert_eq!(determinant(Rows::new()), 1.0);
    }

    #[test]
    fn damping_makes_dependent_rows_solvable() {
        let a = vec![vec![1.0, 0.0], vec![1.0, 0.0], vec![0.0, 0.0]];
        assert_eq!(solve_normal(&a, &[1.0, 1.0, 0.0], 0.0), None);
        let y = solve_normal(&a, &[1.0, 1.0, 0.0], 1e-10).expect("damped");
        assert!((transposed(&a, &y)[0] - 1.0).abs() < 1e-6);
        assert_eq!(solve_normal(&[], &[], 0.0), Some(Vec::new()));
    }
}
