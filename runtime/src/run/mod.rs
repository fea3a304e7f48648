//! Runs over an interval of time, single steps, and what follows a step.
//!
//! `simulation.rs` is what a user says of a run, and `runs.rs` begins it. `driver.rs` leads the
//! integration from step to step, and knows nobody who looks on. `taken.rs` takes a step,
//! `corrected.rs` brings its end back onto the constraints, `commit.rs` accepts it, `explained.rs`
//! says why a step cannot be taken. `prepared.rs` is what it begins with, and `leg.rs` is one
//! integration of it, which `opening.rs` begins and ends. Between two `handled.rs` does what is to
//! be done; `Driver::act` in `events/handling.rs` has its phases.
//!
//! Three lead a driver. `observed.rs` is one with an observer: `leading.rs` takes it from its start
//! to its end, and `instant.rs` shows what is done between. `companion.rs` is a second driver
//! beside the first, for `verification.rs`. `led.rs` is a run that its caller leads. The last two
//! ask for one thing after the other (`pulled.rs`).
//!
//! A post-stabilisation is a trait object (`post_step.rs`): a corrected step costs far more than a
//! call, and runs need no type for each. The stabilisation `TreeRecovery` goes from bodies to joint
//! coordinates and back by the kernels of starts.
//!
//! `checkpoint` is where a run can go on, and `resumed.rs` goes on there. `past.rs` is what of it a
//! run reads, without a heap, and `remembered.rs` what a driver does with that. A resumed
//! integration is begun as it was, and then its memory is replaced.
//!
//! `passing.rs` and `passages.rs` lead a run through instants at which two points meet that a force
//! acts between. `halved.rs` shortens fixed steps that lead beyond where friction has an effort.
//!
//! `kinematics/motion.rs` goes in steps that the motion bounds. It accepts a pose whose position
//! and velocity are near the prediction: near a branch, another one has other velocities.
//! Gruebler's count says little where equations are redundant. So at every pose a trial motion is
//! projected four times onto `D u = 0`. What is left of its energy separates a missing driver or a
//! singular configuration (`AnalysisFault::MotionLeftFree`) from a stiff one.
//!
//! `Recorder` builds a line in memory and writes it by one call, so that only the last line can be
//! torn. After a failed write it refuses further lines. It knows a mechanism by its report alone.

#[cfg(feature = "std")]
pub(crate) mod checkpoint;
#[cfg(feature = "recorder")]
mod columns;
mod commit;
pub(crate) mod companion;
mod corrected;
pub(crate) mod dense_step;
pub(crate) mod driver;
pub(crate) mod events;
mod explained;
mod halved;
mod handled;
mod instant;
pub(crate) mod interactions;
pub(crate) mod kinematics;
mod leading;
pub(crate) mod led;
mod leg;
mod observed;
mod opening;
pub(crate) mod output;
mod passages;
pub(crate) mod passing;
pub(crate) mod past;
pub(crate) mod post_step;
mod prepared;
mod pulled;
#[cfg(feature = "recorder")]
pub(crate) mod record_error;
#[cfg(feature = "recorder")]
pub(crate) mod recorder;
mod remembered;
pub(crate) mod report;
mod resumed;
pub(crate) mod runs;
pub(crate) mod sample;
pub(crate) mod simulate;
pub(crate) mod simulation;
pub(crate) mod stepper;
mod taken;
#[cfg(feature = "std")]
pub(crate) mod trajectory;
pub(crate) mod verification;
pub(crate) mod within;
mod worked;
#[cfg(feature = "serde")]
mod written;

pub use crate::nonsmooth::bearing::HasBearing;
pub use crate::nonsmooth::cam::Cam;
pub use crate::nonsmooth::described::{Beside, Limited};
pub use crate::nonsmooth::handle::InteractionHandle;
pub use crate::nonsmooth::interaction::Interaction;
pub use crate::nonsmooth::mode::InteractionMode;
pub use crate::nonsmooth::place::Plane;
pub use crate::nonsmooth::quantity::JointQuantity;
pub use crate::nonsmooth::sphere::Sphere;
pub use crate::nonsmooth::status::Impact;
pub use crate::stepping::watch::Crossing;
#[cfg(feature = "std")]
pub use checkpoint::Checkpoint;
pub use dense_step::DenseStep;
pub use events::context::Event;
pub use events::list::{Happenings, NothingHappens};
pub use events::setters::Handling;
pub use kinematics::KinematicResult;
pub use led::{Leads, Reached, Run};
pub use output::{IntoFlow, Reporting};
pub use post_step::{PostStabilisation, TreeRecovery, VelocityProjection};
#[cfg(feature = "recorder")]
pub use record_error::RecordError;
pub use simulate::Simulate;
pub use stepper::Steps;
#[cfg(feature = "std")]
pub use trajectory::Trajectory;
pub use verification::{BodyError, Verification};
