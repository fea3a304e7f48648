//! Whether equations whose rows depend on others say the same as those, at all times.
//!
//! Where the rows of `D` depend on the kept ones all over the configurations that satisfy these, an
//! equation is constant there: it holds everywhere, or nowhere. With a time in the equations it
//! must hold at all times, so that the speeds that it asks for must be those that the kept ones ask
//! for: `Y^T Phi_t = 0` where `Y^T D = 0`.

use super::limits::TOLERANCE;
use super::motion::{Configuration, Constraints};
use super::normal::Normal;
use super::random::Random;
use super::span::independent;
use super::sparse::Rows;
use super::walk::walk;

/// To what fraction of themselves laws agree that are given to seven digits, as [`TOLERANCE`] has
/// it for lengths.
const AGREEMENT: f64 = 10.0 * TOLERANCE;
/// Speeds below this fraction of the largest are what configurations leave of none: they are good
/// to [`super::assemble::ASSEMBLED`].
const STILL: f64 = super::assemble::ASSEMBLED;
/// A short time (s): mechanisms are about where they were.
const SOON: f64 = 0.01;
/// By how much of their length kept rows stand out from each other where speeds can be compared.
const SOUND: f64 = 1e-3;

/// A row that contradicts the kept ones.
pub(super) struct Contradicted {
    pub(super) row: usize,
    /// When it is seen (s).
    pub(super) time: f64,
    /// Whether it holds then and asks for another speed.
    pub(super) by_speed: bool,
    /// Where it is seen: coordinates.
    pub(super) at: Vec<f64>,
}

/// The largest violation that counts as none: laws over long ways have as many digits as those over
/// short ones.
fn bound(constraints: &Constraints, start: &Configuration, time: f64) -> f64 {
    let way = constraints.violations(&start.at(time));
    let way = way
        .iter()
        .flatten()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    AGREEMENT * (1.0 + way)
}

/// The rows that are violated by more than counts as none, behind their violations.
fn violated(
    constraints: &Constraints,
    start: &Configuration,
    here: &Configuration,
) -> Option<Vec<usize>> {
    let bound = bound(constraints, start, here.time);
    let violations = constraints.violations(here)?;
    let violated = violations.iter().enumerate();
    Some(
        violated
            .filter(|(_, violation)| violation.abs() > bound)
            .map(|(row, _)| row)
            .collect(),
    )
}

/// A configuration of the kept rows near another where all others hold as well, to what laws are
/// given to.
pub(super) fn agreeing(
    constraints: &Constraints,
    start: &Configuration,
    kept: &[usize],
    near: &Configuration,
) -> Option<Configuration> {
    let here = constraints.assembled_of(near, Some(kept))?;
    violated(constraints, start, &here)?
        .is_empty()
        .then_some(here)
}

/// The rows that do not hold where motions lead to that the kept ones leave free, from a
/// configuration where all hold: they depend on the kept ones there by chance, as constraints do
/// that touch each other.
pub(super) fn by_chance(
    constraints: &Constraints,
    start: &Configuration,
    kept: &[usize],
    from: &Configuration,
    random: &mut Random,
) -> Vec<usize> {
    let reached = walk(constraints, from.clone(), Some(kept), random);
    let violated = reached
        .iter()
        .filter_map(|at| violated(constraints, start, at));
    let mut rows: Vec<usize> = violated
        .flatten()
        .filter(|row| !kept.contains(row))
        .collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// The rows that do not hold where the kept ones do, near a configuration, although they depend on
/// them: none where the kept ones do not hold either; `None` where rows become independent on the
/// way.
fn by_place(
    constraints: &Constraints,
    start: &Configuration,
    kept: &[usize],
    near: &Configuration,
    random: &mut Random,
) -> Option<Vec<Contradicted>> {
    let Some(here) = constraints.assembled_of(near, Some(kept)) else {
        return Some(Vec::new());
    };
    let violated = violated(constraints, start, &here)?;
    let (time, at_first) = (here.time, here.coordinates.clone());
    for at in walk(constraints, here, Some(kept), random) {
        let rows = constraints.directions(&at, TOLERANCE)?;
        if independent(&[rows], TOLERANCE).len() > kept.len() {
            return None;
        }
    }
    let rows = violated.into_iter().filter(|row| !kept.contains(row));
    let rows = rows.map(|row| Contradicted {
        row,
        time,
        by_speed: false,
        at: at_first.clone(),
    });
    Some(rows.collect())
}

/// What contradicts near a configuration, where none satisfies all equations: the rows, and those
/// that they depend on. These are the kept ones, or others where more rows are independent than
/// anywhere before, as those of a law that only begins.
pub(super) fn where_missed(
    constraints: &Constraints,
    start: &Configuration,
    kept: &[usize],
    near: &Configuration,
    random: &mut Random,
) -> Option<(Vec<Contradicted>, Vec<usize>)> {
    if let Some(found) = by_place(constraints, start, kept, near, random) {
        return Some((found, kept.to_vec()));
    }
    // What only begins has short gradients, and says more soon.
    let places = [near.clone(), near.at(near.time + SOON)];
    let mut said = places
        .iter()
        .filter_map(|near| nowhere(constraints, start, near, random));
    said.find(|(found, _)| !found.is_empty())
}

/// What contradicts near a configuration, where none satisfies all equations and nothing is known
/// of the rows: those that do, and those that they depend on. Which rows are kept is a choice, and
/// one that cannot be satisfied says nothing: so they are taken from the first on and from the last
/// on. What cannot change is a contradiction by itself.
pub(super) fn nowhere(
    constraints: &Constraints,
    start: &Configuration,
    near: &Configuration,
    random: &mut Random,
) -> Option<(Vec<Contradicted>, Vec<usize>)> {
    let choices = [false, true].map(|backwards| {
        let kept = satisfied(constraints, near, backwards, random)?;
        let found = by_place(constraints, start, &kept.0, &kept.1, random)?;
        Some((found, kept.0))
    });
    let mut said = choices.into_iter().flatten();
    said.find(|(found, _)| !found.is_empty()).or_else(|| {
        let rows = violated(constraints, start, near)?.into_iter();
        let fixed = rows.filter(|&row| constraints.sizes[row].is_none());
        let found = fixed.map(|row| Contradicted {
            row,
            time: near.time,
            by_speed: false,
            at: near.coordinates.clone(),
        });
        Some((found.collect(), Vec::new()))
    })
}

/// As many independent rows as can be found near a configuration, and where they hold; `None` where
/// they do not.
fn satisfied(
    constraints: &Constraints,
    near: &Configuration,
    backwards: bool,
    random: &mut Random,
) -> Option<(Vec<usize>, Configuration)> {
    let independent_rows = |mut rows: Rows| {
        if !backwards {
            return independent(&[rows], TOLERANCE);
        }
        let last = rows.len().saturating_sub(1);
        rows.reverse();
        let mut found = independent(&[rows], TOLERANCE);
        found.iter_mut().for_each(|row| *row = last - *row);
        found.sort_unstable();
        found
    };
    let mut rows = constraints.directions(near, TOLERANCE)?;
    let mut here = near.clone();
    let mut kept: Vec<usize> = Vec::new();
    loop {
        let more = independent_rows(rows);
        if more.len() <= kept.len() {
            return Some((kept, here));
        }
        // Rows may be independent at a configuration that satisfies those found so far.
        kept = more;
        here = constraints.assembled_of(&here, Some(&kept))?;
        let mut best = (0, Rows::new());
        for at in walk(constraints, here.clone(), Some(&kept), random) {
            let rows = constraints.directions(&at, TOLERANCE)?;
            let rank = independent(std::slice::from_ref(&rows), TOLERANCE).len();
            if rank > best.0 {
                best = (rank, rows);
            }
        }
        rows = best.1;
    }
}

/// The rows that ask for other speeds than the kept ones do, at the first of some configurations
/// where one does.
pub(super) fn by_speed(
    constraints: &Constraints,
    configurations: &[Configuration],
    directions: &[Rows],
    kept: &[usize],
) -> Vec<Contradicted> {
    let demands: Vec<Vec<f64>> = configurations
        .iter()
        .map(|at| constraints.demands(at, TOLERANCE).unwrap_or_default())
        .collect();
    let largest = demands
        .iter()
        .flatten()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    for ((at, rows), demands) in configurations.iter().zip(directions).zip(&demands) {
        let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
        if demands.len() != rows.len()
            || independent(std::slice::from_ref(&basis), SOUND).len() < kept.len()
        {
            continue;
        }
        let Some(normal) = Normal::new(&basis, 0.0) else {
            continue;
        };
        let disagrees = |&row: &usize| {
            let shares = normal.solve(&normal.products(&rows[row]));
            let parts = shares
                .iter()
                .zip(kept)
                .map(|(share, &row)| share * demands[row]);
            let parts: Vec<f64> = parts.collect();
            let difference = demands[row] - parts.iter().sum::<f64>();
            let size = demands[row].abs() + parts.iter().map(|part| part.abs()).sum::<f64>();
            rows[row].norm() > 0.0 && difference.abs() > AGREEMENT * size + STILL * largest
        };
        let found: Vec<Contradicted> = (0..rows.len())
            .filter(|row| !kept.contains(row))
            .filter(disagrees)
            .map(|row| Contradicted {
                row,
                time: at.time,
                by_speed: true,
                at: at.coordinates.clone(),
            })
            .collect();
        if !found.is_empty() {
            return found;
        }
    }
    Vec::new()
}
