//! Linear algebra on vectors that are stored in full; what is subtracted from them knows where it
//! is not zero.

/// The rows of a matrix, zeros and all.
pub(super) type Matrix = Vec<Vec<f64>>;

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
fn support(vector: &[f64]) -> Vec<usize> {
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

/// Unit vectors at right angles to each other that span the rows, which are of unit length or zero.
pub(super) fn orthonormal(rows: &Matrix, tolerance: f64) -> Vec<Direction> {
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
pub(super) fn transpose(rows: &Matrix) -> Matrix {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns)
        .map(|column| rows.iter().map(|row| row[column]).collect())
        .collect()
}

/// By elimination with the largest pivot of each column.
pub(super) fn determinant(mut rows: Matrix) -> f64 {
    let (count, mut product) = (rows.len(), 1.0);
    for k in 0..count {
        let (mut pivot, mut row) = (k, k + 1);
        while row < count {
            if rows[row][k].abs() > rows[pivot][k].abs() {
                pivot = row;
            }
            row += 1;
        }
        if pivot != k {
            rows.swap(k, pivot);
            product = -product;
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let own = above[k].as_slice();
        product *= own[k];
        if own[k] == 0.0 {
            return 0.0;
        }
        for other in below {
            let other = other.as_mut_slice();
            let factor = other[k] / own[k];
            let mut column = k;
            while factor != 0.0 && column < count {
                other[column] -= factor * own[column];
                column += 1;
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

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(determinant(Matrix::new()), 1.0);
    }
}
