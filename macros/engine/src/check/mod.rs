//! Refusals: from what was written to what it means. The only pass that says no.

pub mod bodies;
mod expression;
mod functions;
pub mod joint;
mod joints;
pub mod kinds;
mod laws;
pub mod mechanism;
pub mod number;
pub mod pairs;
mod redundant;
mod values;
