//! Runs and steps that could not go on, with the last good state.

use core::fmt;

use crate::error::fault::Fault;
use crate::error::readable::Given;

/// A run or a step that could not go on: when, why, and the last good state.
///
/// `{:?}` is the sentence of `Display`, for a `main` that returns the error. `{:#?}` has the time
/// and the fields of the fault. The state is part of neither.
#[derive(Clone, Copy, PartialEq)]
pub struct SimulationError<X> {
    /// The time of the last good state (s).
    pub time: f64,
    /// Why it stopped.
    pub fault: Fault,
    /// The last good state.
    pub state: X,
}

/// No source: the sentence is that of the fault, and a chain of sources would say it twice.
impl<X> core::error::Error for SimulationError<X> {}

/// Why a run ended whose observer may fail, see [`Simulation::run`](crate::Simulation::run).
///
/// `{:?}` is the sentence of `Display`, for a `main` that returns the error. `{:#?}` has the fields
/// of the fault. Any `E` that can be displayed will do, `Box<dyn Error>` among them.
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

/// No source: the sentence is that of the run, or of the observer.
impl<X, E: fmt::Display> core::error::Error for RunError<X, E> {}

impl<X> fmt::Display for SimulationError<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} s: {}", Given(self.time), self.fault)
    }
}

impl<X> fmt::Debug for SimulationError<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !f.alternate() {
            return fmt::Display::fmt(self, f);
        }
        f.debug_struct("SimulationError")
            .field("time", &self.time)
            .field("fault", &self.fault)
            .finish_non_exhaustive()
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
        match self {
            Self::Simulation(error) if f.alternate() => {
                f.debug_tuple("Simulation").field(error).finish()
            }
            _ => fmt::Display::fmt(self, f),
        }
    }
}
