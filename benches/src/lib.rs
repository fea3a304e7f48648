//! What the benches and the program `study` share: the baselines of the generated kernels, and the
//! terminal.

#![forbid(unsafe_code)]

#[cfg(feature = "arms")]
pub mod arms;
pub mod baselines;
#[cfg(feature = "compare")]
pub mod compare;
#[cfg(feature = "ensemble")]
pub mod ensemble;
#[cfg(feature = "estimate")]
pub mod estimate;
#[cfg(feature = "extremes")]
pub mod extremes;
pub mod measures;
pub mod output;
#[cfg(any(feature = "arms", feature = "compare", feature = "trade"))]
pub mod reference_kernel;
#[cfg(feature = "show")]
pub mod show;
pub mod terminal;
#[cfg(feature = "trade")]
pub mod trade;
