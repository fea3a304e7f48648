//! Which velocities follow from the others where loops are closed: rows of closing joints and
//! velocities that are eliminated together.
//!
//! A row that determines a velocity leaves no multiplier to solve for. But the velocity must follow
//! from the others wherever the rows are independent, not here and there: so the mechanism is led
//! on a sweep, and where some velocities come near to being undetermined by rows that determine
//! others, the rows stay behind. A sweep is one way only: so what is chosen is then looked at where
//! it changes most, and on other branches ([`Descent`]). Where there is no sweep, what rows
//! determine by numbers alone is certain ([`certain`]).

use std::collections::{BTreeMap, BTreeSet};

use super::beginning::Beginning;
use super::certain;
use super::descent::Descent;
use super::links::Links;
use super::stops::{
    Numbers, ROUND_OFF, SINGULAR, STEADY, Stop, largest, passes_zero, shared, sweep,
};
use crate::plan::Pivot;
use crate::rank::closing::Place;
use crate::symbolic::arena::{Arena, Expr};

/// A sweep of fewer stops tells nothing.
const STOPS: usize = 4;

/// Where the mechanism is led to judge a choice.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Led {
    /// On the sweep.
    Along,
    /// Besides to where it vanishes, if that can be reached.
    WhereItVanishes,
}

/// A way to take rows and velocities together.
#[derive(Clone, Debug)]
struct Candidate {
    rows: Vec<usize>,
    velocities: Vec<usize>,
    /// The least determinant along the sweep over the volume that the rows span, in columns of like
    /// size.
    steady: f64,
    /// At the first stop, or if this is a singular position, the largest.
    determinant: f64,
    /// What kernels compare theirs with: at the first stop that of the rows as kernels have them;
    /// at another stop of rows as large as at the median one.
    recorded: f64,
}

/// The rows that are not taken yet, at the stops of a sweep.
struct Open<'a> {
    rows: Vec<usize>,
    joints: &'a [usize],
    stops: Vec<Stop>,
    sizes: Vec<f64>,
    /// The velocities that each row knows of.
    known: Vec<Vec<usize>>,
    /// What was found of rows that are taken together, as long as it holds.
    candidates: BTreeMap<Vec<usize>, Vec<Candidate>>,
    /// What was taken, in order.
    taken: Vec<Candidate>,
    /// Rows and velocities that vanish somewhere.
    vanishing: Vec<[Vec<usize>; 2]>,
}

/// What is eliminated before the rest: velocities with the rows that determine them, and the
/// determinants in the reference configuration. Velocities count from 0, rows from the number of
/// velocities. `mobilities` are what rows are on free bodies, `alike` is [`Links::alike`].
pub(super) fn dependent(
    arena: &Arena,
    (rows, mobilities, joints): (&[Vec<Expr>], &[Expr], &[usize]),
    links: &Links,
    (beginning, led): (&Beginning<'_>, Led),
) -> (Vec<Pivot>, Vec<f64>) {
    let alike = links.alike();
    let sweep = sweep(arena, beginning, links);
    let mut numbers = Numbers::new(arena, rows, mobilities);
    let told = numbers.along(&sweep, beginning.stops());
    let Some(stops) = told.filter(|stops| stops.len() >= STOPS) else {
        return certain::certain(arena, rows, &alike);
    };
    let (mut pivots, mut determinants) = (Vec::new(), Vec::new());
    let descent =
        (led == Led::WhereItVanishes).then(|| Descent::new(arena, beginning, links, rows));
    let descent = descent.flatten();
    let mut open = Open::new(stops, joints, &alike);
    while let Some(chosen) = open.best() {
        let way = descent
            .as_ref()
            .and_then(|descent| open.vanishing(&chosen, descent));
        if let (Some(way), Some(descent)) = (way, &descent) {
            open.refuse(&chosen, &way, (&numbers, descent));
            continue;
        }
        let first = rows[0].len();
        pivots.push(match (&chosen.velocities[..], &chosen.rows[..]) {
            (&[k, l], &[m, n]) => Pivot::Forbidden([k, l], [first + m, first + n]),
            (&[k, ..], &[m, ..]) => Pivot::Dependent(k, first + m),
            _ => unreachable!("a candidate has rows and velocities"),
        });
        determinants.push(chosen.recorded);
        open.eliminate(chosen);
    }
    (pivots, determinants)
}

impl<'a> Open<'a> {
    fn new(stops: Vec<Stop>, joints: &'a [usize], alike: &[usize]) -> Self {
        let rows: Vec<usize> = (0..stops.first().map_or(0, |stop| stop.rows.len())).collect();
        let known = rows.iter().map(|&row| known(&stops, row)).collect();
        Self {
            rows,
            joints,
            sizes: sizes(&stops, alike),
            stops,
            known,
            candidates: BTreeMap::new(),
            taken: Vec::new(),
            vanishing: Vec::new(),
        }
    }

    /// Where what determines the velocities of a candidate vanishes.
    fn vanishing(&self, chosen: &Candidate, descent: &Descent<'_>) -> Option<[Place; 2]> {
        let known = self.known_of(&chosen.rows);
        let share = |stop: &Stop| {
            let volume = self.volume(stop, &chosen.rows, &known);
            let determinant = determinant(stop, &chosen.rows, &chosen.velocities);
            determinant / self.scale(&chosen.velocities) / volume
        };
        let regular = self.regular(&chosen.rows);
        let size = |&&(stop, _): &&(&Stop, f64)| share(stop).abs();
        let least = regular.iter().min_by(|a, b| size(a).total_cmp(&size(b)));
        let seen = |rows: Vec<Vec<f64>>, least: f64| {
            let factors = vec![1.0; rows.len()];
            let mut stop = Stop::new(rows, factors, Place::default(), 0);
            self.reduced(&mut stop, &chosen.rows)?;
            let volume = self.volume(&stop, &chosen.rows, &known);
            (volume > least).then(|| share(&stop))
        };
        let mut from = least.into_iter().chain(regular.first());
        let along = from.find_map(|&(Stop { at, .. }, volume)| {
            descent.vanishing(at, |rows| seen(rows, SINGULAR * volume))
        });
        along.or_else(|| {
            let (_, volume) = regular.first()?;
            descent.vanishing_elsewhere(|rows| seen(rows, SINGULAR * volume))
        })
    }

    /// What was taken put into the other rows and some of those that are left; none in a singular
    /// position.
    fn reduced(&self, stop: &mut Stop, rows: &[usize]) -> Option<()> {
        for (place, taken) in self.taken.iter().enumerate() {
            let least = SINGULAR * taken.determinant.abs();
            if determinant(stop, &taken.rows, &taken.velocities).abs() <= least {
                return None;
            }
            let later = self.taken[place + 1..].iter().flat_map(|later| &later.rows);
            for &row in later.chain(rows) {
                if taken.velocities.iter().any(|&k| stop.rows[row][k] != 0.0) {
                    reduce(stop, row, taken);
                }
            }
        }
        Some(())
    }

    /// Takes a candidate for one that vanishes, and looks at the others where it does.
    fn refuse(
        &mut self,
        chosen: &Candidate,
        way: &[Place],
        (numbers, descent): (&Numbers<'_>, &Descent<'_>),
    ) {
        let is_of_way = self.stops.last().map_or(0, |stop| stop.way + 1);
        for at in way {
            let values = descent.joints(at).and_then(|joints| numbers.at(&joints));
            let stop = values.map(|(rows, free)| numbers.stop(rows, &free, at, is_of_way));
            self.stops.extend(stop.and_then(|mut stop| {
                self.reduced(&mut stop, &self.rows)?;
                Some(stop)
            }));
        }
        for &row in &self.rows {
            self.known[row] = known(&self.stops, row);
        }
        self.vanishing
            .push([chosen.rows.clone(), chosen.velocities.clone()]);
        self.candidates.clear();
    }

    /// The velocities that some rows know of.
    fn known_of(&self, rows: &[usize]) -> Vec<usize> {
        let known = rows.iter().flat_map(|&row| &self.known[row]).copied();
        let known: BTreeSet<usize> = known.collect();
        known.into_iter().collect()
    }

    /// The stops where some rows are regular, with the volumes that they span.
    fn regular(&self, rows: &[usize]) -> Vec<(&Stop, f64)> {
        let known = self.known_of(rows);
        let volumes = self
            .stops
            .iter()
            .map(|stop| (stop, self.volume(stop, rows, &known)));
        let volumes: Vec<(&Stop, f64)> = volumes.collect();
        let most = volumes
            .iter()
            .fold(0.0_f64, |most, (_, volume)| most.max(*volume));
        let is_regular = |(_, volume): &(&Stop, f64)| *volume > SINGULAR * most;
        volumes.into_iter().filter(is_regular).collect()
    }

    fn scale(&self, velocities: &[usize]) -> f64 {
        velocities.iter().map(|&k| self.sizes[k]).product()
    }

    /// Rows that are taken together: two of one joint meet in a determinant that vanishes less
    /// often than their entries.
    fn groups(&self) -> Vec<Vec<usize>> {
        let joint = |place: usize| self.rows.get(place).map(|&row| self.joints[row]);
        let mut groups = Vec::new();
        for (place, &row) in self.rows.iter().enumerate() {
            if joint(place + 1) == joint(place) {
                groups.push(vec![row, self.rows[place + 1]]);
            } else if place == 0 || joint(place - 1) != joint(place) {
                groups.push(vec![row]);
            }
        }
        groups
    }

    /// The candidate that the fewest other rows know of, then the steadiest.
    fn best(&mut self) -> Option<Candidate> {
        self.stops.first()?;
        let mut best: Option<((usize, f64), Candidate)> = None;
        for group in self.groups() {
            if !self.candidates.contains_key(&group) {
                let found = self.candidates_of(&group);
                self.candidates.insert(group.clone(), found);
            }
            for candidate in &self.candidates[&group] {
                // Round-off does not decide between what is alike: the first does.
                let merit = (self.others(candidate), -(1e6 * candidate.steady).round());
                if best.as_ref().is_none_or(|(best, _)| merit < *best) {
                    best = Some((merit, candidate.clone()));
                }
            }
        }
        best.map(|(_, candidate)| candidate)
    }

    /// How many other rows know of the velocities.
    fn others(&self, candidate: &Candidate) -> usize {
        let knows = |row: usize| {
            let mut velocities = candidate.velocities.iter();
            velocities.any(|k| self.known[row].binary_search(k).is_ok())
        };
        let rows = self.rows.iter();
        rows.filter(|&&row| knows(row) && !candidate.rows.contains(&row))
            .count()
    }

    /// All steady ways to take some rows.
    fn candidates_of(&self, rows: &[usize]) -> Vec<Candidate> {
        let known = self.known_of(rows);
        let regular = self.regular(rows);
        let mut found = Vec::new();
        for (number, &k) in known.iter().enumerate() {
            match rows {
                [_] => found.extend(self.candidate(rows, vec![k], &regular)),
                _ => found.extend(
                    known[number + 1..]
                        .iter()
                        .filter_map(|&l| self.candidate(rows, vec![k, l], &regular)),
                ),
            }
        }
        found
    }

    fn candidate(
        &self,
        rows: &[usize],
        velocities: Vec<usize>,
        regular: &[(&Stop, f64)],
    ) -> Option<Candidate> {
        if self
            .vanishing
            .iter()
            .any(|[r, v]| r == rows && *v == velocities)
        {
            return None;
        }
        let stops = self.stops.iter();
        let determinants: Vec<f64> = stops
            .map(|stop| determinant(stop, rows, &velocities))
            .collect();
        let scale = self.scale(&velocities);
        let shares = regular.iter().map(|(stop, volume)| {
            let share = determinant(stop, rows, &velocities) / scale / volume;
            (stop.way, share)
        });
        let shares: Vec<(usize, f64)> = shares.collect();
        let mut steps = shares.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        if steps.any(|pair| passes_zero(pair[0].1, pair[1].1)) {
            return None;
        }
        let steady = shares
            .iter()
            .fold(f64::INFINITY, |least, (_, share)| least.min(share.abs()));
        let most = largest(&determinants);
        let is_first = determinants[0].abs() > STEADY * most.abs();
        let determinant = if is_first { determinants[0] } else { most };
        let factor = || -> f64 { rows.iter().map(|&row| self.stops[0].factors[row]).product() };
        (steady > STEADY && most != 0.0).then(|| Candidate {
            rows: rows.to_vec(),
            velocities,
            steady,
            determinant,
            recorded: if is_first {
                determinant / factor()
            } else {
                most
            },
        })
    }

    /// The volume that one or two rows span: the root of the sum of all squared determinants.
    fn volume(&self, Stop { rows: stop, .. }: &Stop, rows: &[usize], known: &[usize]) -> f64 {
        let dot = |a: usize, b: usize| -> f64 {
            let entries = known.iter();
            entries
                .map(|&k| (stop[a][k] / self.sizes[k]) * (stop[b][k] / self.sizes[k]))
                .sum()
        };
        match *rows {
            [m, n] => (dot(m, m) * dot(n, n) - dot(m, n).powi(2)).max(0.0).sqrt(),
            [m, ..] => dot(m, m).sqrt(),
            [] => 0.0,
        }
    }

    /// Puts what the chosen velocities follow from into the rows that are left.
    fn eliminate(&mut self, chosen: Candidate) {
        self.rows.retain(|row| !chosen.rows.contains(row));
        let least = SINGULAR * chosen.determinant.abs();
        let before = self.stops.len();
        self.stops
            .retain(|stop| determinant(stop, &chosen.rows, &chosen.velocities).abs() > least);
        let mut changed: Vec<usize> = Vec::new();
        for &row in &self.rows {
            let knows = |stop: &Stop| chosen.velocities.iter().any(|&k| stop.rows[row][k] != 0.0);
            if self.stops.iter().any(knows) {
                self.stops
                    .iter_mut()
                    .for_each(|stop| reduce(stop, row, &chosen));
                changed.push(row);
            }
        }
        if self.stops.len() < before {
            changed.clone_from(&self.rows);
        }
        for &row in &changed {
            self.known[row] = known(&self.stops, row);
        }
        self.candidates
            .retain(|rows, _| !rows.iter().any(|row| changed.contains(row)));
        self.taken.push(chosen);
    }
}

/// The velocities that a row knows of: by more than round-off, which looks steady beside itself.
fn known(stops: &[Stop], row: usize) -> Vec<usize> {
    let width = stops.first().map_or(0, |stop| stop.rows[row].len());
    let mut is_known = vec![false; width];
    for stop in stops {
        let least = ROUND_OFF * stop.made_of[row];
        for (is_known, entry) in is_known.iter_mut().zip(&stop.rows[row]) {
            *is_known |= entry.abs() > least;
        }
    }
    (0..width).filter(|&k| is_known[k]).collect()
}

/// The largest entry of each column and of those alike along a sweep, 1 where there is none.
fn sizes(stops: &[Stop], alike: &[usize]) -> Vec<f64> {
    let mut sizes = vec![
        0.0_f64;
        stops
            .first()
            .and_then(|stop| stop.rows.first())
            .map_or(0, Vec::len)
    ];
    for row in stops.iter().flat_map(|stop| &stop.rows) {
        for (size, entry) in sizes.iter_mut().zip(row) {
            *size = size.max(entry.abs());
        }
    }
    shared(&sizes, alike)
        .map(|size| if size > 0.0 { size } else { 1.0 })
        .collect()
}

fn determinant(Stop { rows: stop, .. }: &Stop, rows: &[usize], velocities: &[usize]) -> f64 {
    match (rows, velocities) {
        (&[m, n], &[k, l]) => stop[m][k] * stop[n][l] - stop[m][l] * stop[n][k],
        (&[m, ..], &[k, ..]) => stop[m][k],
        _ => 0.0,
    }
}

/// Puts what the chosen velocities follow from into another row.
fn reduce(stop: &mut Stop, row: usize, chosen: &Candidate) {
    let determinant = determinant(stop, &chosen.rows, &chosen.velocities);
    let Stop {
        rows: stop,
        made_of,
        ..
    } = stop;
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
        made_of[row] = made_of[row].max(share.abs() * made_of[from]);
        for k in 0..stop[row].len() {
            let change = share * stop[from][k];
            stop[row][k] -= change;
        }
    }
    for &k in &chosen.velocities {
        stop[row][k] = 0.0;
    }
}
