//! Every joint, driver and force of the library as generated code, judged by the run-time
//! assembler, by dual numbers and by mechanics.

#![forbid(unsafe_code)]
#![recursion_limit = "256"]

#[macro_use]
mod describe;

mod agreement;
mod comparison;
mod course;
mod data;
mod forces;
mod freedom;
mod kernels;
mod laws;
mod library;
mod mechanics;
mod motion;
mod states;
mod turns;

use holonom_fixtures as _;
