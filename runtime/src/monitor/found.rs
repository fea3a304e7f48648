//! What a run has found, for a reader: violations by joint, pivots, energy.

use super::Monitor;
use super::gradients::ShortestGradient;
use super::pivots::SmallestPivot;
use super::unconverged::Unconverged;
use super::violations::Violation;
use crate::math::scalar::Real;
use crate::mechanism::handle::JointHandle;
use crate::mechanism::kernels::Mechanism;

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// By how much a joint was open, at the worst: over the steps that were looked at, every
    /// sixteenth and the last one, or more where violations decay; not at reporting times only.
    #[must_use]
    pub fn violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.violations.position(joint.index())
    }

    /// How fast the bodies of a joint moved against it, at the worst (m/s, rad/s).
    #[must_use]
    pub fn velocity_violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.violations.velocity(joint.index())
    }

    /// The smallest relative pivot with its joint and its time; `None` without equations. Where
    /// equations are kept that depend on others it is their least eigenvalue beside zero.
    #[must_use]
    pub fn smallest_pivot(&self) -> Option<SmallestPivot<S>> {
        self.pivots.smallest()
    }

    /// The gradient of an equation that was shortest beside its largest, with its joint and its
    /// time; `None` without equations.
    ///
    /// Where a gradient vanishes, its equation leaves open which way a motion goes on, whatever the
    /// pivots, which are compared with what an equation is without the others.
    #[must_use]
    pub fn shortest_gradient(&self) -> Option<ShortestGradient<S>> {
        self.gradients.shortest_by_joint(self.travel.start)
    }

    /// The change of energy that no force and no driver accounts for, over the energy that the
    /// mechanism exchanges; `None` where the work of forces, summed from step to step, is not known
    /// to a hundredth of that. What is not known of it is not counted.
    #[must_use]
    pub fn energy_drift(&self) -> Option<S> {
        let has_balance = self.energy.has_balance();
        has_balance.then(|| self.energy.drift())
    }

    /// The change of energy (J) that no force and no driver accounts for, where it was largest, as
    /// the work of forces, summed from step to step, is known.
    #[must_use]
    pub fn unaccounted_energy(&self) -> S {
        self.energy.unaccounted()
    }

    /// The largest `| |p| - 1 |` of Euler parameters at the end of a step, before they were brought
    /// to length 1.
    #[must_use]
    pub fn orientation_drift(&self) -> S {
        self.norm_drift.largest()
    }

    /// What a body is off by at the worst because its coordinates lag behind (rad, or lengths of
    /// the mechanism; over what it has moved by where that is less than one), as far as single
    /// steps tell: they do not tell of a motion that takes errors apart. Estimated with methods of
    /// order 2, zero with others.
    #[must_use]
    pub fn phase_error(&self) -> S {
        self.phase_error.worst()
    }

    /// What was accepted without convergence.
    #[must_use]
    pub fn unconverged(&self) -> Unconverged<S> {
        self.unconverged
    }

    /// How far the mechanism moved, in radians of its fastest body.
    #[must_use]
    pub fn travel(&self) -> S {
        self.travel.radians
    }
}
