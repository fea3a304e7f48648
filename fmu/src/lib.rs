//! Mechanisms of [`holonom`] as functional mock-up units of FMI 3.0, for other simulators: for
//! model exchange and for co-simulation, as sources and as a binary of the platform that wrote
//! them.
//!
//! The equations are those that [`holonom_export`] writes in C. The interface in front of them is
//! always the same, over tables of what the mechanism has. [`Fmu`] has an example.
//!
//! Source: Modelica Association, *Functional Mock-up Interface Specification*, version 3.0.
#![forbid(unsafe_code)]

mod archive;
mod binary;
mod description;
mod error;
mod fmu;
mod model;
mod units;
mod variables;

pub use error::FmuError;
pub use fmu::{Fmu, FmuExt, Written};

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
