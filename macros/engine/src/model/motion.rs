//! How a joint moves, as its definition says.

/// One motion that a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// A rotation about a line.
    Turn {
        /// The direction of the line.
        axis: Direction,
        /// The place of the parameter of a point on it.
        point: usize,
    },
    /// A translation.
    Slide {
        /// Its direction.
        along: Direction,
    },
    /// A rotation about a line and a translation along it in proportion. The angle is counted over
    /// any number of turns by an equation of the same definition.
    Screw {
        /// The place of the axis among the parameters.
        axis: usize,
        /// The place of the parameter of a point on it.
        point: usize,
        /// The place of the parameter that is the translation for every right-handed turn.
        pitch: usize,
    },
    /// Every rotation about a point.
    Ball {
        /// The place of the point's parameter.
        point: usize,
    },
}

impl Motion {
    /// The number of its scalar motions.
    #[must_use]
    pub const fn freedoms(self) -> usize {
        match self {
            Self::Turn { .. } | Self::Slide { .. } | Self::Screw { .. } => 1,
            Self::Ball { .. } => 3,
        }
    }
}

/// A direction of a definition: an axis, or a normal of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction {
    /// The place of the axis among the parameters.
    pub parameter: usize,
    /// First (0) or second (1) normal; `None` for the axis itself.
    pub normal: Option<usize>,
}

impl Direction {
    /// The axis itself.
    #[must_use]
    pub const fn axis(parameter: usize) -> Self {
        Self {
            parameter,
            normal: None,
        }
    }
}
