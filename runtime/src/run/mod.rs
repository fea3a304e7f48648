//! Runs over an interval of time, single steps, and what follows a step.

pub(crate) mod direct;
pub(crate) mod joint_stepper;
pub(crate) mod kinematics;
pub(crate) mod output;
pub(crate) mod post_step;
#[cfg(feature = "recorder")]
pub(crate) mod recorder;
pub(crate) mod report;
pub(crate) mod sample;
pub(crate) mod segments;
pub(crate) mod simulation;
pub(crate) mod stepper;
pub(crate) mod within;

pub use direct::DirectCorrection;
pub use post_step::{Treatment, TreeRecovery, VelocityProjection};
