//! What a run moves: the bodies of a mechanism, or its joints.

use crate::dynamics::joint_dynamics::JointDynamics;
use crate::dynamics::{Dynamics, Iterations};
use crate::error::Fault;
use crate::formulation::Formulation;
use crate::integrate::System;
use crate::math::scalar::Real;
use crate::math::vec3::{read, write};
use crate::measure::load::AppliedForces;
use crate::mechanism::joint_kernels::{Freedom, JointCoordinates, JointParts};
use crate::mechanism::kernels::{Mechanism, Normalised, Orientation};
use crate::mechanism::report::BodyKind;
use crate::state::vector::{Array, StateParts};
use crate::watch::{Seen, Watch};

/// Gives the Euler parameters at a place the sign of those of another state.
fn take_nearer_sign<S: Real>(coordinates: &mut [S], near: &[S], place: usize) {
    let (p, q): ([S; 4], [S; 4]) = (read(coordinates, place), read(near, place));
    let terms = p.iter().zip(&q);
    let alike = terms.fold(S::zero(), |sum, (&p, &q)| p.fused(q, sum));
    if alike < S::zero() {
        write(coordinates, place, p.map(|element| -element));
    }
}

/// Bodies with those signs of Euler parameters that are nearer to those of another state.
fn with_nearer_signs<S: Real, M: Mechanism>(
    mut bodies: M::State<S>,
    near: &M::State<S>,
) -> M::State<S> {
    for body in M::REPORT.bodies {
        if body.kind == BodyKind::Rigid {
            let place = body.coordinate + 3;
            let coordinates = bodies.coordinates_mut().as_mut_slice();
            take_nearer_sign(coordinates, near.coordinates().as_slice(), place);
        }
    }
    bodies
}

/// A run moves positions and orientations of the bodies.
#[derive(Clone, Copy, Debug)]
pub struct Bodies;

/// A run moves joint coordinates.
#[derive(Clone, Copy, Debug)]
pub struct Joints;

/// By what a run describes a mechanism: [`Bodies`] or [`Joints`].
pub trait Description<S: Real, M: Mechanism, F: Formulation<S>, P, A> {
    /// Whether there are joints that nothing can open.
    #[doc(hidden)]
    const HAS_EXACT_JOINTS: bool;

    /// What the integrator moves.
    #[doc(hidden)]
    type Moving: Moving<S, M>;

    /// Prepares it.
    #[doc(hidden)]
    fn moving(dynamics: Dynamics<S, M, F, P, A>) -> Result<Self::Moving, Fault>;
}

/// A system whose states say how the bodies of a mechanism stand.
pub trait Moving<S: Real, M: Mechanism>: System<S> {
    /// The formulation of what reads the mechanism.
    type Formulation: Formulation<S>;
    /// How it reads Euler parameters.
    type Orientation: Orientation;
    /// Its forces on top of those of the description.
    type Forces: AppliedForces<S, M>;

    /// What evaluations leave behind for the watch.
    type Seen: Copy;

    /// How the bodies stand and move, when they stood near by a moment ago: Euler parameters keep
    /// their signs as far as they can.
    fn bodies(&self, state: &Self::State, near: &M::State<S>) -> M::State<S>;

    /// The state in which they stand and move so, or nearly so.
    fn of(&self, bodies: &M::State<S>) -> Self::State;

    /// The same, with those signs of Euler parameters that are nearer to those of another state: a
    /// method that looks back at former steps does not know that both are one orientation.
    fn of_near(&self, bodies: &M::State<S>, near: &Self::State) -> Self::State;

    /// What reads the mechanism.
    fn dynamics(&self) -> &Dynamics<S, M, Self::Formulation, Self::Orientation, Self::Forces>;

    /// How often the augmented Lagrangian solved its system.
    fn iterations(&self) -> Iterations;

    /// Counts as if no more of these had been.
    fn recount(&mut self, iterations: Iterations);

    /// What was seen at the last evaluation.
    fn seen(&self) -> Self::Seen;

    /// As if that had been the last evaluation.
    fn recall(&mut self, seen: Self::Seen);

    /// The smallest relative pivot between the ends of steps; `None` where there is nothing to look
    /// at.
    fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S>;

    /// Finds the joint of the smallest pivot of a run.
    fn name_smallest_pivot(&self, watch: &mut Watch<S, M>);

    /// Shows the end of a step to the watch, of which the last evaluation tells.
    fn watch(&mut self, watch: &mut Watch<S, M>, time: S, bodies: &M::State<S>);
}

impl<S, M, F, P, A> Description<S, M, F, P, A> for Bodies
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    const HAS_EXACT_JOINTS: bool = false;
    type Moving = Dynamics<S, M, F, P, A>;

    fn moving(dynamics: Dynamics<S, M, F, P, A>) -> Result<Self::Moving, Fault> {
        Ok(dynamics)
    }
}

impl<S, M, F, P, A> Moving<S, M> for Dynamics<S, M, F, P, A>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    P: Orientation,
    A: AppliedForces<S, M>,
{
    type Formulation = F;
    type Orientation = P;
    type Forces = A;
    type Seen = Seen<S, M>;

    #[inline(always)]
    fn bodies(&self, state: &M::State<S>, _near: &M::State<S>) -> M::State<S> {
        *state
    }

    #[inline(always)]
    fn of(&self, bodies: &M::State<S>) -> M::State<S> {
        *bodies
    }

    fn of_near(&self, bodies: &M::State<S>, near: &M::State<S>) -> M::State<S> {
        with_nearer_signs::<S, M>(*bodies, near)
    }

    #[inline(always)]
    fn dynamics(&self) -> &Self {
        self
    }

    fn iterations(&self) -> Iterations {
        Dynamics::iterations(self)
    }

    fn recount(&mut self, iterations: Iterations) {
        self.iterations = iterations;
    }

    fn seen(&self) -> Seen<S, M> {
        self.seen
    }

    fn recall(&mut self, seen: Seen<S, M>) {
        self.seen = seen;
    }

    fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        Dynamics::pivot_within(self, time, bodies)
    }

    fn name_smallest_pivot(&self, watch: &mut Watch<S, M>) {
        Dynamics::name_smallest_pivot(self, watch);
    }

    #[inline(always)]
    fn watch(&mut self, watch: &mut Watch<S, M>, time: S, bodies: &M::State<S>) {
        Dynamics::watch(self, watch, (time, bodies), None);
    }
}

impl<S, M, F, A> Description<S, M, F, Normalised, A> for Joints
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    const HAS_EXACT_JOINTS: bool = true;
    type Moving = JointDynamics<S, M, F, A>;

    fn moving(dynamics: Dynamics<S, M, F, Normalised, A>) -> Result<Self::Moving, Fault> {
        JointDynamics::with(dynamics)
    }
}

impl<S, M, F, A> Moving<S, M> for JointDynamics<S, M, F, A>
where
    S: Real,
    M: JointCoordinates,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
{
    type Formulation = F;
    type Orientation = Normalised;
    type Forces = A;
    type Seen = ();

    // Turns about an axis are pairs on a circle, which do not tell the two signs apart.
    fn bodies(&self, state: &M::JointState<S>, near: &M::State<S>) -> M::State<S> {
        with_nearer_signs::<S, M>(Self::bodies(self, state), near)
    }

    fn of(&self, bodies: &M::State<S>) -> M::JointState<S> {
        self.nearest(bodies)
    }

    fn of_near(&self, bodies: &M::State<S>, near: &M::JointState<S>) -> M::JointState<S> {
        let mut state = self.nearest(bodies);
        let mut place = 0;
        for motion in M::JOINT_REPORT.motions {
            match motion.freedom {
                // The angle of a screw is an auxiliary variable.
                Freedom::Turn { .. } | Freedom::Screw { .. } => {}
                Freedom::Slide => place += 1,
                Freedom::Ball => {
                    take_nearer_sign(state.rest_slice_mut(), near.rest_slice(), place);
                    place += 4;
                }
            }
        }
        state
    }

    fn dynamics(&self) -> &Dynamics<S, M, F, Normalised, A> {
        self.of_bodies()
    }

    fn iterations(&self) -> Iterations {
        Self::iterations(self)
    }

    fn recount(&mut self, iterations: Iterations) {
        self.iterations = iterations;
    }

    // The watch evaluates the end of a step by itself.
    fn seen(&self) {}

    fn recall(&mut self, (): ()) {}

    fn pivot_within(&self, time: S, bodies: &M::State<S>) -> Option<S> {
        Self::pivot_within(self, time, bodies)
    }

    fn name_smallest_pivot(&self, watch: &mut Watch<S, M>) {
        Self::name_smallest_pivot(self, watch);
    }

    fn watch(&mut self, watch: &mut Watch<S, M>, time: S, bodies: &M::State<S>) {
        Self::watch(self, watch, time, bodies);
    }
}
