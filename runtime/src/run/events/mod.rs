//! Events of a run, and controllers at their period.
//!
//! `list.rs` has what happens in a run, behind one pointer. `guards.rs` shows its conditions, modes
//! and switches to the search for the first root of a step. `handling.rs` calls handlers and
//! controllers between two segments. `setters.rs` is what a user writes, `single_step.rs` the same
//! for a `Stepper`. `relay.rs` is a reading with two thresholds, `times.rs` has times that a user
//! gives. `modes.rs` finds the modes of interactions anew at every such instant, and
//! `stepper_modes.rs` for a `Stepper`. `sides.rs` turns laws that switch, `switching.rs` remembers
//! their sides, and `instants.rs` knows those of the time ahead.
//!
//! `sizes.rs` has what counts as nothing beside a reading or a motion.

pub(crate) mod changes;
pub(crate) mod context;
mod guards;
mod handling;
mod instants;
pub(crate) mod list;
mod modes;
mod relay;
pub(crate) mod setters;
mod sides;
mod single_step;
mod sizes;
pub(crate) mod stepper_modes;
pub(crate) mod switching;
pub(crate) mod times;
