//! What a handler of an event sees, and may change.

use core::fmt::{self, Debug};
use core::ops::Deref;

use crate::assembly::subtree::Subtree;
use crate::dynamics::parameters;
use crate::error::Fault;
use crate::math::scalar::Real;
use crate::measure::access::MechanismExt as _;
use crate::mechanism::handle::{HasAngle, HasDisplacement, JointHandle, StateHandle};
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::handle::{InteractionHandle, engage};
use crate::nonsmooth::impulse::impact;
use crate::nonsmooth::quantity::JointQuantity;
use crate::nonsmooth::status::{Impact, Tracked};
use crate::run::sample::Sample;

/// An event of a run, for the handler of [`Simulation::on`](crate::Simulation::on): the
/// [`Sample`] as it was found, and what the handler changes.
///
/// Readings are those of the state that was found, whatever has been set since. Set positions
/// before velocities.
pub struct Event<'e, S: Real, M: Mechanism> {
    sample: Sample<'e, S, M>,
    name: &'static str,
    former: &'e M::Parameters<S>,
    pub(super) state: M::State<S>,
    pub(super) inputs: M::Inputs<S>,
    pub(super) parameters: Option<M::Parameters<S>>,
    /// What it engages and releases.
    interactions: &'e mut [Tracked<S, M>],
}

/// The name of the event and the sample.
impl<S: Real, M: Mechanism> Debug for Event<'_, S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Event")
            .field("name", &self.name)
            .field("sample", &self.sample)
            .finish_non_exhaustive()
    }
}

impl<'e, S: Real, M: Mechanism> Event<'e, S, M> {
    pub(super) fn new(
        (sample, name): (Sample<'e, S, M>, &'static str),
        (former, inputs): (&'e M::Parameters<S>, M::Inputs<S>),
        interactions: &'e mut [Tracked<S, M>],
    ) -> Self {
        Self {
            state: *sample.state(),
            sample,
            name,
            former,
            inputs,
            parameters: None,
            interactions,
        }
    }

    /// The name of the condition.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The state with which the run goes on. It is checked as a start is.
    pub fn state_mut(&mut self) -> &mut M::State<S> {
        &mut self.state
    }

    /// The inputs with which the run goes on.
    pub fn inputs_mut(&mut self) -> &mut M::Inputs<S> {
        &mut self.inputs
    }

    pub(super) fn sample_and_inputs(&mut self) -> (&Sample<'e, S, M>, &mut M::Inputs<S>) {
        (&self.sample, &mut self.inputs)
    }

    /// Goes on with the parameters and inputs of another value of the mechanism.
    ///
    /// # Errors
    /// A parameter that is not acceptable; the former ones then stay.
    pub fn update(&mut self, mechanism: &M) -> Result<(), Fault> {
        let parameters = parameters(mechanism)?;
        mechanism.check_likes(Some(self.former))?;
        self.inputs = mechanism.inputs();
        self.parameters = Some(parameters);
        Ok(())
    }

    /// Engages dry friction, a brake or a clutch.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`](crate::error::ReadingFault::NoSuchInteraction);
    /// [`StartFault::MisplacedSetting`](crate::error::StartFault::MisplacedSetting) of limits.
    pub fn engage(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.interactions, interaction, true)
    }

    /// Releases it.
    ///
    /// # Errors
    /// As [`Event::engage`].
    pub fn release(&mut self, interaction: InteractionHandle<M>) -> Result<(), Fault> {
        engage(self.interactions, interaction, false)
    }

    /// Gives an impulse along the angle or the displacement of a joint, after which its rate is
    /// `-restitution` times the one before (Newton's restitution, from 0 to 1). The constraints are
    /// kept, and the mechanism changes as little as it can in the metric of its mass. Limits and
    /// dogs on the way give their own impulses behind it.
    ///
    /// This is what an impact does to the whole mechanism; [`Event::set_angle_rate`] changes the
    /// rates of one joint alone.
    ///
    /// # Errors
    /// [`StartFault::InteractionSetting`](crate::error::StartFault::InteractionSetting) of a
    /// restitution that is not from 0 to 1; [`ModeFault::NoMode`](crate::error::ModeFault::NoMode)
    /// where the joint cannot move. The state is then as before.
    pub fn impact(
        &mut self,
        quantity: JointQuantity<M>,
        restitution: S,
    ) -> Result<Impact<S>, Fault> {
        let (constants, time) = (self.sample.constants(), self.sample.time());
        let found = impact::<S, M>(constants, time, &self.state, quantity, restitution)?;
        self.state = found.0;
        Ok(found.1)
    }

    /// Sets the angle of a joint (rad), see
    /// [`MechanismExt::set_angle`](crate::MechanismExt::set_angle).
    ///
    /// # Errors
    /// Those of that function. The state is then as before.
    pub fn set_angle<J: HasAngle>(
        &mut self,
        joint: JointHandle<M, J>,
        angle: S,
    ) -> Result<(), Fault> {
        self.state = self.subtree(joint)?.set_angle(angle)?;
        Ok(())
    }

    /// Sets the rate of the angle of a joint (rad/s), see
    /// [`MechanismExt::set_angle_rate`](crate::MechanismExt::set_angle_rate).
    ///
    /// # Errors
    /// Those of that function. The state is then as before.
    pub fn set_angle_rate<J: HasAngle>(
        &mut self,
        joint: JointHandle<M, J>,
        rate: S,
    ) -> Result<(), Fault> {
        self.state = self.subtree(joint)?.set_angle_rate(rate)?;
        Ok(())
    }

    /// Sets the displacement of a joint (m), see
    /// [`MechanismExt::set_displacement`](crate::MechanismExt::set_displacement).
    ///
    /// # Errors
    /// Those of that function. The state is then as before.
    pub fn set_displacement<J: HasDisplacement>(
        &mut self,
        joint: JointHandle<M, J>,
        displacement: S,
    ) -> Result<(), Fault> {
        self.state = self.subtree(joint)?.set_displacement(displacement)?;
        Ok(())
    }

    /// Sets the rate of the displacement of a joint (m/s), see
    /// [`MechanismExt::set_displacement_rate`](crate::MechanismExt::set_displacement_rate).
    ///
    /// # Errors
    /// Those of that function. The state is then as before.
    pub fn set_displacement_rate<J: HasDisplacement>(
        &mut self,
        joint: JointHandle<M, J>,
        rate: S,
    ) -> Result<(), Fault> {
        self.state = self.subtree(joint)?.set_displacement_rate(rate)?;
        Ok(())
    }

    /// Sets a state of the user's own, see
    /// [`MechanismExt::set_state_value`](crate::MechanismExt::set_state_value).
    pub fn set_state_value(&mut self, of: StateHandle<M>, value: S) {
        M::set_state_value(&mut self.state, of, value);
    }

    fn subtree<J>(&self, joint: JointHandle<M, J>) -> Result<Subtree<'_, S, M>, Fault> {
        Subtree::of(self.sample.constants(), &self.state, joint.index())
    }
}

impl<'e, S: Real, M: Mechanism> Deref for Event<'e, S, M> {
    type Target = Sample<'e, S, M>;

    fn deref(&self) -> &Sample<'e, S, M> {
        &self.sample
    }
}
