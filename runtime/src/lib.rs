//! Equations of motion of rigid multibody systems, generated at compile time from an annotated struct.
//!
//! A mechanism is a struct with `#[derive(Mechanism)]`: bodies and joints are its fields. The derive writes the kernels of
//! its equations of motion as straight-line code; this crate holds what runs them:
//!
//! | what | where |
//! |---|---|
//! | a run over an interval of time, with reports | [`Simulation`], [`every`], [`Sample`], [`RunReport`] |
//! | single steps, for a loop of your own | [`Stepper`] |
//! | four formulations of the constraints | [`StandardLagrange`], [`Baumgarte`], [`Penalty`], [`AugmentedLagrangian`] |
//! | integrators | [`Rk4`], [`DormandPrince`] |
//! | poses, velocities, angles, reactions, energies, violations by name | [`View`], [`MechanismExt`] |
//! | correction onto the constraints | [`Projection`] |
//! | the kernels themselves, sizes and operation counts | [`trait@Mechanism`], [`Report`] |
//! | numbers | [`Scalar`], [`Real`] |
//!
//! Units are SI, angles are in radians. The crate needs no heap and no standard library: with default features off, turn on
//! `libm`.

#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "std")]
extern crate std;

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!(
    "holonom needs elementary functions: turn on the feature `std` (the default), or `libm` where there is no standard library"
);

mod access;
mod array;
mod dynamics;
mod error;
mod formulation;
mod handle;
mod integrate;
mod load;
mod mechanism;
mod project;
mod reaction;
mod report;
mod reporting;
mod rotation;
mod sample;
mod scalar;
mod simulation;
mod stepper;
mod view;

#[cfg(test)]
mod tests;

#[doc(hidden)]
#[path = "private.rs"]
pub mod __private;
mod bodies;
pub mod joints;

pub use bodies::{Body, Particle};
pub use holonom_macros::Mechanism;

pub use access::{MechanismExt, Pose};
pub use array::{Array, State, StateParts, Vector};
pub use dynamics::{Dynamics, Iterations};
pub use error::{Fault, ParameterError, ParameterFault, SimulationError};
pub use formulation::{
    AugmentedLagrangian, Baumgarte, Formulation, Penalty, Saddle, Solution, StandardLagrange,
};
pub use handle::{BodyHandle, HasAngle, Joint, JointHandle};
pub use integrate::{
    AdaptiveCourse, Counts, Course, DormandPrince, DormandPrince5, DormandPrinceStages,
    FixedCourse, FixedStep, Integrator, Rk4, Rk4Stages, Scheme, Span, Start, Stride, System,
    Tolerance,
};
pub use load::{AppliedForces, ForceLaw, Loads, NoForces};
pub use mechanism::{
    AngleParts, Compliant, Evaluation, Mechanism, Normalised, Orientation, Pivot, Plain, Raw,
    Stabilisation, Stabilised, Terms,
};
pub use nalgebra;
pub use project::{Correction, Projection};
pub use reaction::Wrench;
pub use report::{Block, BodyInfo, BodyKind, JointInfo, Kernel, Operations, Report};
pub use reporting::{Reporting, every, every_step};
pub use sample::Sample;
pub use scalar::{Real, Scalar};
pub use simulation::{RunReport, RunResult, Simulation};
pub use stepper::Stepper;
pub use view::View;

/// What a program with a mechanism needs: `use holonom::prelude::*;`. Joints are in `holonom::joints`, by name.
pub mod prelude {
    pub use core::ops::ControlFlow;

    pub use crate::{
        AugmentedLagrangian, Baumgarte, Body, DormandPrince, Fault, Formulation, Loads, Mechanism,
        MechanismExt, Normalised, ParameterError, Particle, Penalty, Projection, Raw, Rk4,
        RunReport, RunResult, Sample, Simulation, SimulationError, StandardLagrange, Stepper,
        Tolerance, every, every_step,
    };
}

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
