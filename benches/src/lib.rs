//! What the benches and the program `study` share: the opponents of the generated kernels, and the
//! terminal.

#![forbid(unsafe_code)]

#[cfg(feature = "compare")]
pub mod compare;
#[cfg(feature = "extremes")]
pub mod extremes;
pub mod measures;
pub mod opponents;
pub mod output;
pub mod terminal;
#[cfg(feature = "trade")]
pub mod trade;
#[cfg(any(feature = "compare", feature = "trade"))]
pub mod yardstick;
