//! Robots from URDF files: prints the annotated struct that [holonom](https://docs.rs/holonom)
//! takes, as source to read and to change.
//!
//! To take a file in place, call `holonom::urdf!`, which is there with the feature `urdf` of
//! `holonom`. Fields and constants are the same:
//!
//! ```
//! use holonom::prelude::*;
//!
//! holonom::urdf! { struct Arm = "arm.urdf"; }
//!
//! assert_eq!(Arm::REPORT.degrees_of_freedom, 2);
//! assert_eq!(Arm::TIP_ORIGIN, [0.0, 0.0, 0.15]);
//! assert_eq!(Arm::HANDLES.tip.name(), "tip");
//! ```
//!
//! ```
//! use holonom_urdf::{Options, Robot};
//!
//! let text = r#"
//!     <robot name="pendulum">
//!       <link name="base"/>
//!       <link name="rod">
//!         <inertial>
//!           <origin xyz="0 0.5 0"/> <mass value="2"/>
//!           <inertia ixx="0.17" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.17"/>
//!         </inertial>
//!       </link>
//!       <joint name="hinge" type="continuous">
//!         <parent link="base"/> <child link="rod"/> <axis xyz="1 0 0"/>
//!       </joint>
//!     </robot>"#;
//! let mechanism = Robot::parse(text)?.mechanism(&Options::default())?;
//! assert_eq!(mechanism.bodies[0].position, [0.0, 0.5, 0.0]);
//!
//! let source = mechanism.to_string();
//! assert!(source.contains("pub struct Pendulum {"));
//! assert!(source.contains("hinge: Revolute,"));
//! assert!(source.contains("pub hinge_torque: f64,"));
//! # Ok::<(), holonom_urdf::Faults>(())
//! ```
//!
//! The command does the same with files: `holonom-urdf arm.urdf > arm.rs`. It has the options
//! `--floating`, `--passive`, `--round-angles`, `--accept-inertia` and `--name`. Those of the macro
//! are `#[urdf(floating, passive, round_angles, inertia = "as given")]` on the struct.
//!
//! # What becomes of the elements
//!
//! | in the file | in the struct |
//! |---|---|
//! | link that a joint moves | `Body` with the axes of the link's frame; inertia turned by the `rpy` of its inertial frame |
//! | root link | the ground; with [`Options::floating`] a free body |
//! | `fixed` joint | its links are one body, by the parallel axis theorem; a comment names them |
//! | link that is fixed to a moving one | a named point at the origin of its frame: `tip: Point` |
//! | `revolute`, `continuous` | `Revolute` |
//! | `prismatic`, `planar` | `Prismatic`, `Planar` |
//! | `floating` | no joint: the body is free |
//! | `mimic` | a `Gear`, or a joint that is defined beside the struct |
//! | every joint of one coordinate | an `#[input]`: a torque (N m) or force (N) on the child; none where it mimics, or with [`Options::passive`] |
//! | `damping` | a term of the motor's law |
//! | `limit` | `limits = [..]` of the joint, which runs heed unless `.without_limits()` is said; constants `POSITION_LIMITS`, `RATE_LIMITS`, `EFFORT_LIMITS`; nothing enforces rates and efforts |
//! | `friction` | a comment and the constant `FRICTION`; the equations do not have it |
//! | frames of links | constants `.._ORIGIN` and `.._AXES`, for `View::point` |
//! | `visual` with `box`, `cylinder` or `sphere` | a shape of the body, drawn in films: no mass follows from it; nothing on the ground |
//! | `visual` with a mesh | a comment with the name of its file, and [`Mechanism::meshes`]; films draw it by `Film::urdf_meshes` |
//! | `collision`, `transmission`, `gazebo`, `safety_controller` and the like | nothing |
//! | elements of other tools | nothing: they are skipped, and the struct names them ([`Robot::notes`]) |
//!
//! All joints are at zero in the reference configuration. The frame of the root link gives the
//! global axes. The order of bodies is that of a walk from the root, depth first.
//!
//! # What is refused
//!
//! Every fault is reported at once, with its line and what would be accepted:
//!
//! ```text
//! arm.urdf:12: joint "elbow": child "fore_arm" is no link; did you mean "forearm"?
//! ```
//!
//! The macro reports the same sentences as errors of the compiler, at the name of the file.
//!
//! - Elements that may be misspelt, that close loops, and xacro sources.
//! - Links that form no tree: two roots, circles, a link with two parents.
//! - A link that moves and has an inertia that no body has. Links that are fixed to it count with
//!   it. Published models often have such inertias, as they were identified or simplified.
//!   [`Options::accept_inertia`] takes them as they are given. Each is named in a note.
//! - A joint that nothing resists: the mass matrix of the robot is not positive definite. A link
//!   without mass is accepted where what it carries resists its joint, as in a hip of three hinges.
//! - A `mimic` of a joint with a similar name, of itself, or of a joint without a position. What
//!   mimics a joint that is not there moves by itself, with a note.
//!
//! # Limits
//!
//! Files often give 1.5708 for a right angle. The numbers then have parts of some 1e-6 that should
//! be zero, and generated code grows with them. [`Robot::parse_rounded`] takes such angles as
//! exact.
//!
//! Bodies without mass, and those with moments of zero or below, have no equations of motion of
//! their own. A mechanism with such a body runs in joint coordinates only. Accelerations and
//! reactions of its bodies are errors that name a body.
//!
//! A `mimic` with an offset is violated with all joints at zero. Start with `assembled`.
//!
//! MJCF is not read. Convert it to URDF, and compare the masses: converters leave out damping, the
//! inertia of rotors, actuators and contacts.

#![forbid(unsafe_code)]

mod definite;
mod describe;
mod document;
mod elements;
mod faults;
mod inertias;
mod mechanism;
mod mimics;
mod names;
mod print;
mod robot;
mod spatial;
mod tree;
mod visuals;

pub use document::{JointKind, Limits};
pub use faults::{Fault, Faults, Note};
pub use mechanism::{Body, Joint, LinkFrame, Mechanism, Mesh, Mimic, Motor, Options, Shape};
pub use robot::Robot;

/// The example of the README is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
