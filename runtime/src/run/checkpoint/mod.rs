//! Where a run can go on, to the last bit.
//!
//! A checkpoint is taken between two steps of an integration, or between two integrations.
//! `capture.rs` takes it of a run, `written.rs` has it in a file. What the method
//! remembers is numbers in the order in which it hands them over
//! ([`Integration::remember`](crate::integrate::Integration::remember)).
//!
//! The state of the integration is kept beside that of the bodies: joint coordinates come back from
//! bodies up to round-off only. Parameters are kept three times. Those of the start tell another
//! mechanism. Those that a handler has set last come before the present inputs, because the
//! equations are prepared in these two steps.

mod capture;
pub(crate) mod keeper;
#[cfg(feature = "serde")]
mod written;

use core::fmt::{self, Debug};
use std::format;
use std::string::String;
use std::vec::Vec;

use crate::error::CheckpointFault;
use crate::integrate::{Memory, Tape};
use crate::math::scalar::Real;
use crate::mechanism::at::At;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::{Monitor, Seen};
use crate::run::output::Reporting;
use crate::run::past::{Numbers, Past, PastSegment, Plan, Progress};

/// Where a run can go on: what [`Simulation::checkpoints`] hands over, and what
/// [`Simulation::resume`] takes.
///
/// The second part of the run then gives what the whole run would have given, bit for bit. That
/// holds for all methods, and for the same program on the same kind of processor.
///
/// It keeps the state, the parameters and inputs, what the method remembers, what was counted and
/// reported, and what events, controllers and interactions need. It does not keep what your
/// closures remember: keep that beside it.
///
/// With the feature `serde` it goes to a file. The file names the mechanism, its structure, the
/// number type and the version of this crate, and is refused where one of them differs. The monitor
/// is not in the file: it begins anew, and [`Checkpoint::warnings`] has what it had found.
///
/// [`Simulation::checkpoints`]: crate::Simulation::checkpoints
/// [`Simulation::resume`]: crate::Simulation::resume
pub struct Checkpoint<M: Mechanism, S: Real = f64> {
    method: String,
    formulation: String,
    /// Whether the run is in joint coordinates.
    joints: bool,
    interval: (S, S),
    reporting: Reporting<S>,
    time: S,
    state: M::State<S>,
    given: M::Parameters<S>,
    taken: Option<M::Parameters<S>>,
    present: M::Parameters<S>,
    progress: Progress<S>,
    rates: Vec<S>,
    segment: Option<Segment<S>>,
    events: Kept<S>,
    monitor: Option<(Monitor<S, M>, Seen<S>)>,
    warnings: Vec<String>,
}

/// The integration that was under way.
#[derive(Clone, Debug, PartialEq)]
struct Segment<S> {
    start: S,
    state: Vec<S>,
    of_monitor: usize,
    memory: Kept<S>,
}

/// Numbers and counts, in the order in which they were handed over.
#[derive(Clone, Debug, PartialEq)]
struct Kept<S> {
    numbers: Vec<S>,
    counts: Vec<usize>,
}

impl<S: Real> Tape<S> for Kept<S> {
    fn number(&mut self, number: &mut S) {
        self.numbers.push(*number);
    }

    fn count(&mut self, count: &mut usize) {
        self.counts.push(*count);
    }
}

impl<S: Real> Kept<S> {
    /// What a function hands over.
    fn of<T>(remember: impl FnOnce(&mut Memory<'_, S>) -> T) -> (Self, T) {
        let mut kept = Self {
            numbers: Vec::new(),
            counts: Vec::new(),
        };
        let result = remember(&mut Memory::new(&mut kept));
        (kept, result)
    }

    fn as_numbers(&self) -> Numbers<'_, S> {
        Numbers {
            numbers: &self.numbers,
            counts: &self.counts,
        }
    }
}

impl<M: Mechanism, S: Real> Checkpoint<M, S> {
    /// The time (s) that was reached.
    #[must_use]
    pub fn time(&self) -> S {
        self.time
    }

    /// The state that was reached.
    #[must_use]
    pub fn state(&self) -> &M::State<S> {
        &self.state
    }

    /// The interval (s) of the run.
    #[must_use]
    pub fn interval(&self) -> (S, S) {
        self.interval
    }

    /// The method of the run with its settings, as `Debug` prints it.
    #[must_use]
    pub fn method(&self) -> &str {
        &self.method
    }

    /// The formulation of the run with its coefficients, as `Debug` prints it.
    #[must_use]
    pub fn formulation(&self) -> &str {
        &self.formulation
    }

    /// The warnings up to here, were the run to end here; those from before a restart from a file
    /// first.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.warnings
    }

    /// The same with another end (s) of the interval, for a run that is to go on for longer than
    /// was planned.
    ///
    /// Steps then differ from those of a run that had been planned so. A step control knows the
    /// interval, and the last step before the former end is fitted to it. From a checkpoint before
    /// that step, fixed steps do not differ.
    #[must_use]
    pub fn until(mut self, end: S) -> Self {
        /// Parts of an interval between reports that are none.
        const NEARLY: f64 = 1e-6;
        let (start, former) = self.interval;
        self.interval.1 = end;
        if let Some(dt) = self.reporting.interval().filter(|_| self.time >= former) {
            // The report at the former end is one more than those at their interval.
            let done = (self.time - start).quotient(dt).to_f64();
            self.progress.reports = (done + NEARLY) as usize;
        }
        self
    }
}

impl<M: Mechanism, S: Real> Plan<S, M> for &Checkpoint<M, S> {
    fn interval(&self) -> ((S, S), Reporting<S>) {
        (self.interval, self.reporting)
    }

    fn past<F: Debug, I: Debug>(
        &self,
        integrator: &I,
        formulation: &F,
        joints: bool,
    ) -> Result<Option<Past<'_, S, M>>, CheckpointFault> {
        let refused = if self.joints != joints {
            Some(CheckpointFault::Coordinates {
                joints: self.joints,
            })
        } else if self.method != format!("{integrator:?}") {
            Some(CheckpointFault::OtherMethod)
        } else if self.formulation != format!("{formulation:?}") {
            Some(CheckpointFault::OtherFormulation)
        } else {
            None
        };
        if let Some(fault) = refused {
            return Err(fault);
        }
        let segment = self.segment.as_ref().map(|segment| PastSegment {
            start: segment.start,
            state: &segment.state,
            of_monitor: segment.of_monitor,
            memory: segment.memory.as_numbers(),
        });
        let monitor = self.monitor.as_ref();
        Ok(Some(Past {
            at: At {
                time: self.time,
                bodies: self.state,
            },
            given: &self.given,
            taken: self.taken.as_ref(),
            present: &self.present,
            progress: self.progress,
            rates: &self.rates,
            segment,
            events: self.events.as_numbers(),
            monitor: monitor.map(|(monitor, seen)| (monitor, *seen)),
            warnings: &self.warnings,
        }))
    }
}

impl<M: Mechanism, S: Real> Clone for Checkpoint<M, S> {
    fn clone(&self) -> Self {
        Self {
            method: self.method.clone(),
            formulation: self.formulation.clone(),
            rates: self.rates.clone(),
            segment: self.segment.clone(),
            events: self.events.clone(),
            warnings: self.warnings.clone(),
            ..*self
        }
    }
}

/// Equal in everything that a file keeps.
impl<M: Mechanism, S: Real> PartialEq for Checkpoint<M, S> {
    fn eq(&self, other: &Self) -> bool {
        let words = |of: &Self| (of.method.clone(), of.formulation.clone(), of.joints);
        words(self) == words(other)
            && self.interval == other.interval
            && self.reporting == other.reporting
            && self.time == other.time
            && self.state == other.state
            && self.given == other.given
            && self.taken == other.taken
            && self.present == other.present
            && self.progress == other.progress
            && self.rates == other.rates
            && self.segment == other.segment
            && self.events == other.events
            && self.warnings == other.warnings
    }
}

/// The mechanism, the method and the formulation, the time and the state.
impl<M: Mechanism, S: Real> Debug for Checkpoint<M, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Checkpoint")
            .field("mechanism", &M::REPORT.name)
            .field("method", &self.method)
            .field("formulation", &self.formulation)
            .field("time", &self.time)
            .field("state", &self.state)
            .finish_non_exhaustive()
    }
}
