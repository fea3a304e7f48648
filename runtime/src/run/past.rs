//! Where a run goes on: what a checkpoint keeps, borrowed from it.

use core::fmt::Debug;
use core::ops::RangeInclusive;

use crate::dynamics::Iterations;
use crate::error::CheckpointFault;
use crate::integrate::{Counts, Memory, Reader};
use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::monitor::{Monitor, Seen};
use crate::run::output::Reporting;

/// What a run has counted so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Progress<S> {
    pub(crate) steps: usize,
    /// Reporting times that are done.
    pub(crate) reports: usize,
    /// Steps since a state was shown.
    pub(crate) unseen: usize,
    /// Of the segments before this one.
    pub(crate) counts: Counts,
    pub(crate) iterations: Iterations,
    pub(crate) worst_violation: S,
}

/// Numbers and counts, as they were written by a [`Memory`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers<'p, S> {
    pub(crate) numbers: &'p [S],
    pub(crate) counts: &'p [usize],
}

impl<S: Real> Numbers<'_, S> {
    /// Reads them; whether they are as many as are asked for.
    pub(crate) fn read(&self, read: impl FnOnce(&mut Memory<'_, S>)) -> bool {
        let mut reader = Reader::new(self.numbers, self.counts);
        read(&mut Memory::new(&mut reader));
        reader.is_done()
    }
}

/// The integration that was under way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PastSegment<'p, S> {
    /// Where it began (s), and in which state.
    pub(crate) start: S,
    pub(crate) state: &'p [S],
    /// Evaluations for the monitor.
    pub(crate) of_monitor: usize,
    pub(crate) memory: Numbers<'p, S>,
}

/// Where a run goes on.
pub(crate) struct Past<'p, S: Real, M: Mechanism> {
    pub(crate) at: StateAt<S, M>,
    /// Parameters and inputs at the start of the run, those that a handler has set last, and the
    /// present ones.
    pub(crate) given: &'p M::Parameters<S>,
    pub(crate) taken: Option<&'p M::Parameters<S>>,
    pub(crate) present: &'p M::Parameters<S>,
    pub(crate) progress: Progress<S>,
    /// The rates of the state.
    pub(crate) rates: &'p [S],
    /// `None` between two integrations.
    pub(crate) segment: Option<PastSegment<'p, S>>,
    pub(crate) events: Numbers<'p, S>,
    /// `None` where it begins anew.
    pub(crate) monitor: Option<(&'p Monitor<S, M>, Seen<S>)>,
    #[cfg(feature = "std")]
    pub(crate) warnings: &'p [std::string::String],
}

/// What a run is to do.
pub(crate) trait Plan<S: Real, M: Mechanism> {
    /// Its interval (s), and when it reports.
    fn interval(&self) -> ((S, S), Reporting<S>);

    /// Where it goes on, if it was begun before, by the same method and formulation.
    ///
    /// # Errors
    /// It was begun by others.
    fn past<F: Debug, I: Debug>(
        &self,
        integrator: &I,
        formulation: &F,
        joints: bool,
    ) -> Result<Option<Past<'_, S, M>>, CheckpointFault>;
}

/// A run from the start, over an interval (s).
pub(crate) struct Planned<S>(pub(crate) RangeInclusive<S>, pub(crate) Reporting<S>);

impl<S: Real, M: Mechanism> Plan<S, M> for Planned<S> {
    fn interval(&self) -> ((S, S), Reporting<S>) {
        ((*self.0.start(), *self.0.end()), self.1)
    }

    fn past<F: Debug, I: Debug>(
        &self,
        _integrator: &I,
        _formulation: &F,
        _joints: bool,
    ) -> Result<Option<Past<'_, S, M>>, CheckpointFault> {
        Ok(None)
    }
}
