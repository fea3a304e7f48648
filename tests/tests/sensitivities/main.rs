//! Derivatives of runs by parameters, inputs and the start.

#![forbid(unsafe_code)]

mod adjoint;
mod at_rest;
mod backwards;
mod closed_forms;
mod differences;
mod estimated;
mod refused;

use holonom_fixtures as _;
