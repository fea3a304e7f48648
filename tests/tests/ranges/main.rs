//! Mechanisms of any size, mass and place, and runs of any length: each is right, or refused, or
//! with a warning in its report.
//!
//! Some of each sweep in `cargo test`, all of it with `HOLONOM_EXHAUSTIVE=1`.

#![forbid(unsafe_code)]

mod long;
mod scales;

use holonom_fixtures as _;
