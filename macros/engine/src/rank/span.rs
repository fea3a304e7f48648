//! Which rows are independent, and what they span.

use super::dense::{Direction, norm};
use super::normal::Normal;
use super::sparse::{Row, Rows, width};

/// How far a row must stand out from those taken before it, pass by pass: what is clearly
/// independent is taken first, so that the rows taken are well conditioned; within a pass the order
/// of the rows decides.
const PASSES: [f64; 6] = [0.1, 0.01, 1e-3, 1e-4, 1e-5, 1e-6];

/// What some rows span.
#[derive(Default)]
pub(super) struct Span<'a> {
    /// Those that stand out clearly, as they are: few of their products are not zero.
    rows: Vec<&'a Row>,
    normal: Normal,
    /// What the others add.
    directions: Vec<Direction>,
}

impl<'a> Span<'a> {
    /// What rows span, of unit length or zero.
    pub(super) fn of(rows: &'a Rows, tolerance: f64) -> Self {
        let (_, spans) = spanned(std::slice::from_ref(rows), tolerance);
        spans.into_iter().next().unwrap_or_default()
    }

    /// Takes the parts along what is spanned away, twice because the first time leaves round-off.
    pub(super) fn remove_from(&self, vector: &mut [f64]) {
        for _ in 0..2 {
            self.remove_rows_from(vector);
            for direction in &self.directions {
                direction.remove_from(vector);
            }
        }
    }

    fn remove_rows_from(&self, vector: &mut [f64]) {
        let products: Vec<f64> = self.rows.iter().map(|row| row.along(vector)).collect();
        for (row, share) in self.rows.iter().zip(self.normal.solve(&products)) {
            row.add_to(-share, vector);
        }
    }

    /// What is left of a row beside those that stand out clearly; `None` where that is no more than
    /// a tolerance.
    fn left_of(&self, row: &Row, length: usize, tolerance: f64) -> Option<Vec<f64>> {
        let mut left = row.dense(length);
        // What is short the first time is short: it is the row without a sum of others.
        for _ in 0..2 {
            self.remove_rows_from(&mut left);
            if norm(&left) <= tolerance {
                return None;
            }
        }
        Some(left)
    }
}

/// A maximal set of rows that are independent in each of some matrices of equal shape, in order.
/// Rows are of unit length, or shorter.
pub(super) fn independent(matrices: &[Rows], tolerance: f64) -> Vec<usize> {
    let (mut taken, _) = spanned(matrices, tolerance);
    taken.sort_unstable();
    taken
}

/// The same in the order in which they are taken, and what they span in each matrix.
///
/// The rows of the first pass are known by their scalar products, most of which are zero. What
/// these leave of the others is small, and is worked on as it is: Gram and Schmidt, modified, and
/// done twice where a row loses most of its length.
fn spanned(matrices: &[Rows], tolerance: f64) -> (Vec<usize>, Vec<Span<'_>>) {
    let count = matrices.first().map_or(0, Vec::len);
    let length = matrices.iter().map(|rows| width(rows)).max().unwrap_or(0);
    let mut spans: Vec<Span<'_>> = matrices.iter().map(|_| Span::default()).collect();
    let (mut taken, mut others) = (Vec::new(), Vec::new());
    let clear = tolerance.max(PASSES[0]);
    for row in 0..count {
        if takes(&mut spans, matrices, row, clear) {
            taken.push(row);
        } else {
            others.push(row);
        }
    }
    let mut rest: Vec<(usize, Vec<Vec<f64>>)> = Vec::new();
    for row in others {
        let left = spans.iter().zip(matrices);
        let left = left.map(|(span, rows)| span.left_of(&rows[row], length, tolerance));
        if let Some(left) = left.collect() {
            rest.push((row, left));
        }
    }
    let passes = PASSES[1..].iter().copied().filter(|&pass| pass > tolerance);
    for threshold in passes.chain([tolerance]) {
        let mut place = 0;
        while place < rest.len() {
            let stands_out = |left: &[Vec<f64>]| left.iter().all(|vector| norm(vector) > threshold);
            let (_, left) = &mut rest[place];
            let mut is_taken = stands_out(left);
            if is_taken {
                for (vector, span) in left.iter_mut().zip(&spans) {
                    for direction in &span.directions {
                        direction.remove_from(vector);
                    }
                }
                is_taken = stands_out(left);
            }
            if !is_taken {
                place += 1;
                continue;
            }
            let (row, left) = rest.remove(place);
            taken.push(row);
            for (number, (vector, span)) in left.iter().zip(&mut spans).enumerate() {
                let direction = Direction::of(vector, norm(vector));
                for (_, others) in &mut rest {
                    direction.remove_from(&mut others[number]);
                }
                span.directions.push(direction);
            }
        }
    }
    (taken, spans)
}

/// Adds a row to what is spanned if it stands out in each matrix; whether it does.
fn takes<'a>(spans: &mut [Span<'a>], matrices: &'a [Rows], row: usize, clear: f64) -> bool {
    let mut found = Vec::with_capacity(spans.len());
    for (span, rows) in spans.iter_mut().zip(matrices) {
        let reduced = span.normal.reduced(&rows[row], 0.0);
        // Not so of what is no number.
        let stands_out = reduced.square > clear * clear;
        if !stands_out {
            return false;
        }
        found.push(reduced);
    }
    for ((span, rows), reduced) in spans.iter_mut().zip(matrices).zip(found) {
        span.normal.push(&rows[row], reduced);
        span.rows.push(&rows[row]);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(row: &[f64]) -> Row {
        let mut row = Row::of(row);
        row.scale(row.norm().recip());
        row
    }

    #[test]
    fn what_follows_from_others_is_left_out() {
        let rows = vec![
            unit(&[1.0, 2.0, 0.0, 0.0]),
            Row::default(),
            unit(&[2.0, 4.0, 0.0, 0.0]),
            unit(&[0.0, 1.0, 3.0, 0.0]),
            unit(&[1.0, 3.0, 3.0, 0.0]),
            unit(&[0.0, 0.0, 0.0, -1.0]),
        ];
        assert_eq!(independent(&[rows], 1e-7), [0, 3, 5]);
        assert_eq!(independent(&[], 1e-7), [0; 0]);
        assert_eq!(independent(&[Rows::new()], 1e-7), [0; 0]);
    }

    #[test]
    fn what_is_clearly_independent_is_taken_first() {
        let rows = vec![unit(&[1.0, 0.0]), unit(&[1.0, 1e-3]), unit(&[1.0, 1.0])];
        assert_eq!(independent(&[rows], 1e-7), [0, 2]);
        let near = vec![unit(&[1.0, 0.0]), unit(&[1.0, 1e-5])];
        assert_eq!(independent(std::slice::from_ref(&near), 1e-7), [0, 1]);
        assert_eq!(independent(&[near], 1e-4), [0]);
    }

    #[test]
    fn a_row_must_be_independent_in_every_matrix() {
        let (x, y) = (unit(&[1.0, 0.0]), unit(&[0.0, 1.0]));
        let first = vec![x.clone(), y.clone(), unit(&[1.0, 1.0])];
        let second = vec![x.clone(), x, y];
        assert_eq!(independent(&[first, second], 1e-7), [0, 2]);
    }

    #[test]
    fn a_hilbert_matrix_has_the_rank_that_the_tolerance_sees() {
        let rows: Rows = (1..=10)
            .map(|i| {
                unit(
                    &(0..10)
                        .map(|j| 1.0 / f64::from(i + j))
                        .collect::<Vec<f64>>(),
                )
            })
            .collect();
        let counts = [1e-1, 1e-3, 1e-5, 1e-7]
            .map(|tolerance| independent(std::slice::from_ref(&rows), tolerance).len());
        assert!(
            counts.is_sorted() && counts[0] >= 2 && counts[3] <= 8,
            "{counts:?}"
        );
    }

    /// With rows that stand out clearly and others that hardly do.
    #[test]
    fn nothing_is_left_along_what_is_spanned() {
        let rows = vec![
            unit(&[1.0, 0.0, 2.0, 0.0, 0.0]),
            unit(&[1.0, 1e-3, 2.0, 0.0, 0.0]),
            unit(&[0.0, 1.0, 1.0, 0.0, 0.0]),
            unit(&[0.0, 1.0, 1.0, 1e-5, 0.0]),
        ];
        let span = Span::of(&rows, 1e-7);
        let mut vector = [0.3, -0.4, 0.5, 0.6, 0.7];
        span.remove_from(&mut vector);
        for row in &rows {
            assert!(row.along(&vector).abs() < 1e-15);
        }
        assert_eq!(vector[4], 0.7);
        assert!(
            norm(&vector[..4]) < 1e-10,
            "four rows span the first four places"
        );
    }
}
