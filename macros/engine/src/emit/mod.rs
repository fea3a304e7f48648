//! Kernels to Rust. Nothing here can fail: what could be wrong was refused before.

mod coordinates;
pub mod documentation;
pub mod fallback;
mod inputs;
pub mod joint;
mod joint_report;
mod likes;
pub mod mechanism;
pub mod parameters;
mod parts;
mod readouts;
pub mod report;
mod rows;
pub mod solution;
pub mod store;
pub mod straight_line;
