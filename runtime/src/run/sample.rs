//! What an observer of a run sees.

use core::cell::OnceCell;
use core::fmt::{self, Debug};
use core::ops::Deref;

use nalgebra::Vector3;

use crate::dynamics::evaluate::Evaluate;
use crate::error::{Fault, ReadingFault};
use crate::math::scalar::Real;
use crate::measure::reaction::Wrench;
use crate::measure::view::View;
use crate::mechanism::coordinates::Evaluation;
use crate::mechanism::handle::{
    BodyHandle, Driven, HasAngle, HasDisplacement, HasTwoAngles, JointHandle,
};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::Located;
use crate::mechanism::readout::ContactPoint;
use crate::nonsmooth::handle::{InteractionHandle, effort_of, named};
use crate::nonsmooth::mode::InteractionMode;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::{Impact, Show, Tracked};
use crate::state::vector::StateParts;

/// A state at a reporting time: a [`View`], and what takes an evaluation.
///
/// Accelerations, multipliers and reactions are computed when they are first asked for, by one
/// evaluation that the run does not count.
pub struct Sample<'a, S: Real, M: Mechanism> {
    view: View<'a, S, M>,
    dynamics: &'a dyn Evaluate<S, M>,
    evaluation: OnceCell<Result<Evaluation<S, M>, Fault>>,
    companion: Option<M::State<S>>,
}

/// As the view of the state at hand.
impl<S: Real, M: Mechanism> Debug for Sample<'_, S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Debug::fmt(&self.view, f)
    }
}

impl<'a, S: Real, M: Mechanism> Sample<'a, S, M> {
    pub(crate) fn new(view: View<'a, S, M>, dynamics: &'a dyn Evaluate<S, M>) -> Self {
        Self {
            view,
            dynamics,
            evaluation: OnceCell::new(),
            companion: None,
        }
    }

    /// A sample whose evaluation has been done.
    pub(crate) fn evaluated(
        view: View<'a, S, M>,
        dynamics: &'a dyn Evaluate<S, M>,
        evaluation: Result<Evaluation<S, M>, Fault>,
    ) -> Self {
        Self {
            view,
            dynamics,
            evaluation: OnceCell::from(evaluation),
            companion: None,
        }
    }

    /// The same with the bodies of a companion.
    pub(crate) fn beside(self, companion: Option<M::State<S>>) -> Self {
        Self { companion, ..self }
    }

    /// The estimated error of what is read of a state, by the companion of a run that is
    /// [`verified`](crate::Simulation::verified): the difference between both. `None` without a
    /// companion, and once it has ended.
    pub fn error_of(&self, read: impl Fn(&View<'_, S, M>) -> S) -> Option<S> {
        let companion = self.companion.as_ref()?;
        let other = self.view.of_state(companion);
        Some((read(&self.view) - read(&other)).abs())
    }

    /// Rates of the state, and multipliers.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn evaluation(&self) -> Result<&Evaluation<S, M>, Fault> {
        let evaluate = || self.dynamics.evaluation(self.time(), self.state());
        self.evaluation
            .get_or_init(evaluate)
            .as_ref()
            .map_err(|fault| *fault)
    }

    /// The multipliers, one per equation.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn multipliers(&self) -> Result<M::Multipliers<S>, Fault> {
        Ok(self.evaluation()?.multipliers)
    }

    /// What a joint exerts on one of its bodies, see [`View::reaction`].
    ///
    /// # Errors
    /// The fault of the evaluation;
    /// [`ReadingFault::NotBetween`] for a body that is not of the joint.
    pub fn reaction<J>(
        &self,
        joint: JointHandle<M, J>,
        body: BodyHandle<M>,
    ) -> Result<Wrench<S>, Fault> {
        let multipliers = &self.evaluation()?.multipliers;
        Ok(self.view.reaction(multipliers, joint, body)?)
    }

    /// What a joint exerts on the body at a place of its `between`, see
    /// [`View::reaction_on_place`].
    ///
    /// # Errors
    /// The fault of the evaluation;
    /// [`ReadingFault::NoSuchPlace`] for a place that `between` does not have.
    pub fn reaction_on_place<J>(
        &self,
        joint: JointHandle<M, J>,
        place: usize,
    ) -> Result<Wrench<S>, Fault> {
        let multipliers = &self.evaluation()?.multipliers;
        Ok(self.view.reaction_on_place(multipliers, joint, place)?)
    }

    /// The effort of a driver (N for a length, N m for an angle), see [`View::driving_effort`].
    ///
    /// # Errors
    /// The fault of the evaluation;
    /// [`ReadingFault::NoEffort`] where the driver's equation was left out as redundant.
    pub fn driving_effort<J: Driven>(&self, joint: JointHandle<M, J>) -> Result<S, Fault> {
        let multipliers = &self.evaluation()?.multipliers;
        Ok(self.view.driving_effort(multipliers, joint)?)
    }

    /// Accelerations `u'` (m/s^2 global; rad/s^2 principal body axes), one per velocity. By handle
    /// and in the user's axes: [`Sample::acceleration`], [`Sample::angular_acceleration`].
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn accelerations(&self) -> Result<M::Velocities<S>, Fault> {
        Ok(*self.evaluation()?.rates.velocities())
    }

    /// The acceleration of a body's centre of mass or of a named point (m/s^2, global).
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn acceleration(&self, at: impl Located<M>) -> Result<Vector3<S>, Fault> {
        Ok(self.view.acceleration(&self.evaluation()?.rates, at))
    }

    /// The angular acceleration of a body (rad/s^2) along its own axes, as the user gave them.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn angular_acceleration(&self, body: BodyHandle<M>) -> Result<Vector3<S>, Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.angular_acceleration(rates, body))
    }

    /// The angular acceleration of a body (rad/s^2) along the global axes.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn angular_acceleration_global(&self, body: BodyHandle<M>) -> Result<Vector3<S>, Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.angular_acceleration_global(rates, body))
    }

    /// The acceleration of a point of a body (m/s^2, global), given from the centre of mass along
    /// the user's body axes (m). It has the centripetal part.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn point_acceleration(
        &self,
        body: BodyHandle<M>,
        point: Vector3<S>,
    ) -> Result<Vector3<S>, Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.point_acceleration(rates, body, point))
    }

    /// The acceleration of the angle of a joint (rad/s^2), with the sign of [`View::angle`].
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn angle_acceleration<J: HasAngle>(&self, joint: JointHandle<M, J>) -> Result<S, Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.angle_acceleration(rates, joint))
    }

    /// The accelerations of both angles of a joint (rad/s^2), with the signs of [`View::angles`].
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn angle_accelerations<J: HasTwoAngles>(
        &self,
        joint: JointHandle<M, J>,
    ) -> Result<[S; 2], Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.angle_accelerations(rates, joint))
    }

    /// The acceleration of the displacement of a joint (m/s^2), with the sign of
    /// [`View::displacement`].
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn displacement_acceleration<J: HasDisplacement>(
        &self,
        joint: JointHandle<M, J>,
    ) -> Result<S, Fault> {
        let rates = &self.evaluation()?.rates;
        Ok(self.view.displacement_acceleration(rates, joint))
    }

    /// The mode of an interaction. The state in which a mode ends is shown in that mode, and once
    /// more in the next one after an impulse.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn mode(&self, interaction: InteractionHandle<M>) -> Result<InteractionMode, ReadingFault> {
        Ok(self.tracked(interaction)?.told_mode())
    }

    /// The power (W) of the forces of the language that have no potential
    /// ([`View::power`]), and of the interactions: what changes the energy of a mechanism without
    /// drivers and without a force closure, besides impacts ([`Impact::lost_energy`]). One
    /// evaluation where friction slides by its load, or a function scales a capacity; NaN where
    /// that cannot be done.
    #[must_use]
    pub fn power(&self) -> S {
        let list = self.dynamics.interactions();
        let scene = Scene {
            constants: self.view.constants(),
            time: self.time(),
            bodies: self.state(),
        };
        let mut power = self.view.power();
        if self.dynamics.scales_capacities() || list.iter().any(Tracked::slips_by_load) {
            let found = self.find_efforts(&mut |all| {
                for (tracked, exerted) in list.iter().zip(all) {
                    power = tracked.power(exerted.effort, &scene) + power;
                }
            });
            return found.map_or(S::constant(f64::NAN), |()| power);
        }
        for tracked in list {
            if let Some(effort) = tracked.sliding_effort(&scene) {
                power = tracked.power(effort, &scene) + power;
            }
        }
        power
    }

    /// The effort of an interaction (N m, N) along its quantity, positive upwards. One evaluation.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`], the fault of the
    /// evaluation.
    pub fn effort(&self, interaction: InteractionHandle<M>) -> Result<S, Fault> {
        let list = self.dynamics.interactions();
        effort_of(list, interaction, |show| self.find_efforts(show))
    }

    /// The last impulse of an interaction in the run so far, if there was one.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`].
    pub fn impact(
        &self,
        interaction: InteractionHandle<M>,
    ) -> Result<Option<Impact<S>>, ReadingFault> {
        Ok(self.tracked(interaction)?.status.impact)
    }

    /// Where the shape of a contact is nearest to its surface, closed or not.
    ///
    /// # Errors
    /// [`ReadingFault::NoSuchInteraction`], [`ReadingFault::NoSuchLimits`];
    /// [`ReadingFault::NoContact`] of an interaction that is none.
    pub fn contact_of(
        &self,
        interaction: InteractionHandle<M>,
    ) -> Result<ContactPoint<S>, ReadingFault> {
        let interaction = &self.tracked(interaction)?.interaction;
        let scene = Scene::<S, M> {
            constants: self.view.constants(),
            time: self.time(),
            bodies: self.state(),
        };
        let contact = interaction.quantity.contact(&scene);
        contact.ok_or(ReadingFault::NoContact {
            interaction: interaction.name(),
        })
    }

    fn tracked(
        &self,
        interaction: InteractionHandle<M>,
    ) -> Result<&'a Tracked<S, M>, ReadingFault> {
        let (_, tracked) = named(self.dynamics.interactions(), interaction)?;
        Ok(tracked)
    }

    fn find_efforts(&self, show: &mut Show<'_, S>) -> Result<(), Fault> {
        self.dynamics.find_efforts(self.time(), self.state(), show)
    }

    /// The violation of the constraints by the accelerations: the square of `D u' - gamma`.
    ///
    /// # Errors
    /// The fault of the evaluation.
    pub fn acceleration_violation(&self) -> Result<S, Fault> {
        Ok(self
            .view
            .acceleration_violation(self.evaluation()?.rates.velocities()))
    }
}

impl<'a, S: Real, M: Mechanism> Deref for Sample<'a, S, M> {
    type Target = View<'a, S, M>;

    fn deref(&self) -> &View<'a, S, M> {
        &self.view
    }
}
