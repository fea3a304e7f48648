//! Mechanisms of [`holonom`] as programs in C: for controllers whose compiler is one of C, for
//! GPUs, and for other simulators.
//!
//! A kernel has no branch on the numbers that it computes with. Called once with numbers that write
//! down what is computed with them ([`Traced`]), it is its own text. So are a whole step of a
//! method and what is read of a state. What is written has the numbers of Rust to the last bit.
#![forbid(unsafe_code)]

mod c;
mod derivative;
mod error;
mod export;
mod fold;
mod interface;
mod joints;
mod layout;
mod linear;
mod names;
mod number;
mod program;
mod system;
mod tape;
mod values;

pub use c::Source;
pub use error::ExportError;
pub use export::{Export, ExportExt};
pub use interface::{Coordinate, Interface, Quantity};
pub use number::{Double, Precision, Single, Traced};
#[doc(hidden)]
pub use system::Called;
