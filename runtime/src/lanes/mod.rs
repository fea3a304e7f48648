//! Several mechanisms in one evaluation.
//!
//! [`Lanes`] (`number.rs`) is a [`Scalar`](crate::Scalar): a kernel over such numbers evaluates as
//! many mechanisms as there are lanes. [`Ensemble`] (`ensemble.rs`) moves them by fixed steps
//! (`step.rs`), each with its own parameters, inputs and start. `equations.rs` is what a step moves;
//! `exchange.rs` brings numbers into lanes and back.
//!
//! A step is taken in all lanes at once and looked at once. A lane whose pivot vanished or whose
//! numbers are not finite takes the step again alone, by its own
//! [`Dynamics`](crate::dynamics::Dynamics): so its fault is that of a
//! [`Stepper`](crate::Stepper), and nothing is written twice. A lane that has stopped computes along
//! as a copy of one that goes on, so that its numbers do not hold the others up.

mod ensemble;
mod equations;
mod exchange;
mod number;
mod step;

pub use ensemble::Ensemble;
pub use equations::LaneEquations;
pub use number::Lanes;
