//! What can go wrong, and how it is said.

mod kinds;
pub(crate) mod message;
pub(crate) mod readable;
pub(crate) mod setting;

pub use kinds::{Fault, NotFinite, ParameterError, ParameterFault, Quantity, SimulationError};
