//! Whether a way that is followed from pose to pose, as of an assembly or a kinematic analysis,
//! passed a singular configuration.

use super::gradients::Gradients;
use super::limits::{self, above};
use super::singular::Approach;
use super::warning::{Warning, Warnings};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::kernels::{Mechanism, Pivot};

/// Pivots and gradients along a way of short steps.
pub(crate) struct Passage<S: Scalar, M: Mechanism> {
    approach: Approach<S>,
    gradients: Gradients<S, M>,
    start: S,
    /// Radians of motion.
    travel: S,
    /// The joint of the smallest pivot.
    joint: usize,
}

impl<S: Real, M: Mechanism> Passage<S, M> {
    pub(crate) fn from(start: S) -> Self {
        Self {
            approach: Approach::new(),
            gradients: Gradients::none(),
            start,
            travel: S::zero(),
            joint: 0,
        }
    }

    /// Takes the next pose, after so much motion (rad), with its pivot, where equations are
    /// independent.
    pub(crate) fn step(
        &mut self,
        constants: &M::Constants<S>,
        (time, state): (S, &M::State<S>),
        pivot: Option<Pivot<S>>,
        motion: S,
    ) {
        self.travel = self.travel + motion;
        if let Some(pivot) = pivot
            && self.approach.step(time, pivot.relative, motion)
        {
            self.joint = pivot.joint.to_f64() as usize;
        }
        if M::REPORT.equations > 0 {
            let fall = self.gradients.measure(constants, (time, state));
            self.gradients.look(time, fall, self.travel);
        }
    }

    /// Times and pivots of the last two poses and of a next one, where the pivot is least in
    /// between: a singular configuration may have been passed there.
    pub(crate) fn dip(&self, time: S, pivot: Pivot<S>) -> Option<[(S, S); 3]> {
        self.approach.dip((time, pivot.relative))
    }

    /// Takes three poses in, near to each other, of which the middle one has the least pivot.
    pub(crate) fn look_between(&mut self, poses: [(S, S); 3], joint: usize) {
        if self.approach.between(poses) {
            self.joint = joint;
        }
    }

    /// About how far (rad) the last pose is from a configuration in which a pivot or a gradient
    /// vanishes, at most about 1.
    pub(crate) fn distance(&self) -> S {
        let one = S::one();
        let pivot = self.approach.left().unwrap_or(one);
        let gradient = self.gradients.approach().last().unwrap_or(one);
        pivot.min(gradient).max(S::zero()).min(one).sqrt()
    }

    /// The joint of a singular configuration that was passed, or nearly, or of an equation that all
    /// but vanished.
    pub(crate) fn passed(&self) -> Option<&'static str> {
        self.branch_point().map(|(joint, ..)| joint)
    }

    pub(crate) fn warnings(&self) -> Warnings {
        let found = self.branch_point();
        Warnings::of([found.map(|(joint, fall, time)| Warning::BranchPoint {
            joint,
            fall: fall.to_f64(),
            time: time.to_f64(),
        })])
    }

    /// Joint, fall and time.
    fn branch_point(&self) -> Option<(&'static str, S, S)> {
        let found = self.singular().or_else(|| self.vanishing());
        found.filter(|(_, fall, _)| !above(*fall, limits::NEARLY_SINGULAR))
    }

    fn singular(&self) -> Option<(&'static str, S, S)> {
        let nearest = self.approach.least()?;
        let joint = M::REPORT.joints.get(self.joint)?;
        let fall = self.approach.fall();
        let is_near = !above(fall, limits::NEARLY_SINGULAR);
        is_near.then_some((joint.name, fall, nearest.time))
    }

    fn vanishing(&self) -> Option<(&'static str, S, S)> {
        let shortest = self.gradients.shortest(self.start)?;
        let joint = M::REPORT.joint_of(shortest.row)?;
        Some((joint, shortest.fall, shortest.time))
    }
}
