//! What a joint of the tree leaves free.

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
    /// It turns freely against the ground, by Euler parameters.
    Ball {
        /// The place of the first among the further coordinates.
        rest: usize,
    },
}

impl Freedom {
    /// How many velocities it has.
    #[must_use]
    pub const fn velocities(self) -> usize {
        match self {
            Self::Turn { .. } | Self::Slide { .. } => 1,
            Self::Ball { .. } => 3,
        }
    }
}
