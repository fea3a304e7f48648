//! What was once wrong without a word, over formulations, tolerances and steps: each run is right,
//! or refused, or with a warning in its report.
//!
//! Some of each sweep in `cargo test`, all of it with `HOLONOM_EXHAUSTIVE=1`.

#![forbid(unsafe_code)]

mod gradients;
mod singular;

use holonom_fixtures as _;
