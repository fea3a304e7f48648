//! Ways of a mechanism: along what its constraints leave free, and as time goes on.

use super::dense::{dot, norm};
use super::limits::TOLERANCE;
use super::motion::{Configuration, Constraints};
use super::random::Random;
use super::span::Span;
use super::sparse::Rows;

/// Configurations on a way that is looked at step by step.
const STOPS: usize = 60;
/// The largest motion of a body from stop to stop: in radians, and in fractions of the size of the
/// mechanism.
const STEP: f64 = 0.3;

/// Motions that the constraints leave free, both from the start on, with the rows of `D`.
pub(super) struct Ways {
    first: Vec<(Configuration, Rows)>,
    other: Vec<(Configuration, Rows)>,
}

impl Ways {
    /// All rows on one way: back along the first motion to the start, on along the other one, back,
    /// and along a way that begins there, too.
    pub(super) fn with(&self, way: Vec<Rows>) -> Vec<Rows> {
        let rows = |(_, rows): &(Configuration, Rows)| rows.clone();
        let mut all: Vec<Rows> = self.first.iter().rev().map(rows).collect();
        all.extend(self.other.iter().skip(1).map(rows));
        if !way.is_empty() {
            all.extend(self.other.iter().rev().map(rows));
            all.extend(way);
        }
        all
    }

    /// Times and coordinates on the first motion.
    pub(super) fn into_first(self) -> Vec<(f64, Vec<f64>)> {
        let first = self.first.into_iter();
        first.map(|(at, _)| (at.time, at.coordinates)).collect()
    }
}

/// Two motions straight on, as far as the constraints let them; they may be one that leads forwards
/// and backwards.
pub(super) fn both_ways(
    constraints: &Constraints,
    start: &Configuration,
    independent: Option<&[usize]>,
    random: &mut Random,
) -> Ways {
    let mut headings = [0; 2].map(|_| random.motion(constraints.velocities()));
    if let Some(here) = constraints.directions(start, TOLERANCE) {
        let few: Option<Rows> =
            independent.map(|rows| rows.iter().map(|&row| here[row].clone()).collect());
        let span = Span::of(few.as_ref().unwrap_or(&here), TOLERANCE);
        headings
            .iter_mut()
            .for_each(|heading| span.remove_from(heading));
    }
    let [heading, mut other] = headings;
    if dot(&heading, &other) > 0.0 {
        other.iter_mut().for_each(|x| *x = -*x);
    }
    Ways {
        first: stops(constraints, start, heading, independent),
        other: stops(constraints, start, other, independent),
    }
}

/// Configurations along a motion that the constraints leave free, straight on as far as they let
/// it, a few turns of what turns fastest, with the rows of `D`; none where nothing can move. It may
/// be known which rows the others follow from.
pub(super) fn stops(
    constraints: &Constraints,
    start: &Configuration,
    mut heading: Vec<f64>,
    independent: Option<&[usize]>,
) -> Vec<(Configuration, Rows)> {
    let mut stops = Vec::new();
    let mut at = start.clone();
    for _ in 0..STOPS {
        let Some(here) = constraints.directions(&at, TOLERANCE) else {
            break;
        };
        let few: Option<Rows> =
            independent.map(|rows| rows.iter().map(|&row| here[row].clone()).collect());
        Span::of(few.as_ref().unwrap_or(&here), TOLERANCE).remove_from(&mut heading);
        stops.push((at.clone(), here));
        let most = largest(&heading);
        if most < TOLERANCE {
            break;
        }
        heading.iter_mut().for_each(|x| *x *= STEP / most);
        let Some(reached) = constraints.assembled(&constraints.moved(&at, &heading)) else {
            break;
        };
        at = reached;
    }
    stops
}

fn largest(motion: &[f64]) -> f64 {
    motion.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
}

/// Where a mechanism gets to as time goes on.
pub(super) struct Passage {
    /// Configurations that satisfy all equations, in the order of time.
    pub(super) reached: Vec<Configuration>,
    /// How many of them, from the first, are so near to each other that rows can be followed from
    /// one to the next.
    pub(super) followed: usize,
    /// Where it went no further: configurations, nearer and nearer to the last that was reached,
    /// that were aimed at in vain.
    pub(super) missed: Vec<Configuration>,
}

/// The first step (s): laws that are done with sooner are not seen.
const FIRST: f64 = 1e-4;
/// The end (s): a day.
const LAST: f64 = 86400.0;
/// Stops behind those that are near to each other, and steps that are tried altogether.
const FAR_STOPS: usize = 40;
const TRIALS: usize = 400;
/// How often a step that does not lead onto the constraints is halved.
const HALVINGS: usize = 6;

/// Follows a mechanism in time, from a configuration that satisfies all equations. Steps are as
/// long as the velocities that the equations ask for tell where they lead, so that a motor of
/// constant speed gets far and a late law is met; they end where a smooth step begins, is half done
/// or ends. Where equations cannot be satisfied to round-off, `agrees` may have a configuration
/// near an aimed one that will do.
pub(super) fn in_time(
    constraints: &Constraints,
    start: &Configuration,
    agrees: impl Fn(&Configuration) -> Option<Configuration>,
) -> Passage {
    let breaks = &constraints.breaks;
    let mut passage = Passage {
        reached: Vec::new(),
        followed: 0,
        missed: Vec::new(),
    };
    let mut at = start.clone();
    let mut step = FIRST;
    let mut trials = 0;
    while passage.reached.len() < STOPS + FAR_STOPS && at.time < LAST {
        let Some(velocity) = constraints.velocity(&at) else {
            break;
        };
        let is_near = passage.reached.len() < STOPS;
        if is_near {
            step = step.min(STEP / largest(&velocity));
        }
        let next_break = breaks.iter().copied().find(|time| *time > at.time);
        let mut next = None;
        while next.is_none() && passage.missed.len() <= HALVINGS && trials < TRIALS {
            trials += 1;
            let time = (at.time + step).min(next_break.unwrap_or(f64::INFINITY));
            step = time - at.time;
            let motion: Vec<f64> = velocity.iter().map(|x| step * x).collect();
            let aimed = constraints.screwed(&at, &motion).at(time);
            // Far from where the equations hold, anything may be found.
            let distance = constraints.violations(&aimed).map(|far| norm(&far));
            if distance.is_some_and(|far| far <= STEP) {
                next = constraints.assembled(&aimed).or_else(|| agrees(&aimed));
                if next.is_none() {
                    passage.missed.push(aimed);
                }
            }
            if next.is_none() {
                step *= 0.5;
            }
            if time <= at.time {
                return passage;
            }
        }
        let Some(next) = next else {
            break;
        };
        passage.followed += usize::from(is_near);
        passage.missed.clear();
        passage.reached.push(next.clone());
        at = next;
        step *= 2.0;
    }
    passage
}
