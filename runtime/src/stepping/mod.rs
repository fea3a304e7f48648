//! Steps of a run: an integration under way, seen as motion of bodies.
//!
//! `marching.rs` is what a run asks of an integration, whatever the method, the formulation, the
//! forces and the coordinates. It stands behind a pointer, so that a run is compiled once for a
//! mechanism and a number type; `march.rs` is behind it. Single steps and lanes have no part in it:
//! they are compiled for what they step.
//!
//! `interval.rs` is a step that was taken, with the bodies at any time in it. `followed.rs` counts
//! turns within a step where its ends tell too little.
//!
//! Whatever ends a step early is a guard (`guard.rs`): a number with the side of zero on which it
//! was. `watch.rs` remembers the side, `root.rs` takes the first root of all guards, `locate.rs`
//! finds one between two times, and `modes.rs` are the guards of interactions.
//!
//! A sign, not a value, says that a reading has passed: it is right whatever a correction after the
//! step does to the last digits. Where a run starts at a zero, or a handler leaves a reading there,
//! the way of the motion says on which side it is. A return to the zero before any look has seen
//! the reading leave it is an event at once, and five of these are chattering.
//!
//! `deferred.rs` and `branching.rs` are of the coordinates of an integration: when its states
//! become those of bodies, and what it does near to a singular configuration.

pub(crate) mod branching;
mod deferred;
pub(crate) mod followed;
pub(crate) mod guard;
pub(crate) mod interval;
pub(crate) mod locate;
pub(crate) mod march;
pub(crate) mod marching;
pub(crate) mod modes;
pub(crate) mod root;
pub(crate) mod watch;
