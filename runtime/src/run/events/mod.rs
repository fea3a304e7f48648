//! Events of a run, and controllers at their period.
//!
//! `watch.rs` follows the sign of a reading, `root.rs` finds where it passes zero. `list.rs` has
//! what happens in a run, behind one pointer, so that a run is compiled once for all of it.
//! `search.rs` looks into a step, on the dense output of the method. `handling.rs` calls handlers
//! and controllers between two segments. `hybrid.rs` and `settings.rs` are what a user writes,
//! `single_step.rs` the same for a `Stepper`. `modes.rs` finds the modes of interactions anew at
//! every such instant, `looked.rs` where they end, and `stepper_modes.rs` both for a `Stepper`.
//! `sides.rs` turns laws that switch, `switching.rs` remembers their sides, and `instants.rs` knows
//! those of the time ahead.
//!
//! `sizes.rs` has what counts as nothing beside a reading or a motion.
//!
//! A sign, not a value, says that a reading has passed: it is right whatever a correction after the
//! step does to the last digits. Where a run starts at a zero, or a handler leaves a reading there,
//! the way of the motion says on which side it is. A return to the zero before any look has seen
//! the reading leave it is an event at once, and five of these are chattering.

pub(crate) mod changes;
pub(crate) mod context;
mod handling;
pub(crate) mod hybrid;
mod instants;
pub(crate) mod list;
mod looked;
mod modes;
pub(crate) mod root;
mod search;
mod settings;
mod sides;
mod single_step;
mod sizes;
pub(crate) mod stepper_modes;
pub(crate) mod switching;
pub(crate) mod watch;
