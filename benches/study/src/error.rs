//! Why a study could not be finished.

use std::fmt;
use std::io;
use std::path::PathBuf;

/// Why a study could not be finished.
#[derive(Debug)]
pub enum StudyError {
    /// A file or directory could not be written.
    Write {
        /// Which one.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// A file of rows cannot be read, or does not fit the others.
    Rows {
        /// Which one.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A run stopped before its end.
    Run {
        /// Which run.
        name: String,
        /// When and why, in words.
        reason: String,
    },
    /// A number that a result depends on is NaN or infinite.
    NotFinite {
        /// Which number.
        what: String,
    },
    /// A picture could not be drawn.
    Picture {
        /// Which picture.
        title: String,
        /// Why.
        reason: String,
    },
    /// A result could not be put into JSON.
    Json(serde_json::Error),
}

impl fmt::Display for StudyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Write { path, source } => write!(f, "cannot write {}: {source}", path.display()),
            Self::Rows { path, reason } => write!(f, "the rows of {}: {reason}", path.display()),
            Self::Run { name, reason } => write!(f, "the run `{name}` stopped: {reason}"),
            Self::NotFinite { what } => write!(f, "{what} is not a finite number"),
            Self::Picture { title, reason } => write!(f, "cannot draw `{title}`: {reason}"),
            Self::Json(error) => write!(f, "cannot write the results as JSON: {error}"),
        }
    }
}

impl std::error::Error for StudyError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Write { source, .. } => Some(source),
            Self::Json(error) => Some(error),
            _ => None,
        }
    }
}

impl From<serde_json::Error> for StudyError {
    fn from(error: serde_json::Error) -> Self {
        Self::Json(error)
    }
}
