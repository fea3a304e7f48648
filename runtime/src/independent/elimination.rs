//! Gauss-Jordan elimination with the largest pivots first.

use crate::math::scalar::{Real, Scalar};
use crate::state::vector::Array;

/// A system of linear equations, which may lack rank.
///
/// Rows and columns have scales of their own: an entry counts by its share of the size of its row
/// over the unit of its column. A row of size zero takes no part.
pub(super) struct Elimination<'a, S> {
    /// The matrix, row by row.
    pub(super) entries: &'a mut [S],
    pub(super) width: usize,
    /// The size of every row.
    pub(super) sizes: &'a [S],
    /// Of a column with a pivot its row, one higher; zero of another.
    pub(super) row_of: &'a mut [S],
    /// A share below which an entry is no pivot.
    pub(super) least: f64,
}

/// A pivot: its share of the size of its row, and where it stands.
#[derive(Clone, Copy)]
pub(super) struct Pivot {
    pub(super) share: f64,
    pub(super) row: usize,
    pub(super) column: usize,
    /// The product of the shares of all pivots: the determinant.
    pub(super) volume: f64,
}

impl<S: Real> Elimination<'_, S> {
    /// Reduces matrix and right-hand sides until each column with a pivot has nothing else. The
    /// least pivot; `None` without any.
    pub(super) fn run<const R: usize>(
        &mut self,
        mut rights: [&mut [S]; R],
        unit: impl Fn(usize) -> S,
        is_unknown: impl Fn(usize) -> bool,
    ) -> Option<Pivot> {
        let (mut weakest, mut volume): (Option<Pivot>, f64) = (None, 1.0);
        let (width, height) = (self.width, self.sizes.len());
        loop {
            let mut best = (self.least, None);
            for row in (0..height).filter(|&row| !self.is_taken(row)) {
                let size = at(self.sizes, row).abs().to_f64();
                let open = |column: &usize| is_unknown(*column) && self.row(*column).is_none();
                for column in (0..width).filter(open) {
                    let entry = at(self.entries, row * width + column) * unit(column);
                    let share = entry.abs().to_f64() / size;
                    if share > best.0 {
                        best = (share, Some((row, column)));
                    }
                }
            }
            let Some((row, column)) = best.1 else {
                break weakest.map(|weakest| Pivot { volume, ..weakest });
            };
            volume *= best.0;
            if weakest.is_none_or(|weakest| best.0 < weakest.share) {
                weakest = Some(Pivot {
                    share: best.0,
                    row,
                    column,
                    volume,
                });
            }
            if let Some(place) = self.row_of.get_mut(column) {
                *place = S::constant(row as f64 + 1.0);
            }
            let inverse = at(self.entries, row * width + column).reciprocal();
            for other in (0..height).filter(|&other| other != row) {
                let factor = at(self.entries, other * width + column) * inverse;
                // With its derivatives, which need not vanish with it.
                if factor == S::zero() {
                    continue;
                }
                for place in 0..width {
                    let subtracted = factor * at(self.entries, row * width + place);
                    subtract(self.entries, other * width + place, subtracted);
                }
                for right in &mut rights {
                    let subtracted = factor * at(right, row);
                    subtract(right, other, subtracted);
                }
                // Exactly, so that it is not taken again.
                if let Some(entry) = self.entries.get_mut(other * width + column) {
                    *entry = S::zero();
                }
            }
        }
    }

    /// The row of a column's pivot.
    pub(super) fn row(&self, column: usize) -> Option<usize> {
        (at(self.row_of, column).abs().to_f64() as usize).checked_sub(1)
    }

    /// Whether a row has a pivot.
    pub(super) fn is_taken(&self, row: usize) -> bool {
        (0..self.width).any(|column| self.row(column) == Some(row))
    }

    /// What is left of a matrix entry.
    pub(super) fn entry(&self, row: usize, column: usize) -> S {
        at(self.entries, row * self.width + column)
    }

    /// The value of an unknown, by what is left of a right-hand side; zero without a pivot.
    pub(super) fn solution(&self, column: usize, right: &[S]) -> S {
        self.row(column).map_or(S::zero(), |row| {
            at(right, row) * self.entry(row, column).reciprocal()
        })
    }
}

/// An element; zero where there is none.
pub(super) fn at<S: Scalar>(numbers: &[S], place: usize) -> S {
    numbers.get(place).copied().unwrap_or(S::zero())
}

pub(super) fn set<S: Scalar, A: Array<S>>(numbers: &mut A, place: usize, value: S) {
    if let Some(number) = numbers.as_mut_slice().get_mut(place) {
        *number = value;
    }
}

fn subtract<S: Real>(numbers: &mut [S], place: usize, value: S) {
    if let Some(number) = numbers.get_mut(place) {
        *number = *number - value;
    }
}
