//! Mechanisms with published data: to use, and to copy from.
//!
//! | model | what it is | source |
//! |---|---|---|
//! | [`RodPendulum`] | a rod on a hinge | Flores 2015, chapter 15 |
//! | [`HeavyTop`] | a spinning top on a ball joint, 150 rad/s | Brüls, Cardona and Arnold 2012 |
#![no_std]
#![forbid(unsafe_code)]

mod heavy_top;
mod rod_pendulum;

pub use heavy_top::HeavyTop;
pub use rod_pendulum::RodPendulum;
