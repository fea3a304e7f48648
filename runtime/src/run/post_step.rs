//! What is done to states after steps, so that they stay on the constraints.

use crate::constraints::projection::Projection;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::mechanism::joint_kernels::JointCoordinates;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::check_state;
use crate::mechanism::relative::{bodies_of, joint_state_of};

/// What a run does to the state after every step, and to every state that it reports.
///
/// | stabilisation | what it corrects | what it costs |
/// |---|---|---|
/// | [`Projection`] | positions and velocities, by the least movement in the metric of the mass | as much as 22 evaluations of a pendulum, 15 of a four-bar, by their bodies; more where steps are long |
/// | [`VelocityProjection`] | velocities alone | as much as 15 and 9 |
/// | [`TreeRecovery`] | whatever the joints of a spanning tree allow: positions and velocities of bodies follow from their orientations and from each other, without an iteration | as much as 7 and 1; closing joints keep their violation |
///
/// Costs are of a step of Runge-Kutta against one without a stabilisation
/// (`study trade --problem pendulum --problem four-bar --scalar f64 --integrator rk4`, small
/// steps). Where they count, joint coordinates need none, and shorter steps with Baumgarte's terms
/// may be cheaper.
///
/// A stabilisation of one's own is a function of the constants of a mechanism, the time and the
/// state. Every one works with every integrator.
pub trait PostStabilisation<S: Real, M: Mechanism> {
    /// Treats a state; returns what it left beyond its tolerance, in sizes of a row, zero where
    /// nothing was.
    ///
    /// # Errors
    /// Why the state cannot be stabilised; it is then as before.
    fn stabilise(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault>;
}

impl<S: Real, M: Mechanism> PostStabilisation<S, M> for Projection<S> {
    fn stabilise(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault> {
        let correction = self.correct_in_motion::<M>(constants, time, state)?;
        Ok(correction.residual)
    }
}

/// The correction of velocities alone onto the constraints, as [`Projection`] does it; positions
/// stay as they are, and drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityProjection<S>(
    /// Its tolerance and its iterations.
    pub Projection<S>,
);

/// With the default [`Projection`].
impl<S: Real> Default for VelocityProjection<S> {
    fn default() -> Self {
        Self(Projection::default())
    }
}

impl<S: Real, M: Mechanism> PostStabilisation<S, M> for VelocityProjection<S> {
    fn stabilise(
        &self,
        constants: &M::Constants<S>,
        time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault> {
        self.0.correct_velocities::<M>(constants, time, state)
    }
}

/// The recovery of positions along the tree of the joints: the motion of every joint of the
/// spanning tree is read from the bodies, and the bodies are put where these motions take them.
///
/// Integrated positions of bodies drift apart from their orientations; read from the orientations,
/// they are as good as these. Joints of the tree are closed to round-off then. Those that close
/// loops, and those that do not say how they move, keep their violation: for them there is
/// [`Projection`].
pub struct TreeRecovery<S: Real, M: JointCoordinates> {
    constants: M::JointConstants<S>,
}

impl<S: Real, M: JointCoordinates> TreeRecovery<S, M> {
    /// For the present parameters of a mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable.
    pub fn new(mechanism: &M) -> Result<Self, Fault> {
        let parameters = mechanism.parameters()?;
        Ok(Self {
            constants: M::prepare_joints(&parameters),
        })
    }
}

impl<S: Real, M: JointCoordinates> PostStabilisation<S, M> for TreeRecovery<S, M> {
    fn stabilise(
        &self,
        _constants: &M::Constants<S>,
        _time: S,
        state: &mut M::State<S>,
    ) -> Result<S, Fault> {
        let joints = joint_state_of::<S, M>(&self.constants, state);
        let recovered = bodies_of::<S, M>(&self.constants, &joints);
        check_state::<S, M>(&recovered)?;
        *state = recovered;
        Ok(S::zero())
    }
}

impl<S: Real, M: JointCoordinates> Clone for TreeRecovery<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Real, M: JointCoordinates> Copy for TreeRecovery<S, M> {}

impl<S: Real, M: JointCoordinates> core::fmt::Debug for TreeRecovery<S, M> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("TreeRecovery").finish_non_exhaustive()
    }
}
