//! Why a run does not go on from a checkpoint.

use core::fmt;

use crate::error::readable::Given;

/// Why a checkpoint cannot be made, or a run cannot go on from it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CheckpointFault {
    /// The run was by another method, or with another step, tolerance or limit.
    OtherMethod,
    /// The run was by another formulation, or with other coefficients.
    OtherFormulation,
    /// The run was in other coordinates.
    Coordinates {
        /// Whether it was in joint coordinates.
        joints: bool,
    },
    /// The run began with another value of a parameter or an input.
    Value {
        /// The name of the field.
        name: &'static str,
        /// The value of the mechanism at hand.
        found: f64,
        /// The value at the start of the run.
        kept: f64,
    },
    /// The rates at the checkpoint are not those of the run.
    Rates {
        /// The largest difference, relative to the rates.
        difference: f64,
    },
    /// The run had other events, controllers or interactions.
    Happenings,
    /// What the method remembers does not fit.
    Memory,
    /// The method does not hand over what it remembers.
    Forgetful,
}

impl fmt::Display for CheckpointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OtherMethod => f.write_str(
                "the checkpoint is of a run by another method, or with another step, tolerance or limit; take that of the run, which \
                 `Checkpoint::method` prints",
            ),
            Self::OtherFormulation => f.write_str(
                "the checkpoint is of a run by another formulation, or with other coefficients; take that of the run, which \
                 `Checkpoint::formulation` prints",
            ),
            Self::Coordinates { joints } => {
                let [of, present] = if joints {
                    ["joint", "absolute"]
                } else {
                    ["absolute", "joint"]
                };
                write!(
                    f,
                    "the checkpoint is of a run in {of} coordinates, and this one is in {present} coordinates"
                )
            }
            Self::Value { name, found, kept } => write!(
                f,
                "the checkpoint is of a run that began with `{name}` = {}, and this mechanism has {}; begin with the values of that run",
                Given(kept),
                Given(found)
            ),
            Self::Rates { difference } => write!(
                f,
                "the rates at the checkpoint differ by {difference:.1e} of their size from those of its run: masses, laws or the closure of \
                 forces are not the same"
            ),
            Self::Happenings => f.write_str(
                "the checkpoint is of a run with other events, controllers or interactions; give the same ones, in the same order",
            ),
            Self::Memory => f.write_str(
                "what the checkpoint keeps of the method does not fit this run: the file is damaged, or not of this mechanism",
            ),
            Self::Forgetful => f.write_str(
                "the method does not hand over what it remembers, so no checkpoint can be made; implement `Integration::remember`",
            ),
        }
    }
}

impl core::error::Error for CheckpointFault {}
