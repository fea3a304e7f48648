//! Mechanisms over joints of other crates, beside built-in ones of the same names, where `holonom`
//! bears a third name.
//!
//! What the derive and `joint!` write must not disturb a crate that refuses every warning.
#![no_std]
#![forbid(unsafe_code)]
#![deny(
    warnings,
    future_incompatible,
    let_underscore,
    nonstandard_style,
    rust_2018_idioms,
    rust_2024_compatibility,
    unused,
    elided_lifetimes_in_paths,
    explicit_outlives_requirements,
    missing_copy_implementations,
    missing_debug_implementations,
    missing_docs,
    single_use_lifetimes,
    trivial_casts,
    trivial_numeric_casts,
    unnameable_types,
    unreachable_pub,
    unused_lifetimes,
    unused_qualifications,
    unused_results,
    variant_size_differences,
    clippy::all,
    clippy::nursery,
    clippy::pedantic
)]

#[cfg(test)]
extern crate std;

mod crane;
mod linkage;
pub mod own_names;
pub mod robots;
pub mod ropes;
pub mod swings;
mod telescope;

pub use crane::{Crane, sway};
pub use linkage::{HALF, Linkage};
pub use telescope::{Crossed, Probe};

#[cfg(test)]
mod tests;
