//! What can go wrong, and how it is said.
//!
//! Texts of faults are in `message.rs`, those of an analysis in `analysis.rs`. `Debug` of an error
//! says the same as `Display`, because a `main` that returns an error prints `Debug`.

mod analysis;
mod checkpoint;
mod interactions;
mod kinds;
mod left_out;
pub(crate) mod message;
mod parameter;
pub(crate) mod readable;
mod run;
#[cfg(feature = "serde")]
pub(crate) mod sentence;
pub(crate) mod setting;
mod switches;

pub use analysis::AnalysisFault;
pub use checkpoint::CheckpointFault;
pub use kinds::{AngleSet, Fault, NotFinite, Quantity};
pub use left_out::{LeavesOut, Unheeding};
pub use parameter::{ParameterError, ParameterFault};
pub use run::{RunError, SimulationError};
