//! What is read from a state, and what acts on it, by handle.
//!
//! Readings take the state of the bodies, in either coordinates. A state stores orientations and
//! rates in principal axes; access by handle converts to the axes of the user.

mod acceleration;
pub(crate) mod access;
pub(crate) mod angles;
pub(crate) mod load;
pub(crate) mod reaction;
pub(crate) mod unwrapped;
pub(crate) mod view;
pub(crate) mod viewed;

pub use angles::{BryantAngles, EulerAngles, RollPitchYaw};
pub use load::{AppliedForces, ForceLaw, NoForces};
pub use unwrapped::UnwrappedAngle;
pub use view::OwnedView;
pub use viewed::Viewed;
