//! Why there is no page.

use std::path::PathBuf;
use std::{error, fmt, io};

use holonom::Fault;
use holonom_film::FilmError;

/// Why there is no page.
///
/// `{:?}` is the sentence of `Display`, for a `main` that returns the error.
#[non_exhaustive]
pub enum LiveError {
    /// The mechanism, its stepper or its start was refused.
    Mechanism(Fault),
    /// The step is not a positive number.
    Step {
        /// What was given (s).
        step: f64,
    },
    /// A slider of a field that is neither a parameter nor an input.
    NoValue,
    /// The range of a slider is none: it must have two finite ends, the smaller one first.
    Range {
        /// The slider.
        name: String,
        /// The first end.
        low: f64,
        /// The last one.
        high: f64,
    },
    /// Two sliders of one name.
    Name {
        /// The name.
        name: String,
    },
    /// A name before the first slider.
    NoSlider,
    /// What is drawn could not be written.
    Film(FilmError),
    /// The page could not be written.
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// The program was not started by `cargo run`, so that it does not know how it is built.
    NotByCargo,
    /// The program could not be compiled for WebAssembly.
    Build {
        /// What was run.
        command: String,
        /// Why it failed, where it was not the compiler that said so.
        reason: Option<String>,
    },
    /// The module is none that this crate was compiled into.
    NoModule,
    /// The program makes a second page: a module serves one.
    Second,
}

impl fmt::Debug for LiveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for LiveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mechanism(fault) => fault.fmt(f),
            Self::Step { step } => write!(f, "the step is {step} s: it must be positive and finite"),
            Self::NoValue => f.write_str(
                "a slider moves a field that is no number of the mechanism: it must be a `#[param]` or an `#[input]`",
            ),
            Self::Range { name, low, high } => write!(
                f,
                "the slider `{name}` goes from {low} to {high}: both must be finite, the smaller one first"
            ),
            Self::Name { name } => write!(
                f,
                "two sliders are called `{name}`: give one of them another name by `.named(..)`"
            ),
            Self::NoSlider => f.write_str(
                "`named` gives the slider before it another name: there is none",
            ),
            Self::Film(error) => error.fmt(f),
            Self::Write { file, reason } => {
                write!(f, "{} could not be written: {reason}", file.display())
            }
            Self::NotByCargo => f.write_str(
                "start the program by `cargo run`: it is compiled once more, for WebAssembly, and cargo says how",
            ),
            Self::Build { command, reason } => {
                write!(f, "`{command}` failed")?;
                match reason {
                    Some(reason) => write!(f, ": {reason}"),
                    None => f.write_str(
                        ": see the compiler's message; `rustup target add wasm32-unknown-unknown` installs the target",
                    ),
                }
            }
            Self::NoModule => f.write_str(
                "the module exports no function of `holonom-live`: compile the program that makes the page",
            ),
            Self::Second => f.write_str(
                "the program makes a second page: a module serves one, so give each page a program of its own",
            ),
        }
    }
}

impl error::Error for LiveError {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Mechanism(fault) => Some(fault),
            Self::Film(error) => Some(error),
            Self::Write { reason, .. } => Some(reason),
            _ => None,
        }
    }
}

impl From<Fault> for LiveError {
    fn from(fault: Fault) -> Self {
        Self::Mechanism(fault)
    }
}

impl From<FilmError> for LiveError {
    fn from(error: FilmError) -> Self {
        Self::Film(error)
    }
}
