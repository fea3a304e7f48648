//! What a run has found, for a reader: violations by joint, pivots, energy.

use super::Monitor;
use super::limits;
use super::worst::Worst;
use crate::math::scalar::Real;
use crate::mechanism::handle::JointHandle;
use crate::mechanism::kernels::Mechanism;

/// What was accepted although it did not converge, near a singular configuration or after one
/// application of a pseudo-inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unconverged<S> {
    /// Corrections of a [`Projection`](crate::Projection), or of another
    /// [`PostStabilisation`](crate::run::PostStabilisation) that left more than its tolerance.
    pub corrections: usize,
    /// Evaluations of the augmented Lagrangian.
    pub evaluations: usize,
    /// The time (s) of the first.
    pub since: Option<S>,
}

/// The largest violation of a joint's equations over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<S> {
    /// Of equations between lengths (m; of their rates m/s): the distance by which the joint is
    /// open.
    pub length: S,
    /// Of equations between directions (rad; of their rates rad/s).
    pub angle: S,
    /// When it was largest (s), against lengths of the mechanism or radians.
    pub time: S,
}

/// The smallest relative pivot of a run, see [`Pivot`](crate::mechanism::Pivot).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallestPivot<S> {
    /// The pivot, met or found between two steps.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
}

/// The shortest gradient of an equation over a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortestGradient<S> {
    /// Its length over its largest, by translations or by rotations, whichever is left more of; of
    /// a vector equation of all its rows, or what one has beside the others.
    pub relative: S,
    /// The joint's field.
    pub joint: &'static str,
    /// When (s).
    pub time: S,
}

impl<S: Real, M: Mechanism> Monitor<S, M> {
    /// By how much a joint was open, at the worst: over the steps that were looked at, every
    /// sixteenth and the last one, or more where violations decay; not at reporting times only.
    #[must_use]
    pub fn violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.of(&self.position, joint.index())
    }

    /// How fast the bodies of a joint moved against it, at the worst (m/s, rad/s).
    #[must_use]
    pub fn velocity_violation<J>(&self, joint: JointHandle<M, J>) -> Violation<S> {
        self.of(&self.velocity, joint.index())
    }

    fn of(&self, worst: &Worst<S, M>, joint: usize) -> Violation<S> {
        match M::REPORT.joints.get(joint) {
            Some(info) => worst.of(&self.rows, info),
            None => Violation {
                length: S::zero(),
                angle: S::zero(),
                time: self.start,
            },
        }
    }

    /// The smallest relative pivot with its joint and its time; `None` without equations. Where
    /// equations are kept that depend on others it is their least eigenvalue beside zero.
    #[must_use]
    pub fn smallest_pivot(&self) -> Option<SmallestPivot<S>> {
        let nearest = self.approach.as_ref()?.least()?;
        let joint = M::REPORT.joints.get(self.joint);
        Some(SmallestPivot {
            relative: nearest.pivot,
            joint: joint.map_or("", |info| info.name),
            time: nearest.time,
        })
    }

    /// The gradient of an equation that was shortest beside its largest, with its joint and its
    /// time; `None` without equations.
    ///
    /// Where a gradient vanishes, its equation leaves open which way a motion goes on, whatever the
    /// pivots, which are compared with what an equation is without the others.
    #[must_use]
    pub fn shortest_gradient(&self) -> Option<ShortestGradient<S>> {
        let shortest = self.gradients.shortest(self.start)?;
        Some(ShortestGradient {
            relative: shortest.fall.sqrt(),
            joint: M::REPORT.joint_of(shortest.row)?,
            time: shortest.time,
        })
    }

    /// The change of energy that no force and no driver accounts for, over the energy that the
    /// mechanism exchanges; `None` where the work of forces, summed from step to step, is not known
    /// to a hundredth of that. What is not known of it is not counted.
    #[must_use]
    pub fn energy_drift(&self) -> Option<S> {
        let tells = self.balance.tells(limits::ENERGY);
        tells.then(|| self.balance.drift())
    }

    /// The change of energy (J) that no force and no driver accounts for, where it was largest, as
    /// the work of forces, summed from step to step, is known.
    #[must_use]
    pub fn unaccounted_energy(&self) -> S {
        self.balance.unaccounted()
    }

    /// The largest `| |p| - 1 |` of Euler parameters at the end of a step, before they were brought
    /// to length 1.
    #[must_use]
    pub fn orientation_drift(&self) -> S {
        self.largest_drift
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
        self.travel
    }
}
