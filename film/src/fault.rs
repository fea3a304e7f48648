//! Why a film cannot be shown.

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
