//! What a joint of the tree leaves free.

use crate::symbolic::arena::Expr;
use crate::symbolic::vector::Triple;

/// How a link moves against the one that carries it.
#[derive(Clone, Copy, Debug)]
pub enum Freedom {
    /// It turns about a coordinate axis of its frame, by a pair of cosine and sine. A negative turn
    /// of the joint is a positive one here where `is_reversed`.
    Turn {
        /// The axis.
        axis: usize,
        /// The place among the pairs.
        pair: usize,
        /// Whether the joint counts the angle the other way round.
        is_reversed: bool,
    },
    /// It slides along a direction of its frame, which is that of its carrier.
    Slide {
        /// The direction, of unit length.
        along: Triple,
        /// The place among the further coordinates.
        rest: usize,
    },
    /// It turns as by [`Self::Turn`], and moves along the axis in proportion to the angle that an
    /// auxiliary variable counts over any number of turns.
    Screw {
        /// The axis.
        axis: usize,
        /// The place among the pairs.
        pair: usize,
        /// Whether the joint counts the angle the other way round.
        is_reversed: bool,
        /// The translation along the axis for a radian about it.
        advance: Expr,
        /// The place among the auxiliary variables.
        counter: usize,
    },
    /// It turns freely against the ground, by Euler parameters.
    Ball {
        /// The place of the first among the further coordinates.
        rest: usize,
    },
}

impl Freedom {
    /// Axis and place among the pairs of what turns about an axis.
    pub(super) const fn turn(self) -> Option<(usize, usize)> {
        match self {
            Self::Turn { axis, pair, .. } | Self::Screw { axis, pair, .. } => Some((axis, pair)),
            Self::Slide { .. } | Self::Ball { .. } => None,
        }
    }

    /// How many velocities it has.
    #[must_use]
    pub const fn velocities(self) -> usize {
        match self {
            Self::Turn { .. } | Self::Slide { .. } | Self::Screw { .. } => 1,
            Self::Ball { .. } => 3,
        }
    }
}
