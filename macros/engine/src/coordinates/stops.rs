//! Rows of closing joints as numbers: along a sweep of the mechanism, and where else it gets to.

use super::beginning::Beginning;
use super::from_bodies::from_bodies;
use super::links::Links;
use crate::rank::closing::Place;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;

/// Where the volume falls to this fraction of the largest along a sweep, the mechanism is near a
/// singular position, and no choice is better than another.
pub(super) const SINGULAR: f64 = 1e-3;

/// A determinant that falls to this fraction of the volume that its rows span is not relied on.
pub(super) const STEADY: f64 = 0.1;
/// An entry below this fraction of the largest of its row is round-off.
pub(super) const ROUND_OFF: f64 = 1e-12;
/// Rows of `D` at a stop of a sweep, each about as large on free bodies as at others.
pub(super) struct Stop {
    pub(super) rows: Vec<Vec<f64>>,
    /// What each row was multiplied by for that.
    pub(super) factors: Vec<f64>,
    /// The largest number that each row is made of. In a singular position a row without the
    /// velocities that others determine may be nothing but round-off.
    pub(super) made_of: Vec<f64>,
    /// Where it is, and the number of the way that it is on.
    pub(super) at: Place,
    pub(super) way: usize,
}

impl Stop {
    pub(super) fn new(mut rows: Vec<Vec<f64>>, factors: Vec<f64>, at: Place, way: usize) -> Self {
        for (row, factor) in rows.iter_mut().zip(&factors) {
            row.iter_mut().for_each(|entry| *entry *= factor);
        }
        let made_of = rows.iter().map(|row| largest(row).abs()).collect();
        Self {
            rows,
            factors,
            made_of,
            at,
            way,
        }
    }
}

/// Whether a share vanishes between two stops. In a singular position all shares change their signs
/// at once, and keep their sizes.
pub(super) fn passes_zero(before: f64, behind: f64) -> bool {
    before * behind < 0.0 && before.abs() + behind.abs() < 1.0
}

/// The largest number of those of one kind, in the place of each.
pub(super) fn shared(sizes: &[f64], alike: &[usize]) -> impl Iterator<Item = f64> {
    let of = move |kind: &usize| {
        let pairs = sizes.iter().zip(alike);
        let of_kind = pairs.filter(|(_, other)| *other == kind);
        of_kind.fold(0.0, |largest: f64, (&size, _)| largest.max(size))
    };
    alike.iter().map(of)
}

/// The inputs of some stops of a sweep, the first of which is the reference configuration; none
/// where nothing can move or be told.
#[must_use]
pub(super) fn sweep(arena: &Arena, beginning: &Beginning<'_>, links: &Links) -> Vec<Place> {
    let mut arena = arena.clone();
    let outputs = from_bodies(&mut arena, beginning.model, links);
    let count = outputs.len() - links.velocities;
    let stops = beginning.stops().iter().map(|(time, coordinates)| {
        let values = evaluate(&arena, &outputs[..count], |input| match input {
            Input::Coordinate(place) => coordinates.get(place as usize).copied(),
            Input::Velocity(_) => Some(0.0),
            Input::Time => Some(*time),
            _ => None,
        });
        let values: Option<Vec<f64>> = values.into_iter().collect();
        values.map(|values| (*time, values))
    });
    stops.collect::<Option<Vec<_>>>().unwrap_or_default()
}

/// Rows, and what they are on free bodies where that is known.
type Values = (Vec<Vec<f64>>, Vec<Option<f64>>);

/// Rows, what they are on free bodies, and the median of that along a sweep.
pub(super) struct Numbers<'a> {
    arena: &'a Arena,
    rows: Vec<Expr>,
    width: usize,
    mobilities: &'a [Expr],
    medians: Vec<Option<f64>>,
}

impl<'a> Numbers<'a> {
    pub(super) fn new(arena: &'a Arena, rows: &[Vec<Expr>], mobilities: &'a [Expr]) -> Self {
        Self {
            arena,
            rows: rows.iter().flatten().copied().collect(),
            width: rows.first().map_or(1, |row| row.len().max(1)),
            mobilities,
            medians: Vec::new(),
        }
    }

    /// The rows and what they are on free bodies, at joint coordinates.
    pub(super) fn at(&self, (time, coordinates): &Place) -> Option<Values> {
        let known = |input| match input {
            Input::Coordinate(place) => coordinates.get(place as usize).copied(),
            Input::Time => Some(*time),
            _ => None,
        };
        let values: Option<Vec<f64>> = evaluate(self.arena, &self.rows, known)
            .into_iter()
            .collect();
        // Any masses will do.
        let free = evaluate(self.arena, self.mobilities, |input| match input {
            Input::Symbol(_) | Input::Varying(_) => Some(1.0),
            input => known(input),
        });
        let rows = values?.chunks(self.width).map(<[f64]>::to_vec).collect();
        Some((rows, free))
    }

    /// The stops of a sweep, each row about as large as at the median one. Places are those of the
    /// bodies.
    pub(super) fn along(&mut self, sweep: &[Place], places: &[Place]) -> Option<Vec<Stop>> {
        let values: Option<Vec<_>> = sweep.iter().map(|at| self.at(at)).collect();
        let values = values?;
        let of_row = |row: usize| values.iter().map(move |(_, free)| free[row]);
        self.medians = (0..self.mobilities.len())
            .map(|row| median(of_row(row)))
            .collect();
        let stops = values.into_iter().zip(places);
        let stops = stops.map(|((rows, free), place)| self.stop(rows, &free, place, 0));
        Some(stops.collect())
    }

    /// A stop of a way.
    pub(super) fn stop(
        &self,
        rows: Vec<Vec<f64>>,
        free: &[Option<f64>],
        at: &Place,
        way: usize,
    ) -> Stop {
        let factors = free.iter().zip(&self.medians);
        let factors = factors.map(|(&mobility, &median)| factor(mobility, median));
        Stop::new(rows, factors.collect(), at.clone(), way)
    }
}

fn known_size(mobility: Option<f64>) -> Option<f64> {
    mobility.filter(|m| m.is_finite() && *m > 0.0)
}

fn median(mobilities: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let mut sizes: Vec<f64> = mobilities.filter_map(known_size).collect();
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied()
}

/// The factor by which a row is about as large on free bodies as at the median stop, from its
/// mobilities. An equation means the same if it is multiplied by a number. But where an angle
/// is hardly defined, its row grows without bound, and other stops would look singular beside that
/// one. A row that nearly vanishes by itself is singular and keeps its size. Powers of two change
/// no digit.
fn factor(mobility: Option<f64>, median: Option<f64>) -> f64 {
    match (known_size(mobility), median) {
        (Some(mobility), Some(median)) if mobility > SINGULAR.powi(2) * median => {
            let doublings = (median / mobility).sqrt().log2().round();
            2.0_f64.powi(doublings as i32)
        }
        _ => 1.0,
    }
}

/// The value of largest magnitude.
pub(super) fn largest(values: &[f64]) -> f64 {
    let mut largest = 0.0_f64;
    for &value in values {
        if value.abs() >= largest.abs() {
            largest = value;
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::{factor, median};

    #[test]
    fn rows_are_about_as_large_at_all_stops() {
        let mobilities = [Some(1.0), Some(4.0), Some(1e8), Some(1e-30), None];
        let median = median(mobilities.into_iter());
        let factors = mobilities.map(|mobility| factor(mobility, median));
        assert_eq!(factors, [2.0, 1.0, 2.0_f64.powi(-12), 1.0, 1.0]);
    }
}
