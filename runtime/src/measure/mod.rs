//! What is read from a state, and what acts on it, by handle.
//!
//! Readings take the state of the bodies, in either coordinates. A state stores orientations and
//! rates in principal axes; access by handle converts to the axes of the user.

mod acceleration;
pub(crate) mod access;
mod angle_rates;
pub(crate) mod angles;
pub(crate) mod interacting;
pub(crate) mod load;
pub(crate) mod momentum;
#[cfg(feature = "serde")]
pub(crate) mod named_state;
mod points;
pub(crate) mod reaction;
pub(crate) mod scaled;
#[cfg(feature = "mint")]
mod to_mint;
mod two_angles;
pub(crate) mod unwrapped;
pub(crate) mod view;
pub(crate) mod viewed;
#[cfg(feature = "serde")]
pub(crate) mod written;

pub use angle_rates::{BryantAngleRates, EulerAngleRates, RollPitchYawRates};
pub use angles::{BryantAngles, EulerAngles, RollPitchYaw};
pub use interacting::{Heeding, Interacting, Unlimited};
pub use load::{AppliedForces, ForceLaw, NoForces};
#[cfg(feature = "serde")]
pub use named_state::NamedState;
pub use scaled::ScaledCapacity;
pub use unwrapped::UnwrappedAngle;
pub use view::OwnedView;
pub use viewed::Viewed;

pub use crate::mechanism::readout::ContactPoint;
