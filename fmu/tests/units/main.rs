//! Functional mock-up units: what is in them, and their files in C, compiled and run.

mod bounced;
mod driven;
mod opened;
mod refused;
mod turned;
mod unit;
mod variables;
