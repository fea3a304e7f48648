//! Mechanisms of any size, mass and place, and runs of any length: each is right, or refused, or
//! with a warning in its report.
//!
//! Some of each sweep in `cargo test`, all of it with the feature `exhaustive`.

#![forbid(unsafe_code)]

mod long;
mod scales;

// What leaves nothing out is optimised, and takes no code that is not.
#[cfg(not(feature = "exhaustive"))]
use holonom_fixtures as _;
