//! Linear algebra on rows: which of them are independent, and what spans them.
//!
//! Rows are stored in full, though those of a mechanism are zero almost everywhere; what is subtracted from them knows where it is not.
//! Macros run unoptimised in the crates of users, also in those that are built with optimisation, and an iterator then costs many times what
//! an index does: hence the plain loops.

/// The rows of a matrix.
pub(super) type Rows = Vec<Vec<f64>>;

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let length = a.len().min(b.len());
    let (mut sum, mut k) = (0.0, 0);
    while k < length {
        sum += a[k] * b[k];
        k += 1;
    }
    sum
}

/// The places where a vector is not zero.
pub(super) fn support(vector: &[f64]) -> Vec<usize> {
    let (mut places, mut k) = (Vec::new(), 0);
    let length = vector.len();
    while k < length {
        if vector[k] != 0.0 {
            places.push(k);
        }
        k += 1;
    }
    places
}

/// A unit vector, and where it is not zero.
pub(super) struct Direction {
    pub(super) values: Vec<f64>,
    support: Vec<usize>,
}

impl Direction {
    /// That of a vector of the given length.
    pub(super) fn of(vector: &[f64], length: f64) -> Self {
        let values: Vec<f64> = vector.iter().map(|x| x / length).collect();
        Self::unit(values)
    }

    /// A vector that is of unit length.
    pub(super) fn unit(values: Vec<f64>) -> Self {
        let support = support(&values);
        Self { values, support }
    }

    /// Takes the part along the direction away, if there is one; whether there was.
    pub(super) fn remove_from(&self, vector: &mut [f64]) -> bool {
        let (values, support) = (self.values.as_slice(), self.support.as_slice());
        let count = support.len();
        let (mut along, mut place) = (0.0, 0);
        while place < count {
            let k = support[place];
            along += vector[k] * values[k];
            place += 1;
        }
        if along == 0.0 {
            return false;
        }
        place = 0;
        while place < count {
            let k = support[place];
            vector[k] -= along * values[k];
            place += 1;
        }
        true
    }
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
    let mut bases: Vec<Vec<Direction>> = matrices.iter().map(|_| Vec::new()).collect();
    let mut taken = Vec::new();
    let mut is_taken = vec![false; count];
    let passes = PASSES.into_iter().filter(|&pass| pass > tolerance);
    for threshold in passes.chain([tolerance]) {
        for row in 0..count {
            let stands_out = |rest: &[Rows]| {
                rest.iter()
                    .map(|rows| norm(&rows[row]))
                    .fold(f64::INFINITY, f64::min)
                    > threshold
            };
            if is_taken[row] || !stands_out(&rest) {
                continue;
            }
            for (rows, basis) in rest.iter_mut().zip(&bases) {
                for direction in basis {
                    direction.remove_from(&mut rows[row]);
                }
            }
            if !stands_out(&rest) {
                continue;
            }
            taken.push(row);
            is_taken[row] = true;
            for (rows, basis) in rest.iter_mut().zip(&mut bases) {
                let direction = Direction::of(&rows[row], norm(&rows[row]));
                for (other, vector) in rows.iter_mut().enumerate() {
                    if !is_taken[other] {
                        direction.remove_from(vector);
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
pub(super) fn orthonormal(rows: &Rows, tolerance: f64) -> Vec<Direction> {
    let mut basis = Vec::new();
    for row in rows {
        let mut rest = row.clone();
        remove_all(&mut rest, &basis);
        let length = norm(&rest);
        if length > tolerance {
            basis.push(Direction::of(&rest, length));
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
pub(super) fn remove_all(vector: &mut [f64], basis: &[Direction]) {
    for direction in basis.iter().chain(basis) {
        direction.remove_from(vector);
    }
}

/// `A^T y`.
pub(super) fn transposed(a: &[Vec<f64>], y: &[f64]) -> Vec<f64> {
    let mut x = vec![0.0; a.first().map_or(0, Vec::len)];
    let length = x.len();
    for (row, factor) in a.iter().zip(y) {
        let row = row.as_slice();
        let mut k = 0;
        while k < length {
            if row[k] != 0.0 {
                x[k] += factor * row[k];
            }
            k += 1;
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
}
