//! Limits, dry friction, brakes and clutches: efforts that are found by complementarity.
//!
//! An unknown effort along a quantity of the mechanism (`quantity.rs`) costs one further solution
//! of the factorised system of the equations of motion (`columns.rs`). What a unit of it does to
//! the rates of all quantities is a column of the Delassus matrix: in the metric of the mass, with
//! the constraints kept. It is the same for accelerations by efforts and for velocities by
//! impulses. Every choice of modes is then a small problem with bounds (`box_problem.rs`, which
//! knows no mechanism).
//!
//! `impulse.rs` is the impact of an event of the user's own. Points and planes are in `place.rs`.
//!
//! Within a step the modes are fixed (`efforts.rs`). Between steps `switch.rs` finds impulses, then
//! `choice.rs` modes. All of them ask `law.rs` what efforts and impulses are possible.
//! `interaction.rs` is what a user writes, and `checked.rs` refuses settings of it. `handle.rs` is
//! what it is called by, `status.rs` what a run knows of it.
//!
//! `described.rs` has the limits of a description, and `traced.rs` what programs in other languages
//! need of them. `remembered.rs` hands their statuses to checkpoints.
//!
//! Friction by the load of its joint: `bearing.rs` reads the load, `loads.rs` has it as a function
//! of efforts, `slipping.rs` solves for what slides, `capacities.rs` for what may stick.
//!
//! Contacts: `contact.rs` is what a user writes, `shape.rs` how shapes lie and move against what
//! they touch (`place.rs`, `sphere.rs`, `cam.rs` over `profile.rs`). `reader.rs` looks once for all
//! that asks. Their friction: `cones.rs`, over `cone_problem.rs` and `tied.rs`, which know no
//! mechanism, `slip.rs`, and `pace.rs`, by which steps follow slip that turns near its zero
//! (`paced.rs`). `jam.rs` tells where friction that slips has no effort any more.
//!
//! The reasons are in `docs/decisions/027-interactions.md`, `032-friction-by-load.md` and
//! `051-contacts-with-friction.md`.

pub(crate) mod bearing;
mod box_problem;
pub(crate) mod cam;
mod capacities;
pub(crate) mod checked;
mod choice;
pub(crate) mod columns;
mod cone_problem;
mod cones;
mod contact;
pub(crate) mod described;
pub(crate) mod efforts;
pub(crate) mod handle;
pub(crate) mod impulse;
pub(crate) mod interaction;
pub(crate) mod jam;
mod law;
pub(crate) mod loads;
pub(crate) mod mode;
mod motion;
mod pace;
pub(crate) mod paced;
pub(crate) mod place;
mod profile;
pub(crate) mod quantity;
mod reader;
mod remembered;
pub(crate) mod scene;
pub(crate) mod shape;
mod sizes;
mod slip;
mod slipping;
pub(crate) mod sphere;
pub(crate) mod status;
mod switch;
pub(crate) mod task;
mod tied;
pub(crate) mod traced;
