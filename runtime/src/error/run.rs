//! Runs and steps that could not go on, with the last good state.

use core::fmt;

use crate::error::fault::Fault;
use crate::error::readable::Given;

/// A run or a step that could not go on: when, why, and the last good state.
///
/// `Debug` prints the sentence of `Display`, for a `main` that returns the error; the state is not
/// part of it.
#[derive(Clone, Copy, PartialEq)]
pub struct SimulationError<X> {
    /// The time of the last good state (s).
    pub time: f64,
    /// Why it stopped.
    pub fault: Fault,
    /// The last good state.
    pub state: X,
}

impl<X> core::error::Error for SimulationError<X> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        Some(&self.fault)
    }
}

/// Why a run ended whose observer may fail, see [`Simulation::run`](crate::Simulation::run).
///
/// `Debug` prints the sentence of `Display`, for a `main` that returns the error. Any `E` that can
/// be displayed will do, `Box<dyn Error>` among them.
#[derive(Clone, Copy, PartialEq)]
pub enum RunError<X, E> {
    /// The run could not go on.
    Simulation(SimulationError<X>),
    /// What the observer could not do. The run was stopped at that sample.
    Observer(E),
}

impl<X, E> From<SimulationError<X>> for RunError<X, E> {
    fn from(error: SimulationError<X>) -> Self {
        Self::Simulation(error)
    }
}

/// The source is the fault of the run. An observer's error is shown itself.
impl<X, E: fmt::Display> core::error::Error for RunError<X, E> {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Simulation(error) => Some(&error.fault),
            Self::Observer(_) => None,
        }
    }
}

impl<X> fmt::Display for SimulationError<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} s: {}", Given(self.time), self.fault)
    }
}

impl<X> fmt::Debug for SimulationError<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<X, E: fmt::Display> fmt::Display for RunError<X, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Simulation(error) => fmt::Display::fmt(error, f),
            Self::Observer(error) => fmt::Display::fmt(error, f),
        }
    }
}

impl<X, E: fmt::Display> fmt::Debug for RunError<X, E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
