//! What a user says of limits, dry friction, brakes and clutches in a run.

use crate::dynamics::{Solvable, WithForces, WithInteractions};
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::interacting::{Interacting, Unlimited};
use crate::measure::load::AppliedForces as _;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::Beside;
use crate::nonsmooth::interaction::Interaction;
use crate::run::simulation::Simulation;

impl<'a, P, S: Real, M: Mechanism, I, H> Simulation<'a, P, I, H>
where
    P: Solvable<Number = S, Mechanism = M>,
    I: Method<S>,
{
    /// Adds limits, dry friction, brakes and clutches, which handlers and observers call by
    /// [handles](Interaction::handles). See [`guide::contact`](mod@crate::guide::contact).
    ///
    /// The limits of the description, `#[joint(.., limits = [-1.0, 1.0])]`, are heeded without a
    /// word, and called by [`JointQuantity::limits`](crate::run::JointQuantity::limits). Where the
    /// list has limits of the same quantity, those hold instead. It is said once.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// # #[derive(Mechanism)]
    /// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// # struct Rod {
    /// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    /// #     rod: Body,
    /// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    /// #     hinge: Revolute,
    /// # }
    /// let (rod, h) = (Rod::default(), Rod::HANDLES);
    /// rod.simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions([
    ///         Interaction::limits(h.hinge.angle(), [-1.0, 1.0]).restitution(0.4),
    ///         Interaction::friction(h.hinge.angle(), 0.2),
    ///     ])
    ///     .run(0.0..=10.0, every(0.01), |sample| {
    ///         assert!(sample.angle(h.hinge) > -1.0 - 1e-9);
    ///     })?;
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// # Errors of the run
    /// - [`StartFault::InteractionSetting`](crate::error::StartFault::InteractionSetting) and
    ///   [`StartFault::MisplacedSetting`](crate::error::StartFault::MisplacedSetting) of what is
    ///   not acceptable.
    /// - [`AssemblyFault::BeyondLimit`](crate::error::AssemblyFault::BeyondLimit) of a start, a
    ///   handler or a driver.
    /// - [`ModeFault::NoMode`](crate::error::ModeFault::NoMode) and
    ///   [`ModeFault::Endless`](crate::error::ModeFault::Endless) where no modes are found.
    /// - [`ModeFault::NoUniqueFriction`](crate::error::ModeFault::NoUniqueFriction) and
    ///   [`ModeFault::LoadNotUnique`](crate::error::ModeFault::LoadNotUnique) of friction by load.
    /// - [`StepFault::TooShort`](crate::error::StepFault::TooShort) where the turns of an angle
    ///   with limits cannot be followed.
    /// - [`StartFault::NoInteractions`](crate::error::StartFault::NoInteractions) with
    ///   [`GeneralizedAlpha`](crate::GeneralizedAlpha).
    #[must_use]
    pub fn interactions<const K: usize, const ALL: usize>(
        self,
        interactions: [Interaction<S, M>; K],
    ) -> Simulation<'a, WithInteractions<P, ALL>, I, H>
    where
        M: Beside<K, ALL>,
    {
        const {
            assert!(
                !P::Forces::INTERACTS,
                "`interactions` are said once, in one list"
            )
        };
        self.exchange(|forces| Interacting::new(forces, M::beside(interactions)))
    }

    /// Passes the limits of the description, `#[joint(.., limits = [-1.0, 1.0])]`, as if there were
    /// none. Those of [`Simulation::interactions`] hold.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// A rod of 1 m, released from the horizontal.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
    /// struct Rod {
    ///     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    ///     rod: Body,
    ///     #[joint(
    ///         between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
    ///         limits = [-1.0, 1.0], restitution = 0.4
    ///     )]
    ///     hinge: Revolute,
    /// }
    ///
    /// let (rod, h) = (Rod::default(), Rod::HANDLES);
    /// let simulation = rod.simulation(StandardLagrange, DormandPrince::default());
    /// let lowest =
    ///     |report: &RunReport<f64, Rod>| rod.view(1.0, &report.state).map(|v| v.angle(h.hinge));
    /// let stopped = simulation.clone().run(0.0..=0.7, every(0.1), |_| ())?;
    /// let free = simulation.without_limits().run(0.0..=0.7, every(0.1), |_| ())?;
    /// assert!(lowest(&stopped)? > -1.0 - 1e-9 && lowest(&free)? < -1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn without_limits(self) -> Simulation<'a, WithForces<P, Unlimited<P::Forces>>, I, H> {
        self.exchange(Unlimited)
    }
}
