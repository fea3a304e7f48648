//! Joint coordinates: bodies move by what the joints of a spanning tree leave free, and only joints
//! that close loops stay as equations.

mod algebra;
mod align;
mod angles;
mod articulated;
pub mod beginning;
pub mod candidates;
mod certain;
mod dependent;
pub mod frames;
pub mod from_bodies;
mod handover;
pub mod kernels;
mod kinematics;
pub mod links;
mod mass;
mod reference;
mod regroup;
pub mod spanning;
pub mod system;
mod wrenches;
