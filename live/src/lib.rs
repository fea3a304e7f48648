//! Mechanisms that run in the page that draws them: one HTML file with sliders, which opens from
//! disk, without a network or a server.
//!
//! The README has the program from nothing to a page. [`Live`] says what a page has, and
//! [`Live::page`] writes it.
//!
//! # How it works
//!
//! `cargo run` starts the program on the machine that compiled it. There [`Live::page`] compiles
//! the same program for WebAssembly and writes the module into the page. The page calls the `main`
//! of the module. There [`Live::page`] serves the mechanism to the page.
//!
//! A [`Session`] is what both run. It takes fixed steps, and knows no clock: the page says how
//! many. So what a page shows is what a [`Stepper`](holonom::Stepper) computes.
//!
//! # Sliders
//!
//! | | moves | when it is moved |
//! |---|---|---|
//! | [`Live::slider`] of a `#[param]` | a field of the struct | joints that it opens are closed from where they are; the run goes on |
//! | [`Live::slider`] of an `#[input]` | a field of the struct | the run goes on |
//! | [`Live::start_angle`], [`Live::start_displacement`] | a joint at the start | the run begins anew |
//!
//! A parameter is moved in parts of at most a twentieth of its range, and in smaller ones where
//! bodies would follow by more than 0.1 rad or a tenth of the mechanism. So loops stay on their
//! branch. A value that is refused leaves everything as it was, and the page shows the reason.
//!
//! Positions and velocities follow by the masses. In joint coordinates the rates of joints of the
//! tree stay what they were, as far as loops let them.
//!
//! # Limits
//!
//! - A page runs by a [`Stepper`](holonom::Stepper), which has no warnings but one: once in a
//!   picture a step is taken again in two halves. The page warns where the error of positions would
//!   exceed a hundredth of the mechanism in ten seconds.
//! - Events and controllers of a [`Simulation`](holonom::Simulation) are not run. Interactions and
//!   forces of a closure are, by [`Live::stepper`].
//! - The module has other elementary functions than the machine that compiled it: sines and cosines
//!   may differ in the last bit. The rest is the same, to the last bit.
//! - Files cannot be read in the module. Meshes are drawn by those that were written into the page,
//!   whatever the parameters are.

#![forbid(unsafe_code)]

mod error;
mod module;
mod page;
mod refused;
mod served;
mod session;
mod settings;
mod slider;
mod watch;

pub use error::LiveError;
pub use refused::Refused;
pub use session::Session;
pub use settings::Live;

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
