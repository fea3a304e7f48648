//! Which velocities rows determine whatever the configuration is: by an entry that is a number.
//!
//! This needs no numbers of the mechanism, so it serves where the macro cannot see them, and where
//! nothing can move but by its drivers. The driver of a hinge determines the hinge's velocity, the
//! closing joint of a slider-crank that of the slide.

use super::stops::{ROUND_OFF, STEADY, shared};
use crate::plan::Pivot;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;

/// The velocities with the rows that determine them, in the order of elimination, and the entries.
/// Velocities count from 0, rows from the number of velocities. `alike` is `Links::alike`.
pub(super) fn certain(
    arena: &Arena,
    rows: &[Vec<Expr>],
    alike: &[usize],
) -> (Vec<Pivot>, Vec<f64>) {
    let mut left = Left {
        arena: arena.clone(),
        rows: rows.iter().cloned().map(Some).collect(),
        made_of: rows.iter().map(|row| largest(arena, row)).collect(),
        alike,
    };
    let (mut pivots, mut entries) = (Vec::new(), Vec::new());
    while let Some((row, velocity, entry)) = left.best() {
        pivots.push(Pivot::Dependent(velocity, rows[row].len() + row));
        entries.push(entry);
        left.eliminate(row, velocity);
    }
    (pivots, entries)
}

/// The rows that are not taken yet, without the velocities that are.
struct Left<'a> {
    arena: Arena,
    rows: Vec<Option<Vec<Expr>>>,
    /// About the largest number that each row is made of. A number that is round-off may be the
    /// only one of its row and its column.
    made_of: Vec<f64>,
    alike: &'a [usize],
}

impl Left<'_> {
    /// The entry, with its row and its velocity, that the fewest other rows know of.
    fn best(&self) -> Option<(usize, usize, f64)> {
        let mut best: Option<(usize, (usize, usize, f64))> = None;
        let sizes = self.sizes();
        for (place, row) in self.rows.iter().enumerate() {
            let Some(row) = row else { continue };
            let numbers: Vec<Option<f64>> =
                row.iter().map(|&entry| self.arena.literal(entry)).collect();
            let size = |k: usize, number: f64| number.abs() / sizes[k];
            let known = numbers.iter().enumerate();
            let known = known.filter_map(|(k, number)| number.map(|number| size(k, number)));
            let largest = known.fold(0.0, f64::max);
            for (k, number) in numbers.iter().enumerate() {
                let Some(number) = *number else { continue };
                // Round-off is a number as well.
                if number.abs() <= ROUND_OFF * self.made_of[place] {
                    continue;
                }
                if size(k, number) < STEADY * largest {
                    continue;
                }
                let others = self.others(place, k);
                if best.is_none_or(|(fewest, _)| others < fewest) {
                    best = Some((others, (place, k, number)));
                }
            }
        }
        best.map(|(_, found)| found)
    }

    /// The largest number of each column and of those alike, 1 where there is none: lengths and
    /// angles have different units.
    fn sizes(&self) -> Vec<f64> {
        let largest = |velocity: usize| {
            let column = self.rows.iter().flatten().map(|row| row[velocity]);
            let numbers = column.filter_map(|entry| self.arena.literal(entry));
            numbers.fold(0.0, |largest: f64, number| largest.max(number.abs()))
        };
        let sizes: Vec<f64> = (0..self.alike.len()).map(largest).collect();
        shared(&sizes, self.alike)
            .map(|size| if size > 0.0 { size } else { 1.0 })
            .collect()
    }

    /// How many other rows know of a velocity.
    fn others(&self, row: usize, velocity: usize) -> usize {
        let rows = self.rows.iter().enumerate();
        let knowing = rows.filter(|(place, other)| {
            let knows = |other: &Vec<Expr>| other[velocity] != Arena::ZERO;
            *place != row && other.as_ref().is_some_and(knows)
        });
        knowing.count()
    }

    /// Puts what the velocity follows from into the other rows.
    fn eliminate(&mut self, row: usize, velocity: usize) {
        let Some(chosen) = self.rows[row].take() else {
            return;
        };
        let arena = &mut self.arena;
        for (place, other) in self.rows.iter_mut().enumerate() {
            let Some(other) = other.as_mut().filter(|row| row[velocity] != Arena::ZERO) else {
                continue;
            };
            let share = arena.div(other[velocity], chosen[velocity]);
            let taken = largest(arena, &[share]) * self.made_of[row];
            self.made_of[place] = self.made_of[place].max(taken);
            for (entry, &by) in other.iter_mut().zip(&chosen) {
                let change = arena.mul(share, by);
                *entry = arena.sub(*entry, change);
            }
            other[velocity] = Arena::ZERO;
        }
    }
}

/// About the size of the largest entry. Nothing need be known of the mechanism for that: the inputs
/// are numbers without a pattern.
fn largest(arena: &Arena, entries: &[Expr]) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let values = evaluate(arena, entries, |input| match input {
        Input::Coordinate(place) => Some((GOLDEN * (f64::from(place) + 1.0)).fract()),
        _ => Some(GOLDEN),
    });
    let sizes = values.into_iter().flatten().map(f64::abs);
    sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
}
