//! Equations of velocities: rolling, edges, and what their kernels are derivatives of.

#![forbid(unsafe_code)]

mod bicycle;
mod bowl;
mod disc;
mod free;
mod kernels;
mod rattleback;
mod robot;
mod sleigh;
mod snakeboard;

use holonom_fixtures as _;
