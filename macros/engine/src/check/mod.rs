//! Refusals: from what was written to what it means. The only pass that says no.

pub mod bodies;
pub mod joint;
mod joints;
pub mod mechanism;
pub mod number;
pub mod pairs;
