//! Where kept rows depend on each other although all rows together do not: a choice of rows that
//! is not sound all along a motion.

use super::TOLERANCE;
use super::motion::{Configuration, Constraints};
use super::normal::Normal;
use super::span::independent;
use super::sparse::Rows;
use crate::model::BodyKind;

/// By how much of their length rows stand out from each other far from a singular configuration.
const REGULAR: f64 = 0.01;
/// What is left of the volume of the kept rows where they depend on each other.
const VANISHES: f64 = 1e-5;
/// Steps of the golden section.
const STEPS: usize = 40;
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Whether kept rows depend on each other at a configuration on a way where others do not.
pub(super) fn is_lost(constraints: &Constraints, way: &[Configuration], kept: &[usize]) -> bool {
    let volumes: Vec<f64> = way
        .iter()
        .map(|at| volume(constraints, at, kept).unwrap_or(0.0))
        .collect();
    let largest = volumes.iter().fold(0.0_f64, |most, x| most.max(*x));
    let smallest = (0..way.len()).min_by(|&a, &b| volumes[a].total_cmp(&volumes[b]));
    let Some(near) = smallest else { return false };
    let (first, last) = (near.saturating_sub(1), (near + 1).min(way.len() - 1));
    let found = [(first, near), (near, last)].map(|(a, b)| {
        let at = least(constraints, [&way[a], &way[b]], kept)?;
        let rows = constraints.directions(&at, TOLERANCE)?;
        let is_small = volume(constraints, &at, kept)? < VANISHES * largest;
        Some(is_small && independent(&[rows], REGULAR).len() == kept.len())
    });
    found.contains(&Some(true))
}

/// The volume that kept rows span.
fn volume(constraints: &Constraints, at: &Configuration, kept: &[usize]) -> Option<f64> {
    let rows = constraints.directions(at, TOLERANCE)?;
    let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
    Some(Normal::new(&basis, 0.0)?.diagonal().iter().product())
}

/// Where the volume is least between two configurations.
fn least(
    constraints: &Constraints,
    [from, to]: [&Configuration; 2],
    kept: &[usize],
) -> Option<Configuration> {
    let at = |share: f64| constraints.assembled(&between(constraints, from, to, share));
    let size = |at: &Configuration| volume(constraints, at, kept).unwrap_or(0.0);
    let (mut low, mut high) = (0.0, 1.0);
    let (mut a, mut b) = (1.0 - GOLDEN, GOLDEN);
    let (mut of_a, mut of_b) = (size(&at(a)?), size(&at(b)?));
    for _ in 0..STEPS {
        if of_a < of_b {
            (high, b, of_b) = (b, a, of_a);
            a = high - GOLDEN * (high - low);
            of_a = size(&at(a)?);
        } else {
            (low, a, of_a) = (a, b, of_b);
            b = low + GOLDEN * (high - low);
            of_b = size(&at(b)?);
        }
    }
    at(0.5 * (low + high))
}

/// A configuration between two neighbours, not on the constraints.
fn between(
    constraints: &Constraints,
    from: &Configuration,
    to: &Configuration,
    share: f64,
) -> Configuration {
    let mut at = from.clone();
    for (x, y) in at.coordinates.iter_mut().zip(&to.coordinates) {
        *x += share * (y - *x);
    }
    for body in 0..constraints.bodies() {
        if constraints.kind(body) == BodyKind::Rigid {
            let (position, p) = constraints.pose(&at, body);
            let length = p.iter().map(|e| e * e).sum::<f64>().sqrt();
            constraints.place(&mut at, body, (position, p.map(|e| e / length)));
        }
    }
    at
}
