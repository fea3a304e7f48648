//! The plan of a solution: the axes of the unknowns, and the order in which they are eliminated.
//!
//! Candidates are worked out in full and counted; the cheapest is taken. Fill-in alone would not
//! tell, because most of what is saved is saved by constants that fold.
//!
//! One saddle system serves the four formulations. `eliminate.rs` factorises it symbolically, with
//! pivots of these kinds (`Pivot`, `inverse.rs`):
//!
//! | pivot | when it is safe |
//! |---|---|
//! | an acceleration | always: the matrix is quasi-definite, and the block of accelerations stays positive definite |
//! | `[m c; c -e]` of an acceleration and a row | while `c` is 1 or -1, whatever was added to `m` and `e`: no other body of the row is eliminated |
//! | `[A C^T; C 0]` of two components of `w'` and the two rows that forbid them | while no other body of the rows is eliminated; on the constraints, where `det C` keeps its value of the start. The ratio to it is recorded |
//! | a multiplier | where rows are independent and the eliminated bodies determine it. The ratio to its value without the other rows is recorded |
//!
//! The reference of the last ratio is the greatest value, if that depends on orientations alone
//! and varies by less than a decade (`reference.rs`). With a compliance every pivot is safe and
//! none is recorded. A plan proposes and `factorise` looks. A block that an earlier step has
//! filled is taken apart. A multiplier whose pivot is zero by structure waits until it is not. Why
//! rows may go early: `docs/decisions/015-early-rows.md`.
//!
//! Reductions of cost:
//!
//! - An acceleration may be that of a point (`Motion::reference`). The matrix is congruent body by
//!   body, so pivots keep their kind. A joint's rows lose their moments on the body it carries,
//!   whose parallel-axis inertia is constant. Ratios of pivots still compare with centres of mass.
//! - A mass may move to the other body's point (`augmented.rs`), only without a compliance and if
//!   nothing of the other body is eliminated before.
//! - Accelerations that no row of the joint acts on go first. The forbidden motion goes before the
//!   point rows, unless the body is a leaf.
//! - Rows eliminated with accelerations act on what is left by these accelerations. With
//!   `x = C^-1 l` and `z = u - A x`, two columns take `x . u' + z . x'` from an entry.
//! - A determinant is an entry of a rotation, which is its own cofactor (`rotation::relate`).
//! - Uncoupled accelerations are eliminated together, and their sums collected (`collect.rs`),
//!   with `a1 a1^T + a2 a2^T = I - a3 a3^T` for bodies with an axis of symmetry.
//! - Factors can be used in three ways (`carried.rs`), and accelerations of centres of mass return
//!   by `(F - D^T lambda) / m` or a rotation. `System::solve` takes the cheapest.
//!
//! Order. `tree.rs` gives each body the joint with most equations, then the one nearest to the
//! ground, then names decide. So the order of fields has no say. Bodies go from leaves to ground,
//! closing joints last. Sums follow the order of elimination, which shortens the path. Choice:
//! `docs/decisions/005-choice-of-a-plan.md`.
//!
//! Other kernels. Readings have kernels in `readouts.rs`: angles, displacements, points of
//! reactions, energy, power, loads, sides.

mod augmented;
pub mod candidates;
mod carried;
mod collect;
pub mod derivatives;
pub mod eliminate;
mod fill;
mod inverse;
pub mod kernels;
mod order;
pub mod profile;
mod reach;
pub mod readouts;
mod reference;
pub mod symmetric;
pub mod system;
pub mod time;
mod tree;

use crate::symbolic::vector::Frame;

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
