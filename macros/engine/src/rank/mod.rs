//! The rank of the constraints, found by numbers at expansion.
//!
//! Equations that follow from others do so in every configuration, whereas in a singular
//! configuration, such as the dead point of a linkage, rows of `D` depend on each other by chance.
//! So the rank is judged at the reference configuration and at some more that random motions lead
//! to, each put back onto the constraints, and the largest counts.
//!
//! Which equations to leave out is a choice, and one that is sound here may be singular after half
//! a turn. So where there is a choice, the mechanism is led on a sweep through its motion, and rows
//! are kept that stand out from each other all along.
//!
//! Where the time stands in an equation, rows may depend on each other at the start only, and
//! equations that agree there may contradict each other later. So where there is a choice, the
//! mechanism is followed in time, too.
//!
//! Columns are made comparable by the size of the mechanism, rows by their own length. A row that
//! stands out from the others by less than [`TOLERANCE`] of its length depends on them.
//!
//! Macros run unoptimised in users' crates. So rows are stored without zeros (`sparse.rs`), and
//! steps use a sparse factorisation of `D D^T` (`normal.rs`). Rows that stand out clearly are
//! taken by it. Only what they leave of the others is treated in full (`span.rs`). Corrections are
//! those of Levenberg and Marquardt, which need no independent rows.
//!
//! What is done with a row:
//!
//! - A row that depends on others at all configurations is redundant: refused, dropped or kept
//!   (`check/redundant.rs`). Which rows stay: `docs/decisions/004-choice-of-rows.md`.
//! - A vector equation that loses a component becomes scalar products with unit vectors: global
//!   ones, or such that are fixed on a body where a loop turns in space (`components.rs`).
//! - A dropped row must hold wherever the kept rows let the mechanism move
//!   (`contradiction::by_chance`). Constraints that touch, such as a bar that a turn shortens by
//!   second order only, leave no other configuration and depend on each other at the start.
//! - A row that vanishes at all configurations, but not far away or within a smooth step of time,
//!   is dormant. It follows from nothing and is not dropped. Nor is any row where the walk finds
//!   only a start that leaves motion free.
//!
//! Time (`sweep.rs`). The walk has up to 100 steps. They end where a smooth step of time begins, is
//! half done or ends. The first 60 have motions of up to 0.3 rad; the choice of rows is judged
//! along them. The others go on as long as the demanded velocities tell where they lead, up to a
//! day. Angles over turns are counted along all ways.
//!
//! Contradictions (`contradiction.rs`). A dropped row must follow in position, velocity and time:
//! `Y^T Phi_t = 0` where `Y^T D = 0`. Where no configuration satisfies all equations, those that
//! are violated while the kept ones hold, and depend on them all around, are a contradiction. It
//! is refused in every mode, because a compliance would make a compromise. It must depend on rows
//! that can be satisfied: an arm drawn beyond its reach says nothing. A start that cannot be
//! assembled is refused with `"drop"` only, because every run reports it. An equation that is
//! violated where its own gradient vanishes (a universal joint with parallel arms) is refused,
//! unless its points and axes are given by `local(..)`. Where no configuration satisfies all
//! equations, rows are kept from the first on, then from the last on.
//!
//! Motions of a joint (`test_assembly.rs`, `moves.rs`). Two free bodies get the joint and are
//! displaced by random amounts of every motion. The equations must hold, no motion may have a part
//! along a gradient, and the rank must leave as many motions. If the equations hold for no trial
//! parameters, or the motions agree for one kind of them, the definition is accepted. Then only a
//! mechanism can tell, by the same function. A definition that arrives from another crate is not
//! compared again.
//!
//! Typical values (`#[param(like = ..)]`) are read by `motion.rs` alone. `Independence::likes`
//! names the parameters that the constraints depend on. `closing.rs` finds dependent rows among
//! closing joints, without what the tree forbids.

mod assemble;
mod choice;
pub(crate) mod closing;
mod components;
mod contradiction;
mod definite;
mod dense;
mod displacement;
mod elsewhere;
mod geometry;
mod limits;
mod motion;
pub mod moves;
mod normal;
mod random;
mod span;
mod sparse;
mod sweep;
pub mod test_assembly;
mod walk;

use std::collections::BTreeSet;

use self::contradiction::Contradicted;
pub use self::definite::is_definite;
pub use self::limits::TOLERANCE;
use self::motion::{Configuration, Constraints};
use self::normal::Normal;
use self::random::Random;
use self::span::independent;
use self::sparse::Rows;
use self::walk::walk;
use crate::model::mechanism::Layout;
use crate::model::{Contradiction, Independence, Model, Rank, RedundantRow};

/// Finds the rank of a model's constraints, and which of them follow from others.
#[must_use]
pub fn judge(model: &Model) -> Independence {
    judged(model).independence
}

/// The same of a model whose redundant equations are to be left out: vector equations are split
/// along directions by which the others stay independent (`components.rs`).
#[must_use]
pub fn judge_to_drop(model: &Model) -> Independence {
    let mut best = judged(model);
    let turned = std::mem::take(&mut best.components);
    if !turned.is_empty() {
        best = judged(&with(model, turned));
    }
    // Where no direction is kept, as between two bodies with many points in common, or in a loop
    // in space.
    for first in [true, false] {
        if best.steadiness > TOLERANCE || best.independence.redundant.is_empty() {
            break;
        }
        let other = judged(&with(model, components::of_bodies(model, first)));
        if other.steadiness > best.steadiness {
            best = other;
        }
    }
    best.independence
}

/// A model whose vector equations are split along some directions.
fn with(model: &Model, components: components::Found) -> Model {
    let mut model = model.clone();
    for (joint, components) in components {
        model.joints[joint].components.push(components);
    }
    model
}

/// What is found of a model.
struct Judged {
    independence: Independence,
    /// The components of vector equations that have to be along directions fixed on bodies.
    components: components::Found,
    /// How steady the choice of rows is ([`choice::steadiness`]); infinite without one.
    steadiness: f64,
}

impl From<Independence> for Judged {
    fn from(independence: Independence) -> Self {
        Self {
            independence,
            components: Vec::new(),
            steadiness: f64::INFINITY,
        }
    }
}

fn judged(model: &Model) -> Judged {
    let mut random = Random::new();
    let not = |rank: Rank| Independence {
        rank,
        ..Independence::default()
    };
    let Some((constraints, described)) =
        Constraints::new(model, |velocities| random.motion(velocities))
    else {
        return not(Rank::NotDecided).into();
    };
    let Some(start) = constraints.assembled(&described) else {
        let found = contradiction::nowhere(&constraints, &described, &described, &mut random);
        let found = found.and_then(|(found, kept)| {
            let rows = constraints.directions(&described, TOLERANCE)?;
            Some(contradictions(model, found, &kept, &rows, &described))
        });
        let layout = model.layout();
        let stuck = constraints.stuck(&described).into_iter();
        let stuck = stuck.map(|row| layout.place_of(row));
        return Independence {
            stuck: stuck.collect(),
            contradictions: found.unwrap_or_default(),
            is_driven: constraints.is_driven(),
            ..not(Rank::NotAssembled)
        }
        .into();
    };
    let configurations = walk(&constraints, start.clone(), None, &mut random);
    let Some(mut found) = Found::at(&constraints, configurations) else {
        return not(Rank::NotDecided).into();
    };
    let has_choice = found.rank < model.layout().rows;
    let mut missed = Vec::new();
    let mut way = Vec::new();
    if has_choice && constraints.is_driven() {
        let agrees =
            |near: &Configuration| contradiction::agreeing(&constraints, &start, &found.kept, near);
        let passage = sweep::in_time(&constraints, &start, agrees);
        let followed = passage.reached.iter().take(passage.followed);
        way = followed
            .filter_map(|at| constraints.directions(at, TOLERANCE))
            .collect();
        missed = passage.missed;
        let mut configurations = found.configurations;
        let last = passage.reached.len().saturating_sub(1);
        for from in [last / 4, last / 2, last] {
            if let Some(from) = passage.reached.get(from) {
                configurations.extend(walk(&constraints, from.clone(), None, &mut random));
            }
        }
        configurations.extend(passage.reached);
        let Some(later) = Found::at(&constraints, configurations) else {
            return not(Rank::NotDecided).into();
        };
        found = later;
    }
    let Found {
        configurations,
        directions,
        rank,
        at_start,
        first_regular,
        last_regular,
        kept,
    } = found;
    let mut against = Vec::new();
    let mut components = Vec::new();
    let choice;
    if rank < model.layout().rows {
        if constraints.is_driven() {
            against = contradiction::by_speed(&constraints, &configurations, &directions, &kept);
        }
        let mut rows = directions.get(first_regular).cloned();
        let mut kept_there = kept.clone();
        if against.is_empty() {
            (against, kept_there) = parted(&constraints, &start, &kept, &missed, &mut random);
            if kept_there != kept {
                // Those that stand out there need not anywhere before.
                let last = missed.last();
                rows = last.and_then(|at| constraints.directions(at, TOLERANCE));
            }
        }
        let rows = rows.unwrap_or_default();
        let contradictions = contradictions(model, against, &kept_there, &rows, &described);
        if !contradictions.is_empty() {
            return Independence {
                contradictions,
                is_driven: constraints.is_driven(),
                ..not(Rank::Decided { rank, at_start })
            }
            .into();
        }
        let regular = (&directions[..], rank);
        components = components::components(model, &constraints, &configurations, regular);
        let from = &configurations[first_regular];
        choice = Choice::of(&constraints, [&start, from], kept, way, &mut random);
    } else {
        choice = Choice::none(kept);
    }
    let kept = choice.kept;
    let layout = model.layout();
    let is_alone = configurations.len() == 1 && rank < layout.rows.min(layout.velocities);
    let dormant = dormant(&constraints, &directions).into_iter();
    let redundant = redundant(model, &kept, &directions[first_regular]);
    // The reference configuration may hide what the last one shows.
    let regular = [first_regular, last_regular].map(|k| &directions[k]);
    let independence = Independence {
        undetermined: undetermined(model, &kept, regular),
        redundant,
        dormant: dormant.map(|row| layout.place_of(row)).collect(),
        by_chance: choice
            .by_chance
            .into_iter()
            .map(|row| layout.place_of(row))
            .collect(),
        is_alone,
        is_driven: constraints.is_driven(),
        likes: constraints.values.clone(),
        sweep: choice.stops,
        components: given_components(model),
        ..not(Rank::Decided { rank, at_start })
    };
    Judged {
        independence,
        components,
        steadiness: choice.steadiness,
    }
}

/// Rows that are kept, and how they do on the way of the mechanism.
struct Choice {
    kept: Vec<usize>,
    steadiness: f64,
    /// See [`Independence::sweep`].
    stops: Vec<(f64, Vec<f64>)>,
    by_chance: Vec<usize>,
}

impl Choice {
    /// All rows.
    fn none(kept: Vec<usize>) -> Self {
        Self {
            kept,
            steadiness: f64::INFINITY,
            stops: Vec::new(),
            by_chance: Vec::new(),
        }
    }

    /// The steadiest rows, from some that are independent at a configuration, with the rows of `D`
    /// where time led to.
    fn of(
        constraints: &Constraints,
        [start, from]: [&Configuration; 2],
        kept: Vec<usize>,
        way: Vec<Rows>,
        random: &mut Random,
    ) -> Self {
        let ways = sweep::both_ways(constraints, start, Some(&kept), random);
        let sweep = ways.with(way);
        let kept = choice::steady(kept, &sweep, TOLERANCE);
        let steadiness = choice::steadiness(&kept, &sweep, TOLERANCE);
        Self {
            by_chance: contradiction::by_chance(constraints, start, &kept, from, random),
            kept,
            steadiness,
            stops: ways.into_first(),
        }
    }
}

/// The components of a model's vector equations that are along directions fixed on bodies.
fn given_components(model: &Model) -> components::Found {
    let joints = model.joints.iter().enumerate();
    joints
        .flat_map(|(place, joint)| joint.components.iter().map(move |given| (place, *given)))
        .collect()
}

/// What configurations tell of the rank.
struct Found {
    configurations: Vec<Configuration>,
    directions: Vec<Rows>,
    /// The largest.
    rank: usize,
    /// At the first.
    at_start: usize,
    /// The first configuration of the largest rank.
    first_regular: usize,
    /// The last one.
    last_regular: usize,
    /// As many rows, independent at all configurations of that rank if there are such.
    kept: Vec<usize>,
}

impl Found {
    fn at(constraints: &Constraints, configurations: Vec<Configuration>) -> Option<Self> {
        let directions: Option<Vec<Rows>> = configurations
            .iter()
            .map(|at| constraints.directions(at, TOLERANCE))
            .collect();
        let directions = directions?;
        let sets: Vec<Vec<usize>> = directions
            .iter()
            .map(|rows| independent(std::slice::from_ref(rows), TOLERANCE))
            .collect();
        let rank = sets.iter().map(Vec::len).max().unwrap_or(0);
        let regular: Vec<usize> = (0..sets.len()).filter(|&k| sets[k].len() == rank).collect();
        let first_regular = *regular.first()?;
        let among: Vec<Rows> = regular.iter().map(|&k| directions[k].clone()).collect();
        let mut kept = independent(&among, TOLERANCE);
        if kept.len() < rank {
            // No set serves all samples within the tolerance: one that serves the first.
            kept.clone_from(&sets[first_regular]);
        }
        Some(Self {
            at_start: sets.first().map_or(0, Vec::len),
            configurations,
            directions,
            rank,
            first_regular,
            last_regular: *regular.last()?,
            kept,
        })
    }
}

/// The rows that vanish at all configurations, though not everywhere.
fn dormant(constraints: &Constraints, directions: &[Rows]) -> Vec<usize> {
    let vanishes = |row: usize| directions.iter().all(|rows| rows[row].norm() == 0.0);
    (0..constraints.sizes.len())
        .filter(|&row| constraints.sizes[row].is_some() && vanishes(row))
        .collect()
}

/// The rows that part from those that they depend on where a mechanism could not be followed in
/// time, which are violated at all configurations that were aimed at in vain; and the kept rows
/// there.
fn parted(
    constraints: &Constraints,
    start: &Configuration,
    kept: &[usize],
    missed: &[Configuration],
    random: &mut Random,
) -> (Vec<Contradicted>, Vec<usize>) {
    let mut found: Option<Vec<Contradicted>> = None;
    let mut kept_there = kept.to_vec();
    // The last one is the first in time.
    for near in missed {
        let here = contradiction::where_missed(constraints, start, kept, near, random);
        let (here, kept_here) = here.unwrap_or_default();
        let before = found.take();
        let is_common = |row: usize| {
            let before = before.as_ref();
            before.is_none_or(|before| before.iter().any(|known| known.row == row))
        };
        found = Some(here.into_iter().filter(|new| is_common(new.row)).collect());
        kept_there = kept_here;
    }
    (found.unwrap_or_default(), kept_there)
}

/// Contradictions as the model has them.
fn contradictions(
    model: &Model,
    found: Vec<Contradicted>,
    kept: &[usize],
    rows: &Rows,
    described: &Configuration,
) -> Vec<Contradiction> {
    if found.is_empty() {
        return Vec::new();
    }
    let follow = redundant(model, kept, rows);
    let layout = model.layout();
    let found = found.into_iter().filter_map(|contradicted| {
        let place = |known: &&RedundantRow| layout.row[known.joint] + known.row == contradicted.row;
        follow.iter().find(place).map(|row| Contradiction {
            joint: row.joint,
            row: row.row,
            against: row.follows_from.clone(),
            time: contradicted.time,
            by_speed: contradicted.by_speed,
            way: [described.coordinates.clone(), contradicted.at],
        })
    });
    found.collect()
}

/// The rows that are not kept, each with the kept ones that it follows from.
fn followers(layout: &Layout, kept: &[usize], rows: &Rows) -> Vec<(usize, Vec<usize>)> {
    // Shares of a row in another below this are round-off.
    const SHARE: f64 = 1e-6;
    let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
    let normal = Normal::new(&basis, 0.0);
    (0..layout.rows)
        .filter(|row| !kept.contains(row))
        .map(|row| {
            let shares = normal.as_ref();
            let shares = shares.map(|normal| normal.solve(&normal.products(&rows[row])));
            let shares = kept.iter().zip(shares.unwrap_or_default());
            let others = shares.filter(|(_, share)| share.abs() > SHARE);
            (row, others.map(|(&other, _)| other).collect())
        })
        .collect()
}

/// The equations whose multipliers are not unique, whatever configuration tells so.
fn undetermined(model: &Model, kept: &[usize], configurations: [&Rows; 2]) -> Vec<(usize, usize)> {
    let layout = model.layout();
    let found: BTreeSet<usize> = configurations
        .into_iter()
        .flat_map(|rows| followers(&layout, kept, rows))
        .flat_map(|(row, others)| others.into_iter().chain([row]))
        .collect();
    found.into_iter().map(|row| layout.place_of(row)).collect()
}

/// The rows that are not kept, and the joints whose rows they follow from.
fn redundant(model: &Model, kept: &[usize], rows: &Rows) -> Vec<RedundantRow> {
    let layout = model.layout();
    let followers = followers(&layout, kept, rows).into_iter();
    followers
        .map(|(row, others)| {
            let others = others.into_iter().map(|other| layout.joint_of(other));
            let mut follows_from: Vec<usize> = others.collect();
            follows_from.dedup();
            let (joint, row) = layout.place_of(row);
            RedundantRow {
                joint,
                row,
                follows_from,
            }
        })
        .collect()
}
