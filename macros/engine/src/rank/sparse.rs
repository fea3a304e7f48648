//! Rows that are zero almost everywhere, as those of a mechanism are.
//!
//! Macros run unoptimised in the crates of users, also in those that are built with optimisation,
//! and an iterator then costs many times what an index does: hence the plain loops, here and
//! wherever numbers are worked on.

/// A row of a matrix: the places where it is not zero, in order, and its values there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    entries: Vec<(usize, f64)>,
}

/// The rows of a matrix.
pub(super) type Rows = Vec<Row>;

impl Row {
    /// The row of some values.
    pub(super) fn of(values: &[f64]) -> Self {
        let mut row = Self::default();
        let (length, mut place) = (values.len(), 0);
        while place < length {
            row.push(place, values[place]);
            place += 1;
        }
        row
    }

    /// Appends a value at a place behind all others.
    pub(super) fn push(&mut self, place: usize, value: f64) {
        if value != 0.0 {
            self.entries.push((place, value));
        }
    }

    /// Places and values.
    pub(super) fn entries(&self) -> &[(usize, f64)] {
        &self.entries
    }

    /// The length that holds all places.
    pub(super) fn width(&self) -> usize {
        self.entries.last().map_or(0, |(place, _)| place + 1)
    }

    /// The value at a place.
    pub(super) fn at(&self, place: usize) -> f64 {
        let found = self.entries.binary_search_by_key(&place, |entry| entry.0);
        found.map_or(0.0, |found| self.entries[found].1)
    }

    /// The values at all places up to some length.
    pub(super) fn dense(&self, length: usize) -> Vec<f64> {
        let mut values = vec![0.0; length];
        self.add_to(1.0, &mut values);
        values
    }

    /// Multiplies all values with a factor.
    pub(super) fn scale(&mut self, factor: f64) {
        if factor == 0.0 {
            self.entries.clear();
        }
        self.entries.iter_mut().for_each(|entry| entry.1 *= factor);
    }

    pub(super) fn norm(&self) -> f64 {
        let (entries, mut k, mut sum) = (self.entries(), 0, 0.0);
        while k < entries.len() {
            sum += entries[k].1 * entries[k].1;
            k += 1;
        }
        sum.sqrt()
    }

    /// The scalar product with a vector.
    pub(super) fn along(&self, vector: &[f64]) -> f64 {
        let (entries, mut k, mut sum) = (self.entries(), 0, 0.0);
        while k < entries.len() {
            sum += entries[k].1 * vector[entries[k].0];
            k += 1;
        }
        sum
    }

    /// Adds a multiple to a vector.
    pub(super) fn add_to(&self, factor: f64, vector: &mut [f64]) {
        let (entries, mut k) = (self.entries(), 0);
        while k < entries.len() {
            vector[entries[k].0] += factor * entries[k].1;
            k += 1;
        }
    }
}

/// The length that holds all places of some rows.
pub(super) fn width(rows: &[Row]) -> usize {
    rows.iter().map(Row::width).max().unwrap_or(0)
}

/// `A^T y`, of the given length.
pub(super) fn transposed(a: &[Row], y: &[f64], length: usize) -> Vec<f64> {
    let mut x = vec![0.0; length];
    for (row, &factor) in a.iter().zip(y) {
        row.add_to(factor, &mut x);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_its_values() {
        let values = [0.0, 2.0, 0.0, -3.0, 0.0];
        let mut row = Row::of(&values);
        assert_eq!(row.entries(), [(1, 2.0), (3, -3.0)]);
        assert_eq!(row.dense(5), values);
        assert_eq!((row.at(3), row.at(2)), (-3.0, 0.0));
        assert_eq!(row.along(&[1.0, 2.0, 3.0, 4.0, 5.0]), -8.0);
        assert_eq!(width(&[row.clone(), Row::default()]), 4);
        let sum = transposed(&[row.clone(), Row::of(&[1.0, 1.0])], &[2.0, 3.0], 5);
        assert_eq!(sum, [3.0, 7.0, 0.0, -6.0, 0.0]);
        row.scale(0.5);
        assert_eq!(row, Row::of(&[0.0, 1.0, 0.0, -1.5]));
        row.scale(0.0);
        assert_eq!(row, Row::default());
    }
}
