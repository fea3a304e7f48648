//! The modes of interactions.

use crate::math::scalar::Real;

/// The mode of an [`Interaction`](crate::run::Interaction).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum InteractionMode {
    /// Between two limits, and friction of a contact that is open: no effort.
    Free,
    /// On the lower limit, which pushes upwards.
    AtLower,
    /// On the upper limit, which pushes downwards.
    AtUpper,
    /// Held by friction.
    Sticking,
    /// Friction against a positive rate.
    SlidingUp,
    /// Friction against a negative rate.
    SlidingDown,
    /// A brake or a clutch that is not engaged.
    Released,
    /// Friction of a contact, against its slip.
    Slipping,
}

impl InteractionMode {
    /// Whether it keeps the quantity where it is.
    pub(crate) fn holds(self) -> bool {
        matches!(self, Self::AtLower | Self::AtUpper | Self::Sticking)
    }

    /// Whether its friction takes energy.
    pub(crate) fn slides(self) -> bool {
        matches!(self, Self::SlidingUp | Self::SlidingDown | Self::Slipping)
    }

    /// The sign of the rate at which it slides.
    pub(crate) fn sliding<S: Real>(self) -> Option<S> {
        match self {
            Self::SlidingUp => Some(S::one()),
            Self::SlidingDown => Some(-S::one()),
            _ => None,
        }
    }
}
