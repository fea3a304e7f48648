//! Results that were once wrong without a word: each is right now, or refused, or has a warning
//! from the report.

#![forbid(unsafe_code)]

mod between;
mod clock;
mod digits;
mod laws;
mod limits;
mod orbits;
mod orientation;
mod origins;
mod outside;
mod phase_error;
mod readings;
mod start;
mod states;
mod stopped;
mod told;
mod turns;

use holonom_fixtures as _;
