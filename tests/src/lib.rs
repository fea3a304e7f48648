//! What the tests of the workspace share: see `tests/tests`.

#![forbid(unsafe_code)]

use holonom::{
    Formulation, JointCoordinates, Real, Runs,
    dynamics::Problem,
    mechanism::{Absolute, Relative},
};

/// Whether nothing is left out of sweeps and long runs (`HOLONOM_EXHAUSTIVE=1`), or some of each is
/// tried.
#[must_use]
pub fn is_exhaustive() -> bool {
    std::env::var_os("HOLONOM_EXHAUSTIVE").is_some()
}

/// Methods that run a mechanism by a formulation in both coordinates.
pub trait RunsBoth<M, F, S = f64>:
    Runs<Problem<M, F, S, Absolute>> + Runs<Problem<M, F, S, Relative>>
where
    M: JointCoordinates,
    F: Formulation<S>,
    S: Real,
{
}

impl<I, M, F, S> RunsBoth<M, F, S> for I
where
    I: Runs<Problem<M, F, S, Absolute>> + Runs<Problem<M, F, S, Relative>>,
    M: JointCoordinates,
    F: Formulation<S>,
    S: Real,
{
}

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
