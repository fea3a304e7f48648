//! The rank of the constraints, found by numbers at expansion.
//!
//! Equations that follow from others do so in every configuration, whereas in a singular configuration, such as the dead
//! point of a linkage, rows of `D` depend on each other by chance. So the rank is judged at the described configuration and at some more that
//! random motions lead to, each put back onto the constraints, and the largest counts.
//!
//! Which equations to leave out is a choice, and one that is sound here may be singular after half a turn. So where there is a
//! choice, the mechanism is led on a tour through its motion, and rows are kept that stand out from each other all along.
//!
//! Columns are made comparable by the size of the mechanism, rows by their own length. A row that stands out from the
//! others by less than [`TOLERANCE`] of its length depends on them.

mod choice;
mod dense;
mod motion;

use self::dense::{Rows, dot, independent, solve_normal};
use self::motion::Constraints;
use crate::model::{Independence, Model, Rank, RedundantRow};

/// Relative to the length of a row. Configurations are good to about 1e-12, and lengths and axes given to six digits
/// are to count as what they are.
pub const TOLERANCE: f64 = 1e-7;

/// Configurations besides the start.
const SAMPLES: usize = 5;
/// The size of a motion: in radians, and in fractions of the size of the mechanism.
const MOTION: f64 = 0.2;
/// How often a motion that does not lead back onto the constraints is halved.
const HALVINGS: usize = 4;

/// Finds the rank of a model's constraints, and which of them follow from others.
#[must_use]
pub fn judge(model: &Model) -> Independence {
    let mut random = Random::new();
    let not = |rank: Rank| Independence {
        rank,
        ..Independence::default()
    };
    let Some((constraints, described)) =
        Constraints::new(model, |velocities| random.motion(velocities))
    else {
        return not(Rank::NotDecided);
    };
    let Some(start) = constraints.assembled(&described) else {
        return not(Rank::NotAssembled);
    };
    let mut configurations = vec![start];
    for _ in 0..SAMPLES {
        // From the last one: the samples walk away from the start.
        let from = &configurations[configurations.len() - 1];
        let mut motion = random.motion(model.layout().velocities);
        for _ in 0..=HALVINGS {
            let reached = constraints.assembled(&constraints.moved(from, &motion));
            if let Some(reached) = reached {
                configurations.push(reached);
                break;
            }
            motion.iter_mut().for_each(|x| *x *= 0.5);
        }
    }
    let directions: Option<Vec<Rows>> = configurations
        .iter()
        .map(|at| constraints.directions(at, TOLERANCE))
        .collect();
    let Some(directions) = directions else {
        return not(Rank::NotDecided);
    };
    let sets: Vec<Vec<usize>> = directions
        .iter()
        .map(|rows| independent(std::slice::from_ref(rows), TOLERANCE))
        .collect();
    let rank = sets.iter().map(Vec::len).max().unwrap_or(0);
    let at_start = sets.first().map_or(0, Vec::len);
    let regular: Vec<usize> = (0..sets.len()).filter(|&k| sets[k].len() == rank).collect();
    let among: Vec<Rows> = regular.iter().map(|&k| directions[k].clone()).collect();
    let mut kept = independent(&among, TOLERANCE);
    if kept.len() < rank {
        // No set serves all samples within the tolerance: one that serves the first.
        kept.clone_from(&sets[regular[0]]);
    }
    if rank < model.layout().rows {
        let heading = random.motion(model.layout().velocities);
        let tour = motion::tour(&constraints, &configurations[0], heading);
        kept = choice::steady(kept, &tour, TOLERANCE);
    }
    Independence {
        rank: Rank::Decided { rank, at_start },
        redundant: redundant(model, &kept, &among[0]),
        dropped: false,
    }
}

/// The rows that are not kept, and the joints whose rows they follow from.
fn redundant(model: &Model, kept: &[usize], rows: &Rows) -> Vec<RedundantRow> {
    // Shares of a row in another below this are round-off.
    const SHARE: f64 = 1e-6;
    let layout = model.layout();
    let joint_of = |row: usize| {
        let joint = layout.row.iter().rposition(|&first| first <= row);
        joint.unwrap_or(0)
    };
    let basis: Rows = kept.iter().map(|&row| rows[row].clone()).collect();
    (0..layout.rows)
        .filter(|row| !kept.contains(row))
        .map(|row| {
            let products: Vec<f64> = basis.iter().map(|other| dot(other, &rows[row])).collect();
            let shares = solve_normal(&basis, &products, 0.0).unwrap_or_default();
            let mut follows_from: Vec<usize> = kept
                .iter()
                .zip(shares)
                .filter(|(_, share)| share.abs() > SHARE)
                .map(|(&other, _)| joint_of(other))
                .collect();
            follows_from.dedup();
            let joint = joint_of(row);
            RedundantRow {
                joint,
                row: row - layout.row[joint],
                follows_from,
            }
        })
        .collect()
}

/// Numbers without a pattern, the same at every expansion (Marsaglia's xorshift).
struct Random(u64);

impl Random {
    const fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// Between -1 and 1.
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn motion(&mut self, velocities: usize) -> Vec<f64> {
        (0..velocities).map(|_| MOTION * self.number()).collect()
    }
}
