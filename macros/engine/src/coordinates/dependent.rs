//! Which velocities follow from the others where loops are closed: rows of closing joints and velocities that are eliminated together.
//!
//! A row that determines a velocity leaves no multiplier to solve for. But the velocity must follow from the others wherever the rows are independent, not
//! here and there: so the mechanism is led on a tour, and where some velocities come near to being undetermined by rows that determine others, the rows stay
//! behind.

use super::beginning::Beginning;
use super::from_bodies::from_bodies;
use super::links::Links;
use crate::plan::Pivot;
use crate::symbolic::arena::{Arena, Expr, Input};
use crate::symbolic::evaluate::evaluate;

/// A determinant that falls to this fraction of the volume that its rows span is not relied on.
const STEADY: f64 = 0.1;
/// Where the volume falls to this fraction of the largest along a tour, the mechanism is near a singular position, and no choice is better than another.
const SINGULAR: f64 = 1e-3;
/// An entry below this fraction of the largest of its row is round-off.
const ROUND_OFF: f64 = 1e-12;
/// A tour of fewer stops tells nothing.
const STOPS: usize = 4;

/// Rows of `D` at the stops of a tour, stop by stop.
type Stops = Vec<Vec<Vec<f64>>>;

/// The inputs of some stops of a tour, the first of which is the described configuration; none where nothing can move or be told.
#[must_use]
pub(super) fn tour(
    arena: &Arena,
    beginning: &Beginning<'_>,
    links: &Links,
) -> Vec<(f64, Vec<f64>)> {
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

/// The values of rows at the stops of a tour.
fn values(arena: &Arena, rows: &[Vec<Expr>], tour: &[(f64, Vec<f64>)]) -> Option<Stops> {
    let flat: Vec<Expr> = rows.iter().flatten().copied().collect();
    let stops = tour.iter().map(|(time, coordinates)| {
        let values = evaluate(arena, &flat, |input| match input {
            Input::Coordinate(place) => coordinates.get(place as usize).copied(),
            Input::Time => Some(*time),
            _ => None,
        });
        let values: Option<Vec<f64>> = values.into_iter().collect();
        let width = rows.first().map_or(1, |row| row.len().max(1));
        values.map(|values| values.chunks(width).map(<[f64]>::to_vec).collect())
    });
    stops.collect()
}

/// A way to take rows and velocities together.
#[derive(Clone, Debug)]
struct Candidate {
    rows: Vec<usize>,
    velocities: Vec<usize>,
    /// How many other rows know of the velocities.
    others: usize,
    /// The least determinant along the tour over the volume that the rows span, in columns of like size.
    steady: f64,
    /// At the first stop, or if this is a singular position, the largest.
    determinant: f64,
}

/// What is eliminated before the rest: velocities with the rows that determine them, and the determinants in the described configuration. Velocities
/// count from 0, rows from the number of velocities.
pub(super) fn dependent(
    arena: &Arena,
    rows: &[Vec<Expr>],
    joints: &[usize],
    tour: &[(f64, Vec<f64>)],
) -> (Vec<Pivot>, Vec<f64>) {
    let (mut pivots, mut determinants) = (Vec::new(), Vec::new());
    if tour.len() < STOPS {
        return (pivots, determinants);
    }
    let Some(mut stops) = values(arena, rows, tour) else {
        return (pivots, determinants);
    };
    let mut open: Vec<usize> = (0..rows.len()).collect();
    let sizes = sizes(&stops);
    while let Some(chosen) = best(&stops, &open, joints, &sizes) {
        open.retain(|row| !chosen.rows.contains(row));
        let first = rows[0].len();
        pivots.push(match (&chosen.velocities[..], &chosen.rows[..]) {
            (&[k, l], &[m, n]) => Pivot::Forbidden([k, l], [first + m, first + n]),
            (&[k, ..], &[m, ..]) => Pivot::Dependent(k, first + m),
            _ => unreachable!("a candidate has rows and velocities"),
        });
        determinants.push(chosen.determinant);
        let least = SINGULAR * chosen.determinant.abs();
        stops.retain(|stop| determinant(stop, &chosen.rows, &chosen.velocities).abs() > least);
        for stop in &mut stops {
            eliminate(stop, &open, &chosen);
        }
    }
    (pivots, determinants)
}

/// The candidate that the fewest other rows know of, then the steadiest.
fn best(stops: &Stops, open: &[usize], joints: &[usize], sizes: &[f64]) -> Option<Candidate> {
    stops.first()?;
    let mut best: Option<Candidate> = None;
    for (place, &row) in open.iter().enumerate() {
        let next = open.get(place + 1).copied();
        // Two rows of one joint meet in a determinant that vanishes less often than their entries.
        let next = next.filter(|&next| joints[next] == joints[row]);
        let rows: Vec<usize> = [Some(row), next].into_iter().flatten().collect();
        if rows.len() == 1 && place > 0 && joints[open[place - 1]] == joints[row] {
            continue;
        }
        let known: Vec<usize> = (0..stops[0][row].len())
            .filter(|&k| rows.iter().any(|&row| is_known(stops, row, k)))
            .collect();
        for (number, &k) in known.iter().enumerate() {
            let seconds = if rows.len() == 1 {
                vec![None]
            } else {
                known[number + 1..].iter().map(|&l| Some(l)).collect()
            };
            for second in seconds {
                let velocities: Vec<usize> = [Some(k), second].into_iter().flatten().collect();
                let found = candidate(stops, open, &rows, velocities, sizes);
                // Round-off does not decide between what is alike: the first does.
                let merit = |c: &Candidate| (c.others, -(1e6 * c.steady).round());
                let is_better = best.as_ref().is_none_or(|b| merit(&found) < merit(b));
                if found.steady > STEADY && is_better {
                    best = Some(found);
                }
            }
        }
    }
    best
}

/// Whether a row knows of a velocity: by more than round-off, which looks steady beside itself.
fn is_known(stops: &Stops, row: usize, velocity: usize) -> bool {
    stops.iter().any(|stop| {
        let largest = stop[row]
            .iter()
            .fold(0.0, |most: f64, entry| most.max(entry.abs()));
        stop[row][velocity].abs() > ROUND_OFF * largest
    })
}

fn candidate(
    stops: &Stops,
    open: &[usize],
    rows: &[usize],
    velocities: Vec<usize>,
    sizes: &[f64],
) -> Candidate {
    let others = open.iter().filter(|row| !rows.contains(row));
    let others = others.filter(|&&row| velocities.iter().any(|&k| is_known(stops, row, k)));
    let determinants: Vec<f64> = stops
        .iter()
        .map(|stop| determinant(stop, rows, &velocities))
        .collect();
    let scale: f64 = velocities.iter().map(|&k| sizes[k]).product();
    let volumes: Vec<f64> = stops.iter().map(|stop| volume(stop, rows, sizes)).collect();
    let largest = |values: &[f64]| {
        let largest = values
            .iter()
            .copied()
            .max_by(|a, b| a.abs().total_cmp(&b.abs()));
        largest.unwrap_or(0.0)
    };
    let least = SINGULAR * largest(&volumes);
    let regular = determinants.iter().zip(&volumes);
    let shares: Vec<f64> = regular
        .filter(|(_, volume)| **volume > least)
        .map(|(determinant, volume)| determinant / scale / volume)
        .collect();
    let vanishes = shares.windows(2).any(|pair| passes_zero(pair[0], pair[1]));
    let steady = if vanishes {
        0.0
    } else {
        shares
            .iter()
            .fold(f64::INFINITY, |least, share| least.min(share.abs()))
    };
    let most = largest(&determinants);
    Candidate {
        rows: rows.to_vec(),
        others: others.count(),
        steady: if most == 0.0 { 0.0 } else { steady },
        determinant: if determinants[0].abs() > STEADY * most.abs() {
            determinants[0]
        } else {
            most
        },
        velocities,
    }
}

/// Whether a share vanishes between two stops. In a singular position all shares change their signs at once, and keep their sizes.
fn passes_zero(before: f64, behind: f64) -> bool {
    before * behind < 0.0 && before.abs() + behind.abs() < 1.0
}

/// The largest entry of each column along a tour, 1 where there is none.
fn sizes(stops: &Stops) -> Vec<f64> {
    let mut sizes = vec![
        0.0_f64;
        stops
            .first()
            .and_then(|stop| stop.first())
            .map_or(0, Vec::len)
    ];
    for row in stops.iter().flatten() {
        for (size, entry) in sizes.iter_mut().zip(row) {
            *size = size.max(entry.abs());
        }
    }
    let sizes = sizes.into_iter();
    sizes
        .map(|size| if size > 0.0 { size } else { 1.0 })
        .collect()
}

/// The volume that one or two rows span: the root of the sum of all squared determinants.
fn volume(stop: &[Vec<f64>], rows: &[usize], sizes: &[f64]) -> f64 {
    let scaled = |row: usize| -> Vec<f64> {
        let entries = stop[row].iter().zip(sizes);
        entries.map(|(entry, size)| entry / size).collect()
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let rows: Vec<Vec<f64>> = rows.iter().map(|&row| scaled(row)).collect();
    match &rows[..] {
        [m, n] => (dot(m, m) * dot(n, n) - dot(m, n).powi(2)).max(0.0).sqrt(),
        [m, ..] => dot(m, m).sqrt(),
        [] => 0.0,
    }
}

fn determinant(stop: &[Vec<f64>], rows: &[usize], velocities: &[usize]) -> f64 {
    match (rows, velocities) {
        (&[m, n], &[k, l]) => stop[m][k] * stop[n][l] - stop[m][l] * stop[n][k],
        (&[m, ..], &[k, ..]) => stop[m][k],
        _ => 0.0,
    }
}

/// Puts what the chosen velocities follow from into the other rows.
fn eliminate(stop: &mut [Vec<f64>], open: &[usize], chosen: &Candidate) {
    let determinant = determinant(stop, &chosen.rows, &chosen.velocities);
    for &row in open {
        let entries: Vec<f64> = chosen.velocities.iter().map(|&k| stop[row][k]).collect();
        // Shares of the chosen rows, by Cramer's rule.
        let shares = match (&chosen.velocities[..], &chosen.rows[..]) {
            (&[k, l], &[m, n]) => vec![
                (entries[0] * stop[n][l] - entries[1] * stop[n][k]) / determinant,
                (entries[1] * stop[m][k] - entries[0] * stop[m][l]) / determinant,
            ],
            _ => vec![entries[0] / determinant],
        };
        for (&from, share) in chosen.rows.iter().zip(shares) {
            if share == 0.0 {
                continue;
            }
            for k in 0..stop[row].len() {
                let change = share * stop[from][k];
                stop[row][k] -= change;
            }
        }
        for &k in &chosen.velocities {
            stop[row][k] = 0.0;
        }
    }
}
