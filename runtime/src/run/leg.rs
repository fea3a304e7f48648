//! An integration of a driver, from where it begins to where it ends.

use crate::math::scalar::Real;
use crate::mechanism::at::StateAt;
use crate::mechanism::kernels::Mechanism;
use crate::run::within::Looks;

/// Where a driver is on its way.
pub(crate) struct Leg<S: Real, M: Mechanism> {
    /// Where (s) the integration under way began, or the next one begins.
    pub(crate) from: S,
    /// When (s) it ends at the latest.
    pub(crate) until: S,
    pub(crate) under_way: Option<Begun<S>>,
    pub(crate) taken: Taken<S, M>,
}

/// A step that was taken, and looked into for the monitor. In a place of its own over all steps, as
/// it is long and mostly empty.
pub(crate) struct Taken<S: Real, M: Mechanism> {
    /// When it ends (s).
    pub(crate) end: S,
    /// The first event within it.
    pub(crate) event: Option<StateAt<S, M>>,
    /// Where a rule of higher order would have led, where that is asked.
    pub(crate) better: Option<M::State<S>>,
    /// What has looked into it.
    pub(crate) looks: Looks,
}

impl<S: Real, M: Mechanism> Taken<S, M> {
    /// When it ends (s), or the first event within it.
    pub(crate) fn reached(&self) -> S {
        self.event.as_ref().map_or(self.end, |event| event.time)
    }
}

/// An integration that was begun.
#[derive(Clone, Copy)]
pub(crate) struct Begun<S> {
    /// When (s).
    #[cfg_attr(
        not(feature = "std"),
        expect(dead_code, reason = "checkpoints need a heap")
    )]
    pub(crate) start: S,
    /// What interpolants have evaluated for the monitor, which is no part of the run.
    pub(crate) of_monitor: usize,
}

impl<S: Real, M: Mechanism> Leg<S, M> {
    /// Before an integration that begins at a time (s).
    pub(crate) fn at(from: S) -> Self {
        Self {
            from,
            until: from,
            under_way: None,
            taken: Taken {
                end: from,
                event: None,
                better: None,
                looks: Looks::NONE,
            },
        }
    }

    /// Whether the integration under way has reached its end.
    #[inline]
    pub(crate) fn is_done(&self) -> bool {
        self.taken.end >= self.until
    }
}
