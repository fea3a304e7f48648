//! Films of mechanisms: a run, recorded into one HTML page that opens from disk, without a network
//! or a server.
//!
//! ```
//! use holonom::prelude::*;
//! use holonom_film::Film;
//!
//! #[derive(Mechanism)]
//! #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
//! struct Pendulum {
//!     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
//!     rod: Body,
//!     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
//!     hinge: Revolute,
//!     #[point(on = rod, at = [0.0, 1.0, 0.0])]
//!     tip: Point,
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let pendulum = Pendulum::default();
//! let handles = Pendulum::HANDLES;
//! let mut film = Film::new();
//! film.trace(handles.tip);
//! let report = Simulation::new(&pendulum, StandardLagrange, DormandPrince::default()).run(
//!     0.0..=5.0,
//!     every(1.0 / 60.0),
//!     |sample| {
//!         film.record(sample);
//!         film.reading("angle", "rad", sample.angle(handles.hinge));
//!     },
//! )?;
//! film.warnings(&report.warnings());
//! # let folder = std::env::temp_dir();
//! film.save(folder.join("pendulum.html"))?;
//! # Ok(())
//! # }
//! ```
//!
//! A picture needs no geometry: the generator knows the points and axes of every joint
//! ([`Report::markers`](holonom::Report::markers)). A body is made of bars between these points and
//! its centre of mass, and of a plate where three or more span one. One that is described by
//! [shapes](holonom::Report::shapes) looks like these. A joint looks like its kind, a spring is a
//! coil. A named point is a small mark with its name. So a wrong point is seen.
//!
//! The page plays, loops and seeks, and is turned by mouse or touch. It shows traces, the readings
//! over time, the warnings of the run, and reactions as arrows where they were recorded
//! ([`Film::with_reactions`]). Keys: space, arrows, `F` fit, `I`
//! `X` `Y` `Z` views, `O` orthographic, `R` reactions, `T` traces, `P` points, `H` parts, `D` dark.
//!
//! [`Film::save_gltf`] writes the same motion for Blender, game engines and slides.
//! [`Sketch`] draws the reference configuration, before anything runs.
//!
//! The drawing is done by three.js, of which the page holds what it needs: below 700 kB.

#![forbid(unsafe_code)]

mod anchors;
mod description;
mod fault;
mod gears;
mod gltf;
mod labels;
mod page;
mod picture;
mod record;
mod reference;
mod sketch;
mod solid;
mod subject;

pub use fault::FilmError;
pub use record::Film;
pub use reference::Sketch;

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
