//! The plan of a solution: the axes of the unknowns, and the order in which they are eliminated.
//!
//! Candidates are worked out in full and counted; the cheapest is taken. Fill-in alone would not
//! tell, because most of what is saved is saved by constants that fold.

pub mod alone;
mod augmented;
pub mod candidates;
mod carried;
mod collect;
pub mod eliminate;
mod inverse;
pub mod kernels;
mod order;
mod reach;
pub mod readouts;
mod reference;
mod symmetric;
pub mod system;
pub mod time;
mod tree;

use crate::symbolic::vector::Frame;
use system::Terms;

/// A pivot: one unknown, or a body's acceleration together with the multiplier that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pivot {
    /// An acceleration. The block of accelerations stays positive definite through safe
    /// eliminations, so that no check is needed.
    Acceleration(usize),
    /// The saddle block `[m c; c -e]` of an acceleration and a row with `c = 1` or `-1`: never
    /// singular.
    Saddle(usize, usize),
    /// The saddle block `[A C^T; C 0]` of two accelerations and the two rows that determine them,
    /// first to last: the motion that a joint forbids its body. `C` is safe on the constraints,
    /// where its determinant stays near to what it is at the start; checked at run time.
    Forbidden([usize; 2], [usize; 2]),
    /// The saddle block `[a c; c 0]` of an acceleration and the row that determines it. Checked at
    /// run time like [`Self::Forbidden`], unless `c` is a number.
    Dependent(usize, usize),
    /// A multiplier. Safe only where rows are independent: checked at run time unless there is a
    /// compliance.
    Multiplier(usize),
}

impl Pivot {
    /// The unknowns that it eliminates.
    #[must_use]
    pub fn unknowns(self) -> Vec<usize> {
        match self {
            Self::Acceleration(k) | Self::Multiplier(k) => vec![k],
            Self::Saddle(k, l) | Self::Dependent(k, l) => vec![k, l],
            Self::Forbidden([k, l], [m, n]) => vec![k, l, m, n],
        }
    }
}

/// The axes of the unknowns, and the order of elimination.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The axes of each body's translational acceleration.
    pub translation: Vec<Frame>,
    /// The constraint whose point on each body has the acceleration that is eliminated; `None` for
    /// the centre of mass.
    pub points: Vec<Option<usize>>,
    /// The axes of each constraint's rows; of no meaning for a single row.
    pub rows: Vec<Frame>,
    /// Pivots, first to last. Unknowns are numbered like velocities, then rows.
    pub pivots: Vec<Pivot>,
    /// The determinant of `C` of each [`Pivot::Forbidden`], and `c` of each [`Pivot::Dependent`],
    /// at the start, in order.
    pub determinants: Vec<f64>,
}

/// The plans of a mechanism: what is cheapest without a compliance need not be so with one, where
/// the rows have a diagonal of their own.
#[derive(Clone, Debug, PartialEq)]
pub struct Plans {
    /// For rigid constraints, with or without stabilisation.
    pub rigid: Plan,
    /// For constraints with a compliance, where every order is safe.
    pub compliant: Plan,
}

impl Plans {
    /// The plan for some terms.
    #[must_use]
    pub fn of(&self, terms: Terms) -> &Plan {
        match terms {
            Terms::Plain | Terms::Stabilised => &self.rigid,
            Terms::Compliant => &self.compliant,
        }
    }
}
