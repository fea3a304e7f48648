//! What the benches and the program `study` share: the opponents of the generated kernels, and the terminal.

#![forbid(unsafe_code)]

pub mod compare;
pub mod extremes;
pub mod opponents;
pub mod terminal;
pub mod trade;
pub mod yardstick;
