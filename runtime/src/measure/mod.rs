//! What is read from a state, and what acts on it, by handle.

pub(crate) mod access;
pub(crate) mod load;
pub(crate) mod reaction;
pub(crate) mod view;

pub use load::{AppliedForces, ForceLaw, NoForces};
