//! Equations of velocities: rolling, edges, and what their kernels are derivatives of.

#![forbid(unsafe_code)]

mod bicycle;
mod free;
mod kernels;
mod sleigh;

use holonom_fixtures as _;
