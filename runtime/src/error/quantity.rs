//! What a joint's equations are about, and what is said of one that is open.

use core::fmt;

use crate::error::readable::Measured;

/// What a joint's equations are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// A length (m).
    Length,
    /// An angle (rad).
    Angle,
    /// A speed (m/s).
    Speed,
    /// An angular velocity (rad/s).
    AngularVelocity,
}

impl Quantity {
    /// Its unit.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Angle => "rad",
            Self::Speed => "m/s",
            Self::AngularVelocity => "rad/s",
        }
    }

    /// Whether it is a rate.
    pub(super) const fn is_rate(self) -> bool {
        matches!(self, Self::Speed | Self::AngularVelocity)
    }
}

/// A joint that is open, or whose bodies move against it.
pub(super) struct Open {
    pub(super) joint: &'static str,
    pub(super) quantity: Quantity,
    /// By how much, in the unit of the quantity.
    pub(super) violation: f64,
}

impl fmt::Display for Open {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (joint, unit) = (self.joint, self.quantity.unit());
        let violation = Measured(self.violation);
        if self.quantity.is_rate() {
            write!(
                f,
                "the bodies of joint `{joint}` move against it at {violation} {unit}"
            )
        } else {
            write!(f, "joint `{joint}` is open by {violation} {unit}")
        }
    }
}
