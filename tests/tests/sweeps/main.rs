//! What was once wrong without a word, over formulations, tolerances and steps: each run is right,
//! or refused, or with a warning in its report.
//!
//! Some of each sweep in `cargo test`, all of it with the feature `exhaustive`.

#![forbid(unsafe_code)]

mod gradients;
mod singular;

// What leaves nothing out is optimised, and takes no code that is not.
#[cfg(not(feature = "exhaustive"))]
use holonom_fixtures as _;
