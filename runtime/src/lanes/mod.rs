//! Several mechanisms in one evaluation.
//!
//! [`Lanes`] (`number.rs`) is a [`Scalar`](crate::Scalar): a kernel over such numbers evaluates as
//! many mechanisms as there are lanes. [`Ensemble`] (`ensemble.rs`) moves them by fixed steps
//! (`step.rs`), each with its own parameters, inputs and start. `equations.rs` is what a step
//! moves; `exchange.rs` brings numbers into lanes and back.
//!
//! A step is taken in all lanes at once, and checked once. Where a pivot vanished or a number is
//! not finite, the lane takes the step again alone, by its own
//! [`Dynamics`](crate::dynamics::Dynamics). So its fault is that of a [`Stepper`](crate::Stepper).
//! A lane that has stopped computes along as a copy of one that goes on. So its numbers, which may
//! be of any size, do not hold the others up.

mod ensemble;
mod equations;
mod exchange;
mod number;
mod step;

pub use ensemble::Ensemble;
pub use equations::LaneEquations;
pub use number::Lanes;
