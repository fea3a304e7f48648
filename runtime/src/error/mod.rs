//! What can go wrong, and how it is said.
//!
//! A [`Fault`] has one variant for each operation that can fail. It holds a family: an enum of its
//! own, in a file of its own together with what it says.
//!
//! | variant | family | of |
//! |---|---|---|
//! | `Start` | [`StartFault`] | settings, intervals and starts; what a run would leave out |
//! | `Step` | [`StepFault`] | evaluations, corrections, steps and events |
//! | `Mode` | [`ModeFault`] | interactions, and laws that switch |
//! | `Assembly` | [`AssemblyFault`] | joints that are set, and configurations |
//! | `Reading` | [`ReadingFault`] | readings |
//! | `Analysis` | [`AnalysisFault`] | equations in chosen coordinates, and kinematic analyses |
//! | `Checkpoint` | [`CheckpointFault`] | checkpoints |
//! | `Parameter` | [`ParameterError`] | parameters of a mechanism |

mod analysis;
mod assembly;
mod checkpoint;
mod fault;
mod left_out;
mod mode;
mod parameter;
mod quantity;
pub(crate) mod readable;
mod reading;
mod run;
#[cfg(feature = "serde")]
pub(crate) mod sentence;
pub(crate) mod setting;
mod start;
pub(crate) mod step;

pub use analysis::AnalysisFault;
pub use assembly::AssemblyFault;
pub use checkpoint::CheckpointFault;
pub use fault::Fault;
pub use left_out::{LeavesOut, Unheeding};
pub use mode::ModeFault;
pub use parameter::{ParameterError, ParameterFault};
pub use quantity::Quantity;
pub use reading::{AngleSet, ReadingFault};
pub use run::{RunError, SimulationError};
pub(crate) use start::OF_ITSELF;
pub use start::StartFault;
pub use step::{NotFinite, StepFault};
