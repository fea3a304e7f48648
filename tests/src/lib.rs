//! What the tests of the workspace share: see `tests/tests`.

#![forbid(unsafe_code)]

/// Whether nothing is left out of sweeps and long runs (feature `exhaustive`), or some of each is
/// tried.
pub const IS_EXHAUSTIVE: bool = cfg!(feature = "exhaustive");

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
