//! Describe a mechanism as a struct; a macro writes its equations of motion as straight-line Rust.
//!
//! ```
//! use holonom::prelude::*;
//!
//! /// A steel rod of 1 m, hinged to the ground about x, released from the horizontal.
//! #[derive(Mechanism)]
//! #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
//! struct Pendulum {
//!     #[body(
//!         shape = bar(
//!             width = 0.03, height = 0.03, from = [0.0, 0.0, 0.0], to = [0.0, 1.0, 0.0]
//!         ),
//!         density = 7800.0,
//!     )]
//!     rod: Body,
//!     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
//!     pivot: Revolute,
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let pendulum = Pendulum::default();
//!     let handles = Pendulum::HANDLES; // one handle per field, under the field's name
//!
//!     let report = pendulum
//!         .simulation(StandardLagrange, DormandPrince::default())
//!         .run(0.0..=10.0, every(0.02), |sample| -> Result<(), Fault> {
//!             let reaction = sample.reaction(handles.pivot, handles.rod)?;
//!             let (time, angle) = (sample.time(), sample.angle(handles.pivot));
//!             println!("{time:.2} s: {angle:.4} rad, {:.3} N", reaction.force.norm());
//!             Ok(())
//!         })?;
//!     println!("{}", report.warnings()); // "no warnings", or a sentence for each
//!     Ok(())
//! }
//! ```
//!
//! **Begin with the [`guide`]**: its first program runs from `cargo new` on, and [`guide::recipes`]
//! has a short program for each task. The whole language is on one page,
//! [`guide::reference`](mod@guide::reference). A four-bar, moved by a motor and drawn by
//! `holonom-film`:
//!
#![doc = include_str!("guide/four-bar.svg")]
//!
//! # Where is what
//!
//! | what | where |
//! |---|---|
//! | bodies, joints and drivers, forces | [`Body`], [`Particle`], [`joints`], [`forces`] |
//! | joints and forces of one's own | [`joint!`], [`force!`] |
//! | a robot from a URDF file | `urdf!`, with the feature `urdf` |
//! | a run over an interval of time, with reports | [`Simulation`], [`every`], [`Sample`], [`RunReport`] |
//! | whether its result can be trusted | [`RunReport::warnings`], [`Monitor`], [`guide::trust`] |
//! | positions, velocities and efforts of a mechanism that is driven fully | [`KinematicAnalysis`], [`KinematicReport`] |
//! | single steps, for a loop of your own | [`Stepper`] |
//! | derivatives of a run by parameters, inputs and the start | [`sensitivity`], [`guide::sensitivities`](mod@guide::sensitivities) |
//! | many mechanisms at once, each with its own numbers | [`lanes::Ensemble`], [`guide::ensembles`](mod@guide::ensembles) |
//! | four formulations of the constraints | [`StandardLagrange`], [`Baumgarte`], [`Penalty`], [`AugmentedLagrangian`] |
//! | integrators | [`Rk4`], [`DormandPrince`] |
//! | poses, velocities, angles, reactions, energies, violations by name | [`View`], [`MechanismExt`] |
//! | orientations as Euler, Bryant or roll-pitch-yaw angles | [`View::euler_angles`], [`measure`] |
//! | runs that go on where they stopped, a motion at any time | [`run::Checkpoint`], [`run::Trajectory`], with the feature `std` |
//! | states in files, by name | `measure::NamedState`, with the feature `serde` |
//! | samples as lines of a CSV file | `Recorder`, with the feature `recorder` |
//! | correction onto the constraints | [`Projection`] |
//! | the kernels themselves, sizes and operation counts | [`trait@Mechanism`], [`Report`] |
//! | states of an integrator's [`System`](integrate::System) | arrays, [`State`](state::State), [`JointState`](state::JointState) |
//! | numbers, and numbers that carry derivatives along | [`Scalar`], [`Real`], [`Forward`] |
//!
//! Units are SI, angles are in radians.
//!
//! # Features
//!
//! | feature | |
//! |---|---|
//! | `std` (default) | elementary functions of the standard library |
//! | `libm` | those of `libm`, for targets without the standard library; the crate needs no heap |
//! | `recorder` | samples as lines of a CSV file |
//! | `urdf` | `urdf!`: a mechanism from a URDF file |
//! | `serde` | states by the names of bodies, poses, reports and warnings, in any format of serde |
//! | `mint` | poses, vectors and quaternions in the types of graphics libraries |

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "holonom needs elementary functions: turn on the feature `std` (the default), or `libm` where there is no standard library"
);

mod assembly;
pub mod constraints;
pub mod dynamics;
pub mod error;
pub mod formulation;
mod forward;
pub mod independent;
pub mod integrate;
pub mod lanes;
mod math;
pub mod measure;
pub mod mechanism;
pub mod monitor;
mod nonsmooth;
pub mod run;
pub mod sensitivity;
pub mod state;
mod stepping;
/// Functions from tables.
pub mod spline {
    pub use crate::math::spline::{Spline, SplineFault, uniform_knots};
}

/// Compliances, limits, a projection and what a start may be, for programs in other languages.
#[doc(hidden)]
pub mod traced {
    pub use crate::assembly::consistent_start::{StartRow, check_start, start_rows};
    pub use crate::constraints::compliance::{compliances, numbers_of_units};
    pub use crate::constraints::traced::{Projected, projected};
    pub use crate::mechanism::AtTime;
    pub use crate::nonsmooth::traced::{LimitedJoint, impact, limited_joint};
}

#[cfg(test)]
mod tests;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
pub mod forces;
#[cfg(any(doc, doctest))]
pub mod guide;
pub mod joints;

/// Describes a mechanism: every field is a body, a joint, a force, a parameter or an input.
///
/// ```
/// use holonom::prelude::*;
///
/// const LENGTH: f64 = 0.8;
///
/// /// An arm on a hinge, and a bob on a ball joint at its end.
/// #[derive(Mechanism)]
/// #[mechanism(gravity = [0.0, 0.0, -9.81])]
/// struct Swing {
///     #[body(mass = 2.0, inertia = [0.1, 0.01, 0.1], position = [0.0, LENGTH / 2.0, 0.0])]
///     arm: Body,
///     #[body(
///         mass = 1.0,
///         inertia = [[0.02, 0.001, 0.0], [0.001, 0.03, 0.0], [0.0, 0.0, 0.02]],
///         position = [0.0, LENGTH, -0.3],
///         orientation = rotation([0.0, 0.0, 1.0], deg(30.0)),
///         angular_velocity = [0.0, 0.0, 3.0],
///     )]
///     bob: Body,
///     #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
///     hinge: Revolute,
///     #[joint(between = [arm, bob], point = local([0.0, LENGTH / 2.0, 0.0], [0.0, 0.0, 0.3]))]
///     ball: Spherical,
/// }
///
/// let swing = Swing::default();
/// let handles = Swing::HANDLES;
/// let formulation = StandardLagrange;
/// let report = Simulation::new(&swing, formulation, DormandPrince::new(Tolerance::default()))
///     .projection(Projection::default())
///     .run(0.0..=1.0, every(0.1), |sample| -> Result<(), Fault> {
///         let on_bob = sample.reaction(handles.ball, handles.bob)?;
///         let (time, angle) = (sample.time(), sample.angle(handles.hinge));
///         println!("{time:.3} s: hinge {angle:.3} rad, ball {:.3} N", on_bob.force.norm());
///         Ok(())
///     })?;
/// assert!(report.worst_violation < 1e-24);
/// assert_eq!(Swing::REPORT.degrees_of_freedom, 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Attributes
///
/// Units, defaults and what may stand where are in
/// [`guide::reference`](mod@crate::guide::reference).
///
/// `#[mechanism(gravity = [x, y, z])]` on the struct: the acceleration of free fall (m/s^2,
/// global); none if left out. `redundant = "drop"` or `"keep"` beside it says what is to be done
/// with equations that follow from others (a door on two hinges), which are refused otherwise: see
/// [`Rank`](crate::mechanism::Rank) and [`Report::redundant`]. Leave them out, and every
/// formulation applies; the motion is the same, reactions are those of the joints without these
/// equations. Keep them, and only formulations with a compliance apply ([`Penalty`],
/// [`AugmentedLagrangian`]).
/// `coordinates = "joints"` solves the equations of motion in joint coordinates,
/// [`JointCoordinates`], and has those of the bodies only to be read; `"both"` has both as one
/// kernel each, and solves those of the bodies where nothing else is said, see
/// [`guide::coordinates`]. `recursion_limit = 256` repeats what stands at the top
/// of the crate, `#![recursion_limit = "256"]`: more than a hundred kinds of bodies, joints and
/// forces in one mechanism need both.
///
/// `#[body(..)]` on a field of type [`Body`] or [`Particle`]: see there.
///
/// `#[joint(between = [i, j], ..)]` on a field whose type is a joint: `between` names its bodies in
/// the order of the joint's definition, fields of the struct or `ground`; the other keys are the
/// parameters of the joint, see [`joints`] and [`joint!`]. Points and axes are given once, **in
/// global axes at the reference configuration**, and the macro makes the copies that are fixed on
/// the bodies; so the reference configuration satisfies the joint. Or one for each body in its own
/// axes, points from its centre of mass: `point = local([..], [..])` (the ground's axes are the
/// global ones); the joint may then be violated at the start, which [`MechanismExt::assemble`]
/// mends. `cut` keeps it equations in joint coordinates, see [`guide::coordinates`].
/// `limits = [-1.0, 1.0]` and `restitution = 0.2` are stops of a hinge (rad), a slide (m) or a
/// screw (rad). Runs and steppers heed them unless `.without_limits()` is said, see
/// [`guide::contact`](mod@guide::contact).
///
/// `#[force(between = [i, j], ..)]` on a field whose type is a force, likewise, see [`forces`] and
/// [`force!`].
///
/// `#[param]` on a field of type `f64`: a number that is known at run time and may stand wherever a
/// number may, by the name of the field. `#[input]`: one that may change at every step, in forces
/// and gravity only. `#[input(order = 2)]` on a field of type [`Setpoint`](mechanism::Setpoint):
/// one with its derivatives, for the motion of a driver. `#[param]` on a field of type
/// [`Spline`](spline::Spline): a table, which laws call.
///
/// `#[state(rate = .., start = 0.0)]` on a field of type `f64`: a number of your own that
/// integrates a rate, such as the current of a motor. See
/// [`guide::states`](mod@crate::guide::states).
///
/// Each of these fields may be an array, `links: [Body; 16]`: in its attribute `k` is the number of
/// the element, and `links[k - 1]` names an element of another array, see
/// [`guide::mechanism`](mod@crate::guide::mechanism#many-bodies-arrays).
///
/// # Numbers
///
/// Literals, `+ - * /`, `sqrt(..)`, `sin(..)`, `cos(..)`, `tan(..)`, `exp(..)`, `deg(..)` (degrees
/// to radians), `PI`, `TAU`, paths of constants of type `f64`, entries of constants that are arrays
/// of it, parameters and inputs. The macro evaluates what it can see; a path is a value that it
/// cannot see: it is checked by the compiler or in [`Mechanism::parameters`](trait@Mechanism), and
/// does not fold. Laws are expressions of `time`, too, and call splines: [`guide::data`].
///
/// # What is generated
///
/// An implementation of [`trait@Mechanism`], and `Default`, or, where there are parameters,
/// `T::new(..)`, which checks them. `T::HANDLES` is a struct with a handle for every field, under
/// the field's name, or with an array of them where the field is one; `T::REPORT` holds sizes,
/// names, the plan of the solution and the operations of every kernel, which the documentation of
/// the implementation shows as well.
pub use holonom_macros::Mechanism;

pub use constraints::projection::Projection;
pub use error::{Fault, ParameterError, RunError, SimulationError};
pub use formulation::{AugmentedLagrangian, Baumgarte, Formulation, Penalty, StandardLagrange};
pub use forward::Forward;
pub use integrate::{
    Adams, AdamsBashforthMoulton4, Bdf, BogackiShampine, DormandPrince, DormandPrince853,
    GeneralizedAlpha, Heun, ImplicitMidpoint, Kutta3, Midpoint, RadauIIA, Rk4, SemiImplicitEuler,
    Tolerance,
};
pub use math::scalar::{Real, Scalar};
pub use measure::access::{MechanismExt, Pose};
pub use measure::load::Loads;
pub use measure::reaction::Wrench;
pub use measure::view::View;
pub use mechanism::body::{Body, Particle};
pub use mechanism::handle::{BodyHandle, ForceHandle, JointHandle};
pub use mechanism::joint_kernels::JointCoordinates;
pub use mechanism::kernels::Mechanism;
pub use mechanism::report::Report;
pub use monitor::{Monitor, Warning, Warnings};
pub use nalgebra;
pub use run::kinematics::{KinematicAnalysis, KinematicReport};
pub use run::output::{every, every_step};
#[cfg(feature = "recorder")]
pub use run::recorder::Recorder;
pub use run::report::{RunReport, RunResult};
pub use run::runs::Runs;
pub use run::sample::Sample;
pub use run::simulation::Simulation;
pub use run::stepper::Stepper;
pub use state::vector::StateParts;

/// What a program with a mechanism needs: `use holonom::prelude::*;`. All joints, forces,
/// formulations and integrators of the library are among it. One of your own with the name of one
/// of them is imported by name from the module that defines it.
pub mod prelude {
    pub use core::ops::ControlFlow;

    pub use crate::dynamics::Problem;
    pub use crate::forces::*;
    pub use crate::independent::{IndependentCoordinates, IndependentExt, Motion};
    pub use crate::joints::*;
    pub use crate::measure::Viewed;
    pub use crate::mechanism::{Assembly, InputsOf, Point, Setpoint, StateOf};
    pub use crate::run::{Crossing, Interaction, Limited, Simulate};
    pub use crate::sensitivity::SensitivityExt;
    pub use crate::spline::Spline;
    pub use crate::{
        Adams, AdamsBashforthMoulton4, AugmentedLagrangian, Baumgarte, Bdf, Body, BogackiShampine,
        DormandPrince, DormandPrince853, Fault, Formulation, GeneralizedAlpha, Heun,
        ImplicitMidpoint, JointCoordinates, KinematicAnalysis, Kutta3, Loads, Mechanism,
        MechanismExt, Midpoint, ParameterError, Particle, Penalty, Projection, RadauIIA, Rk4,
        RunError, RunReport, RunResult, Sample, SemiImplicitEuler, Simulation, SimulationError,
        StandardLagrange, StateParts, Stepper, Tolerance, View, every, every_step,
    };
}

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
