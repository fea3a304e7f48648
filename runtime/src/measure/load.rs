//! Forces that a user applies at run time.

use core::marker::PhantomData;

use crate::math::quaternion::{normalised, rotate, rotate_back};
use crate::math::scalar::Scalar;
use crate::math::vec3::{cross, read};
use crate::measure::access::MechanismExt;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// Forces and moments beyond those of the description, as a function of time and state.
pub trait AppliedForces<S: Scalar, M: Mechanism> {
    /// Whether there are any: `false` keeps the fused evaluation.
    const PRESENT: bool;

    /// Adds the forces at a time and a state.
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>);
}

/// No forces beyond those of the description; costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NoForces;

impl<S: Scalar, M: Mechanism> AppliedForces<S, M> for NoForces {
    const PRESENT: bool = false;

    #[inline(always)]
    fn apply(&self, _time: S, _state: &M::State<S>, _loads: &mut Loads<'_, S, M>) {}
}

impl<S: Scalar, M: Mechanism, A: AppliedForces<S, M>> AppliedForces<S, M> for &A {
    const PRESENT: bool = A::PRESENT;

    #[inline(always)]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        A::apply(self, time, state, loads);
    }
}

/// Forces from a closure `Fn(time, &state, &mut loads)`.
#[derive(Clone, Copy, Debug)]
pub struct ForceLaw<G>(pub G);

impl<S: Scalar, M: Mechanism, G> AppliedForces<S, M> for ForceLaw<G>
where
    G: Fn(S, &M::State<S>, &mut Loads<'_, S, M>),
{
    const PRESENT: bool = true;

    #[inline]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        (self.0)(time, state, loads);
    }
}

/// Where a user adds forces (N) and moments (N m) on bodies. Contributions add up.
pub struct Loads<'a, S: Scalar, M: Mechanism> {
    state: &'a M::State<S>,
    forces: &'a mut M::Velocities<S>,
    mechanism: PhantomData<fn() -> M>,
}

impl<'a, S: Scalar, M: Mechanism> Loads<'a, S, M> {
    /// Loads to be added to `g`, in a state whose Euler parameters are as the kernels read them.
    pub(crate) fn new(state: &'a M::State<S>, forces: &'a mut M::Velocities<S>) -> Self {
        Self {
            state,
            forces,
            mechanism: PhantomData,
        }
    }

    /// A force (N, global) at the centre of mass.
    pub fn force(&mut self, body: BodyHandle<M>, force: [S; 3]) {
        if let Some(info) = body.info() {
            self.add(info.velocity, force);
        }
    }

    /// A force (N, global) at a point of the body, given from the centre of mass in the user's body
    /// axes (m).
    pub fn force_at(&mut self, body: BodyHandle<M>, point: [S; 3], force: [S; 3]) {
        self.force(body, force);
        let arm = rotate(&M::orientation(self.state, body), &point);
        self.moment(body, cross(&arm, &force));
    }

    /// A moment (N m, global). Without effect on a particle.
    pub fn moment(&mut self, body: BodyHandle<M>, moment: [S; 3]) {
        if let Some((info, place)) = body.orientation() {
            let p = normalised(&read(self.state.coordinates().as_slice(), place));
            self.add(info.velocity + 3, rotate_back(&p, &moment));
        }
    }

    /// A moment (N m) in the user's body axes. Without effect on a particle.
    pub fn moment_in_body_axes(&mut self, body: BodyHandle<M>, moment: [S; 3]) {
        if let Some((info, _)) = body.orientation() {
            let axes = M::user_axes(body.index()).map(S::constant);
            self.add(info.velocity + 3, rotate(&axes, &moment));
        }
    }

    fn add(&mut self, place: usize, value: [S; 3]) {
        for (element, value) in self.forces.as_mut_slice().iter_mut().skip(place).zip(value) {
            *element = *element + value;
        }
    }
}
