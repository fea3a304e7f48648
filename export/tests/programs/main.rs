//! Programs in C, compiled and run: by a compiler that nobody here wrote, against Rust.

mod bits;
mod compiled;
mod functions;
mod interface;
mod limits;
mod openings;
mod refused;
mod rollout;
