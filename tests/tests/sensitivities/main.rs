//! Derivatives of runs by parameters, inputs and the start.

#![forbid(unsafe_code)]

mod adjoint;
mod closed_forms;
mod differences;
mod estimated;
mod refused;
