//! Why a unit is not written.

use std::error::Error;
use std::{fmt, io};

use holonom::Fault;
use holonom_export::ExportError;

/// Why a functional mock-up unit is not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum FmuError {
    /// What cannot be written in C: limits that are a turn or more apart, formulations that
    /// iterate, readings that compare.
    Export(ExportError),
    /// A mechanism without anything that moves.
    NoStates,
    /// An internal step that is not positive and finite.
    InternalStep {
        /// The step (s).
        step: f64,
    },
    /// A name that is that of a file or of functions of the interface.
    Name {
        /// The name.
        name: String,
    },
    /// A text was given for a variable that is not there.
    Variable {
        /// The name of the variable.
        name: String,
    },
    /// What the compiler of C said when it failed.
    Compiler {
        /// The command.
        command: String,
        /// What it said.
        message: String,
    },
    /// A file that cannot be written: its path and why.
    File(io::Error),
}

impl fmt::Display for FmuError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Export(error) => error.fmt(f),
            Self::NoStates => f.write_str("nothing moves in this mechanism: it has no state"),
            Self::InternalStep { step } => write!(
                f,
                "the internal step is {step} s: it has to be positive and finite"
            ),
            Self::Name { name } => write!(
                f,
                "the name `{name}` is one of the interface: give another one by `.named(..)`"
            ),
            Self::Variable { name } => write!(f, "there is no variable `{name}`"),
            Self::Compiler { command, message } => write!(f, "`{command}` failed: {message}"),
            Self::File(error) => error.fmt(f),
        }
    }
}

impl Error for FmuError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Export(error) => Some(error),
            Self::File(error) => Some(error),
            _ => None,
        }
    }
}

impl From<ExportError> for FmuError {
    fn from(error: ExportError) -> Self {
        Self::Export(error)
    }
}

impl From<Fault> for FmuError {
    fn from(fault: Fault) -> Self {
        Self::Export(fault.into())
    }
}

impl From<io::Error> for FmuError {
    fn from(error: io::Error) -> Self {
        Self::File(error)
    }
}

impl From<zip::result::ZipError> for FmuError {
    fn from(error: zip::result::ZipError) -> Self {
        Self::File(error.into())
    }
}
