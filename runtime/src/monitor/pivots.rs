//! How near a run came to a singular configuration, by its pivots.
//!
//! It costs a root a step: the pivot is that of the last evaluation. Within a step it costs an
//! evaluation a look; with a compliance, whose system has no pivots, a factorisation without it in
//! every second step. Only it finds a four-bar that goes on along either branch, and steps that
//! pass over it: `tests/tests/sweeps/singular.rs`.

use super::record::{MonitoredStep, RunFacts};
use super::singular::Approach;
use super::warning::Warning;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;

/// The smallest relative pivot of a run, see [`Pivot`](crate::mechanism::Pivot).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SmallestPivot<S> {
    /// The pivot, met or found between two steps.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
}

/// The pivots of a run.
pub(super) struct Pivots<S: Scalar, M: Mechanism> {
    /// `None` before the first.
    approach: Option<Approach<S>>,
    /// The end of the step of the smallest.
    nearest: (S, M::State<S>),
    /// The index of the joint of the smallest, which is found at the end of a run.
    joint: usize,
    /// Radians of motion when one was looked at last.
    looked: S,
}

copied!([S: Scalar, M: Mechanism] Pivots<S, M>);

impl<S: Real, M: Mechanism> Pivots<S, M> {
    pub(super) fn none(start: S, state: &M::State<S>) -> Self {
        Self {
            approach: None,
            nearest: (start, *state),
            joint: 0,
            looked: S::zero(),
        }
    }

    #[inline]
    pub(super) fn step(&mut self, step: &MonitoredStep<'_, S, M>) {
        let Some(pivot) = step.pivot else {
            return;
        };
        let travel = step.motion.travel;
        let motion = (travel - self.looked).max(S::zero());
        self.looked = travel;
        let approach = self.approach.get_or_insert_with(Approach::new);
        if approach.step(step.end, pivot, motion) {
            self.keep(step.end, step.state);
        }
    }

    /// Looks at a pivot within a step, whose motion is told of later; tells whether it is smaller
    /// than ever.
    pub(super) fn look_within(&mut self, time: S, pivot: S) -> bool {
        let approach = self.approach.as_mut();
        approach.is_some_and(|approach| approach.step(time, pivot, S::zero()))
    }

    /// Keeps the state of the smallest.
    pub(super) fn keep(&mut self, time: S, state: &M::State<S>) {
        self.nearest = (time, *state);
    }

    /// All motion (rad) up to here was looked into.
    pub(super) fn are_known_until(&mut self, travel: S) {
        self.looked = travel;
    }

    /// Time and state of the smallest, or right after it; `None` where there are none.
    pub(super) fn nearest(&self) -> Option<(S, M::State<S>)> {
        self.approach.is_some().then_some(self.nearest)
    }

    /// Takes the joint of the smallest.
    pub(super) fn name(&mut self, joint: usize) {
        self.joint = joint;
    }

    /// The history of the pivots; `None` where there are none.
    pub(super) fn approach(&self) -> Option<&Approach<S>> {
        self.approach.as_ref()
    }

    /// The smallest, with its joint and its time; `None` where there are none.
    pub(super) fn smallest(&self) -> Option<SmallestPivot<S>> {
        let nearest = self.approach.as_ref()?.least()?;
        let joint = M::REPORT.joints.get(self.joint);
        Some(SmallestPivot {
            relative: nearest.pivot,
            joint: joint.map_or("", |info| info.name),
            time: nearest.time,
        })
    }

    pub(super) fn verdict(&self, run: &RunFacts<S>) -> Option<Warning> {
        let approach = self.approach.as_ref()?;
        let smallest = self.smallest()?;
        let fall = approach.fall();
        approach
            .is_near(fall, run.open)
            .then(|| Warning::NearlySingular {
                joint: smallest.joint,
                fall: fall.to_f64(),
                time: smallest.time.to_f64(),
            })
    }
}
