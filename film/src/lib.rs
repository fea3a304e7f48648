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
//! # The page
//!
//! The page plays, loops and seeks, and is turned by mouse or touch. A plane mechanism is first
//! seen along its normal. `Fit` shows what has mass; the far ends of springs may be outside. The
//! corner shows the axes of the ground: x red, y green, z blue.
//!
//! Point at a part, or touch it, to see its name. Click it to select it. Of a body the page then
//! shows the position of its centre of mass, its speed and its angular speed, and the camera can
//! follow it. Of a joint it shows the reaction and its graph, where it was recorded
//! ([`Film::with_reactions`]): the force on the second of its bodies, or on the first where the
//! second is the ground, by global axes. The wheel zooms in graphs; a double click shows the whole
//! run again. `PNG` saves what is seen, `Video` the film from its start to its end.
//!
//! | key | does |
//! |---|---|
//! | space, arrows, Home, End | play or pause, a frame back or on, first and last frame |
//! | `L` | loop |
//! | `F` `I` `X` `Y` `Z` | fit; views from a corner and along the axes |
//! | `O` | orthographic |
//! | `C` | the camera follows the selected body |
//! | Escape | select nothing |
//! | `A` | axes of bodies at their centres of mass |
//! | `R` `T` `P` | reactions, traces, named points |
//! | `G` | the other run ([`Film::ghost`]) |
//! | `H` | list of parts: a click hides one, a double click selects it |
//! | `S` `V` | save a picture, a video |
//! | `D` | light or dark |
//!
//! The same page, with a module that `holonom-live` compiles, runs on under sliders.
//!
//! # Meshes
//!
//! With the feature `meshes`, bodies look like meshes. `Film::urdf_meshes` draws those of a URDF
//! file on the bodies of `holonom::urdf!`:
//!
#![cfg_attr(feature = "meshes", doc = "```no_run")]
#![cfg_attr(not(feature = "meshes"), doc = "```ignore")]
//! # use holonom_film::{Film, UrdfMeshes};
//! # fn meshes<M: holonom::Mechanism>(mut film: Film<M>) -> Result<(), holonom_film::FilmError> {
//! let drawn = film.urdf_meshes(&UrdfMeshes::of("robot.urdf"))?;
//! println!("{drawn}");
//! # Ok(())
//! # }
//! ```
//!
//! `Film::mesh` draws a body by a file of its own. A body that is described by a `mesh(..)` looks
//! like it. STL, OBJ and Collada files are read. Meshes with too many triangles are simplified, so
//! that a page of a robot stays below 2 MB.
//!
//! # Other files
//!
//! With the feature `gltf`, `Film::save_gltf` writes the same motion for Blender, game engines and
//! slides. [`Film::save_svg`] writes a moving picture. [`Sketch`] draws the reference
//! configuration, before anything runs.
//!
//! The drawing is done by three.js, of which the page holds what it needs: below 700 kB.

#![forbid(unsafe_code)]

mod anchors;
mod description;
mod fault;
mod gears;
#[cfg(feature = "gltf")]
mod gltf;
mod json;
mod labels;
#[cfg(feature = "meshes")]
mod meshes;
mod page;
mod picture;
mod record;
mod reference;
mod sketch;
#[cfg(feature = "gltf")]
mod solid;
mod subject;

pub use fault::FilmError;
#[cfg(feature = "meshes")]
pub use meshes::{Drawn, UrdfMeshes};
pub use record::Film;
pub use reference::Sketch;

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
