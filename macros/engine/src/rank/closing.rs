//! Which equations close loops: those of other joints are not in question, because coordinates
//! satisfy them by themselves.

use super::dense::{Direction, norm};
use super::limits::TOLERANCE;
use super::motion::{Configuration, Constraints};
use super::random::Random;
use super::span::{Span, independent};
use super::sparse::{Row, Rows};
use super::walk::walk;
use super::{choice, sweep};
use crate::model::Model;

/// The equations, by joint and place, of the given joints that follow from those of all others and
/// of each other. Of a model without dropped equations that no equation of contradicts another;
/// `None` where nothing can be told, because of numbers that the macro cannot see.
pub(crate) fn following(model: &Model, closing: &[usize]) -> Option<Vec<(usize, usize)>> {
    let mut random = Random::new();
    let (constraints, described) = Constraints::new(model, |velocities| random.motion(velocities))?;
    let start = constraints.assembled(&described)?;
    let mut configurations = walk(&constraints, start.clone(), None, &mut random);
    let mut way = Vec::new();
    if constraints.is_driven() {
        let passage = sweep::in_time(&constraints, &start, |_| None);
        way = passage.reached[..passage.followed].to_vec();
        configurations.extend(passage.reached);
    }
    let layout = model.layout();
    let is_closing: Vec<bool> = (0..layout.rows)
        .map(|row| closing.contains(&layout.place_of(row).0))
        .collect();
    let stands_out = |rows: &Rows| beside(rows, layout.velocities, &is_closing);
    let directions = configurations
        .iter()
        .map(|at| constraints.directions(at, TOLERANCE));
    let directions: Option<Vec<Rows>> = directions.collect();
    let left: Vec<Rows> = directions?.iter().map(stands_out).collect();
    let sets: Vec<Vec<usize>> = left
        .iter()
        .map(|rows| independent(std::slice::from_ref(rows), TOLERANCE))
        .collect();
    let rank = sets.iter().map(Vec::len).max()?;
    let regular: Vec<usize> = (0..sets.len()).filter(|&k| sets[k].len() == rank).collect();
    let among: Vec<Rows> = regular.iter().map(|&k| left[k].clone()).collect();
    let mut kept = independent(&among, TOLERANCE);
    if kept.len() < rank {
        kept.clone_from(&sets[*regular.first()?]);
    }
    let rows: Vec<usize> = (0..layout.rows).filter(|&row| is_closing[row]).collect();
    if rank < rows.len() {
        let way = way
            .iter()
            .filter_map(|at| constraints.directions(at, TOLERANCE));
        let sweep = sweep::both_ways(&constraints, &start, None, &mut random).with(way.collect());
        let sweep: Vec<Rows> = sweep.iter().map(stands_out).collect();
        kept = choice::steady(kept, &sweep, TOLERANCE);
    }
    let following = (0..rows.len()).filter(|place| !kept.contains(place));
    Some(
        following
            .map(|place| layout.place_of(rows[place]))
            .collect(),
    )
}

/// Times and coordinates of the bodies along a motion that the constraints leave free, from the
/// reference configuration on; none where nothing can be told. Typical values of parameters do not
/// tell where a mechanism with other values gets to.
pub(crate) fn stops(model: &Model) -> Vec<Place> {
    if !model.independence.likes.is_empty() {
        return Vec::new();
    }
    if !model.independence.sweep.is_empty() {
        return model.independence.sweep.clone();
    }
    let mut random = Random::new();
    let constraints = Constraints::new(model, |velocities| random.motion(velocities));
    let Some((constraints, described)) = constraints else {
        return Vec::new();
    };
    let Some(start) = constraints.assembled(&described) else {
        return Vec::new();
    };
    let heading = random.motion(model.layout().velocities);
    let stops = sweep::stops(&constraints, &start, heading, None).into_iter();
    stops.map(|(at, _)| (at.time, at.coordinates)).collect()
}

/// Time and coordinates of the bodies.
pub(crate) type Place = (f64, Vec<f64>);

/// What the constraints leave free at a time.
pub(crate) struct Free(Constraints);

impl Free {
    /// That of a model without dropped equations; `None` where nothing can be told.
    pub(crate) fn of(model: &Model) -> Option<Self> {
        let mut random = Random::new();
        let constraints = Constraints::new(model, |velocities| random.motion(velocities));
        constraints.map(|(constraints, _)| Self(constraints))
    }

    pub(super) fn constraints(&self) -> &Constraints {
        &self.0
    }

    /// Motions of unit length and at right angles that span what is free.
    pub(crate) fn motions(&self, at: &Place) -> Vec<Vec<f64>> {
        let mut found: Vec<Direction> = Vec::new();
        let rows = self.0.directions(&at.into(), TOLERANCE);
        let span = rows.as_ref().map(|rows| Span::of(rows, TOLERANCE));
        let mut random = Random::new();
        while let Some(span) = &span {
            let mut motion = random.motion(self.0.velocities());
            let least = TOLERANCE * norm(&motion);
            span.remove_from(&mut motion);
            for direction in found.iter().chain(&found) {
                direction.remove_from(&mut motion);
            }
            let left = norm(&motion);
            if left <= least {
                break;
            }
            found.push(Direction::of(&motion, left));
        }
        found
            .into_iter()
            .map(|direction| direction.values)
            .collect()
    }

    /// Another place after a motion, straight on.
    pub(crate) fn moved(&self, at: &Place, motion: &[f64]) -> Place {
        let moved = self.0.moved(&at.into(), motion);
        (moved.time, moved.coordinates)
    }

    /// The place on the constraints that a motion leads to, if it does.
    pub(crate) fn reached(&self, at: &Place, motion: &[f64]) -> Option<Place> {
        let reached = self.0.assembled(&self.0.moved(&at.into(), motion));
        reached.map(|reached| (reached.time, reached.coordinates))
    }
}

impl From<&Place> for Configuration {
    fn from((time, coordinates): &Place) -> Self {
        Self {
            coordinates: coordinates.clone(),
            time: *time,
        }
    }
}

/// What is left of the rows that close loops beside all others.
fn beside(rows: &Rows, velocities: usize, is_closing: &[bool]) -> Rows {
    let of = |wanted: bool| -> Rows {
        let rows = rows.iter().zip(is_closing);
        let rows = rows.filter(|(_, is_closing)| **is_closing == wanted);
        rows.map(|(row, _)| row.clone()).collect()
    };
    let others = of(false);
    let others = Span::of(&others, TOLERANCE);
    let rest = of(true).into_iter().map(|row| {
        let mut row = row.dense(velocities);
        others.remove_from(&mut row);
        Row::of(&row)
    });
    rest.collect()
}
