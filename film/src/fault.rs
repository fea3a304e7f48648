//! Why a film cannot be shown.

use std::path::PathBuf;
use std::{error, fmt, io};

/// Why there is no page.
#[derive(Debug)]
#[non_exhaustive]
pub enum FilmError {
    /// No frame was recorded.
    Empty,
    /// A position is not a number.
    NotFinite {
        /// The time of the frame (s).
        time: f64,
    },
    /// The file could not be written.
    Write(io::Error),
    /// A file of a mesh, or a URDF file that names meshes, could not be read.
    Mesh {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}

#[cfg(feature = "meshes")]
impl FilmError {
    pub(crate) fn mesh(file: &std::path::Path, reason: String) -> Self {
        let file = file.into();
        Self::Mesh { file, reason }
    }
}

impl fmt::Display for FilmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(
                f,
                "the film has no frame: call `film.record(sample)` in the observer of a run"
            ),
            Self::NotFinite { time } => write!(f, "a position at {time} s is not a number"),
            Self::Write(_) => write!(f, "the film could not be written"),
            Self::Mesh { file, reason } => write!(f, "{}: {reason}", file.display()),
        }
    }
}

impl error::Error for FilmError {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Write(error) => Some(error),
            _ => None,
        }
    }
}
