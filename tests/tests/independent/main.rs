//! The equations of motion in chosen coordinates. Arms are in `urdf/tests/motion/equations.rs`.

#![forbid(unsafe_code)]

mod cardan;
mod choice;
mod continuation;
mod counts;
mod derivatives;
mod derivatives_reference;
mod differences;
mod equilibrium;
mod found;
mod identification;
mod linear;
mod loops;
mod momenta;
mod reference;
mod regressor;
mod regulator;
mod singular;
mod trim;

use holonom_fixtures as _;
