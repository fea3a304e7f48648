//! Tests of what runs a mechanism, on one that is written by hand and knows nothing of the
//! generator.

mod accelerations;
mod access;
mod correction;
mod counters;
mod crank;
mod dense;
mod driven;
mod loads;
mod messages;
mod momentum;
pub(crate) mod numbers;
mod observer;
#[cfg(feature = "recorder")]
mod recorder;
mod rod;
mod run;
mod steps;
