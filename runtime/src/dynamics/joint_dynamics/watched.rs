//! What the watch wants to know of a mechanism that moves by its joints.

use super::JointDynamics;
use crate::dynamics::lesser;
use crate::formulation::Formulation;
use crate::integrate::System;
use crate::math::scalar::Real;
use crate::measure::load::AppliedForces;
use crate::mechanism::joint_kernels::{JointCoordinates, JointParts};
use crate::mechanism::kernels::{Pivot, Terms};
use crate::state::vector::Array;
use crate::watch::Watch;

impl<S, M, F, A> JointDynamics<S, M, F, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    /// Shows the end of a step to the watch, which wants to know of all joints: pivots and
    /// multipliers of one evaluation of the bodies. Where that has none, its pivot says why. What
    /// the velocities that rows determine lose counts as well: there, and not where a method
    /// evaluated last.
    pub(crate) fn watch(&mut self, watch: &mut Watch<S, M>, time: S, bodies: &M::State<S>) {
        let _ = self.bodies.rates(time, bodies);
        let pivot = self.pivot(time, bodies).map(|pivot| pivot.relative);
        self.bodies.watch(watch, (time, bodies), pivot);
    }

    /// The smallest relative pivot by joints, where bodies stand so, as the square of a distance;
    /// `None` where none is recorded.
    fn pivot(&self, time: S, bodies: &M::State<S>) -> Option<Pivot<S>> {
        if M::JOINT_REPORT.rows.is_empty() || F::Terms::COMPLIANT {
            return None;
        }
        let mut rates = M::JointState::<S>::zeros();
        let mut multipliers = Array::zeros();
        let joints = self.nearest(bodies);
        let mut pivot = self.slope(time, &joints, &mut rates, &mut multipliers);
        if M::JOINT_REPORT.determines {
            pivot.relative = pivot.relative * pivot.relative;
        }
        Some(pivot)
    }

    /// The smallest relative pivot between the ends of steps, in both descriptions, as at the ends.
    pub(crate) fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        let pivot = self.pivot(time, bodies).map(|pivot| pivot.relative);
        lesser(self.bodies.pivot_within(time, bodies), pivot)
    }

    /// Finds the joint of the smallest pivot of a run.
    #[cold]
    pub(crate) fn name_smallest_pivot(&self, watch: &mut Watch<S, M>) {
        if !M::REPORT.keeps_redundant() || F::Terms::COMPLIANT {
            return self.bodies.name_smallest_pivot(watch);
        }
        // Those of the bodies tell nothing, and the tree has taken what follows from others.
        let nearest = watch.nearest();
        if let Some(pivot) = nearest.and_then(|(time, bodies)| self.pivot(time, &bodies)) {
            watch.name(pivot.joint.to_f64() as usize);
        }
    }
}
