//! Why a sample was not recorded.

use core::fmt;
use std::io;
use std::string::String;

use crate::error::Fault;

/// Why a sample was not recorded.
///
/// `Debug` prints the sentence of `Display`, for a `main` that returns the error.
#[non_exhaustive]
pub enum RecordError {
    /// The file could not be created or written. Nothing can be recorded after it, so that the last
    /// line may be torn and no other.
    Io(io::Error),
    /// An earlier line was not written to its end.
    Torn,
    /// The evaluation for the reactions failed; nothing was written.
    Evaluation(Fault),
    /// A value is NaN or infinite; nothing was written.
    NotFinite {
        /// The name of its column.
        column: String,
    },
    /// The sample is of another mechanism than the samples before; nothing was written.
    OtherMechanism,
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "the record could not be written: {error}"),
            Self::Torn => write!(
                f,
                "an earlier line of the record was not written to its end"
            ),
            Self::Evaluation(fault) => write!(f, "no reactions to record: {fault}"),
            Self::NotFinite { column } => write!(f, "`{column}` is not finite"),
            Self::OtherMechanism => {
                write!(f, "the samples of one record must be of one mechanism")
            }
        }
    }
}

impl fmt::Debug for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// No source: the sentence has that of the cause, and a chain of sources would say it twice.
impl core::error::Error for RecordError {}

impl From<io::Error> for RecordError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Fault> for RecordError {
    fn from(fault: Fault) -> Self {
        Self::Evaluation(fault)
    }
}
