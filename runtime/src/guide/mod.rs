//! The guide: how to describe a mechanism, run it and read the results.
//!
//! You want to simulate a mechanism. Copy [the first program](#a-first-program), find your task in
//! [`recipes`], and open the page that goes further:
//!
//! | page | what it has |
//! |---|---|
//! | [`recipes`] | short programs by task: bring a robot from URDF, read a reaction, drive a hinge, start elsewhere, write CSV |
//! | [`coming_from`] | names for users of Pinocchio, MuJoCo, Drake, Modelica and Adams; what is missing |
//! | [`mechanism`] | bodies, joints and the start; how to choose joints so that the degrees of freedom are right |
//! | [`shapes`] | bodies by shapes and densities, rotations by words: no centre or inertia by hand |
//! | [`parts`] | assemblies: a left and a right, several equal legs, each described once |
//! | [`mod@reference`] | the whole language on one page: every attribute, every joint with axes, zeros and signs |
//! | [`joint`] | how to define your own joint |
//! | [`rolling`] | wheels, balls and skates; equations of velocities of your own |
//! | [`forces`] | gravity, springs, actuators, closures; drivers, kinematics, inverse dynamics; power and energy |
//! | [`data`] | cams, recorded motions and curves of forces from tables; joints driven from outside |
//! | [`events`] | stops, switches and limits at their exact time; controllers at their period |
//! | [`switches`] | forces that jump or bend: backlash, saturation, pulses, ropes; `sign abs min max if` in laws |
//! | [`states`] | numbers with a rate of their own: motor currents, filters, hydraulic pressures, integrals of controllers |
//! | [`contact`] | limits with impacts, contacts with friction, ropes, dry friction, brakes and clutches |
//! | [`parameters`] | numbers known only at run time, and inputs that change at every step |
//! | [`results`] | what can be read, with units, frames and signs; states in files |
//! | [`restart`] | checkpoints of a run, from which it goes on exactly; a motion that can be asked at any time |
//! | [`trust`] | whether to trust a result: the warnings of a run, starts, steps and budgets |
//! | [`reactions`] | the reaction of a joint: on which body, about which point; body axes and principal axes |
//! | [`redundant`] | redundant equations, singular configurations, and joints that avoid both |
//! | [`embedded`] | fixed steps without a heap or the standard library, single precision |
//! | [`ensembles`] | many mechanisms at once, each with its own numbers; all cores, clusters |
//! | [`choosing`] | formulations and integrators |
//! | [`accuracy`] | measured costs of accuracy; which setting suffices for an error; where the numerics fail |
//! | [`equations`] | M, h, J, inverse dynamics in coordinates by handle; linear models, modes |
//! | [`equilibria`] | where a mechanism rests, which inputs hold it, at which load it snaps through |
//! | [`sensitivities`] | how readings change with parameters, inputs and the start; parameters from measurements |
//! | [`identification`] | masses, centres and inertias from measured torques; regressor, base parameters |
//! | [`coordinates`] | absolute or joint coordinates: costs and properties of each |
//!
//! # A first program
//!
//! Begin in the folder that contains the repository under the name `holonom`. Call
//! `cargo new pendulum`, and write into `pendulum/Cargo.toml`
//!
//! ```toml
//! [dependencies]
//! # By its path: it is not published yet. Then: holonom = "0.1"
//! holonom = { path = "../holonom/runtime" }
//! ```
//!
//! and into `pendulum/src/main.rs`
//!
//! ```
//! use holonom::prelude::*;
//!
//! /// A steel rod of 1 m on a hinge about x, released from the horizontal.
//! #[derive(Mechanism)]
//! #[mechanism(gravity = [0.0, 0.0, -9.81])]
//! struct Pendulum {
//!     #[body(mass = 7.02, inertia = [0.5855, 0.00105, 0.5855], position = [0.0, 0.5, 0.0])]
//!     rod: Body,
//!     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
//!     hinge: Revolute,
//! }
//!
//! // Checked when the program is compiled.
//! const _: () = assert!(Pendulum::REPORT.degrees_of_freedom == 1);
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let pendulum = Pendulum::default();
//!     let handles = Pendulum::HANDLES;
//!     let ode45 = DormandPrince::new(Tolerance { relative: 1e-9, absolute: 1e-9 });
//!     let report = pendulum
//!         .simulation(StandardLagrange, ode45)
//!         .assembled()                        // puts the start on the constraints
//!         .projection(Projection::default())  // and every state that follows
//!         .run(0.0..=2.0, every(0.1), |sample| -> Result<(), Fault> {
//!             let reaction = sample.reaction(handles.hinge, handles.rod)?;
//!             let (time, angle) = (sample.time(), sample.angle(handles.hinge));
//!             println!("{time:.1} s: {angle:8.4} rad, {:8.3} N", reaction.force.norm());
//!             Ok(())
//!         })?;
//!     assert!(report.worst_violation < 1e-24);
//!     Ok(())
//! }
//! ```
//!
//! It prints a line for each report. With `every(0.02)` they are dense enough for pictures of the
//! angle and of the force in the hinge. At the lowest point it is two and a half times the weight:
//!
#![doc = include_str!("first_angle.svg")]
//!
#![doc = include_str!("first_reaction.svg")]
//!
//! `Recorder` writes such columns into a CSV file ([`results`]). `holonom-film` draws the mechanism
//! as it moves.
//!
//! The examples of the pages leave `fn main` out. Structs, `joint!` and `force!` belong outside it,
//! the rest inside. Every example is compiled and run with the tests of the crate, and asserts the
//! numbers that the text gives. Every equation is shown twice: typeset, where the page could load
//! KaTeX, and as plain text.

// The scripts stand in the pages and not in the header of all of rustdoc's: then every build of the
// documentation typesets, here, at docs.rs, and beside a user's own crate.

#[doc = include_str!("recipes.md")]
pub mod recipes {}

#[doc = include_str!("coming_from.md")]
pub mod coming_from {}

#[doc = include_str!("mechanism.md")]
#[doc = include_str!("typeset.html")]
pub mod mechanism {}

#[doc = "Describe bodies by shapes and rotations by words: mass, centre, inertia and axes follow."]
#[doc = ""]
#[doc = include_str!("shapes.svg")]
#[doc = ""]
#[doc = include_str!("shapes.md")]
pub mod shapes {}

#[doc = "Describe a part once and use it several times: mirrored, turned, moved, with other parameters."]
#[doc = ""]
#[doc = include_str!("parts.svg")]
#[doc = ""]
#[doc = include_str!("parts.md")]
pub mod parts {}

#[doc = "The whole language on one page: every attribute and its values; every joint, driver and"]
#[doc = "force with its axes, equations, zeros and signs."]
#[doc = ""]
#[doc = include_str!("joints.svg")]
#[doc = ""]
#[doc = include_str!("reference.md")]
#[doc = include_str!("typeset.html")]
pub mod reference {}

#[doc = include_str!("joint.md")]
#[doc = include_str!("typeset.html")]
pub mod joint {}

#[doc = "You want wheels that roll, balls on plates, skates and carts: equations of velocities."]
#[doc = ""]
#[doc = include_str!("rolling.svg")]
#[doc = ""]
#[doc = include_str!("rolling.md")]
pub mod rolling {}

#[doc = include_str!("forces.md")]
#[doc = include_str!("typeset.html")]
pub mod forces {}

#[doc = include_str!("data.md")]
pub mod data {}

#[doc = include_str!("events.md")]
pub mod events {}

#[doc = include_str!("states.md")]
pub mod states {}

#[doc = include_str!("switches.md")]
pub mod switches {}

#[doc = "You want stops, impacts, dry friction, brakes and clutches, and shapes that touch."]
#[doc = ""]
#[doc = include_str!("contacts.svg")]
#[doc = ""]
#[doc = include_str!("contact.md")]
pub mod contact {}

#[doc = include_str!("parameters.md")]
pub mod parameters {}

#[doc = include_str!("results.md")]
pub mod results {}

#[doc = include_str!("restart.md")]
pub mod restart {}

#[doc = include_str!("trust.md")]
pub mod trust {}

#[doc = include_str!("reactions.md")]
#[doc = include_str!("typeset.html")]
pub mod reactions {}

#[doc = include_str!("redundant.md")]
pub mod redundant {}

#[doc = include_str!("embedded.md")]
pub mod embedded {}

#[doc = include_str!("ensembles.md")]
pub mod ensembles {}

#[doc = include_str!("choosing.md")]
#[doc = include_str!("typeset.html")]
pub mod choosing {}

#[doc = include_str!("accuracy.md")]
pub mod accuracy {}

#[doc = "The equations of motion in chosen coordinates: mass matrix, inverse dynamics, Jacobians,"]
#[doc = "linear models."]
#[doc = ""]
#[doc = include_str!("equations.md")]
pub mod equations {}

#[doc = include_str!("equilibria.md")]
pub mod equilibria {}

#[doc = include_str!("sensitivities.md")]
pub mod sensitivities {}

#[doc = include_str!("identification.md")]
pub mod identification {}

#[doc = include_str!("coordinates.md")]
pub mod coordinates {}
