//! What a user says of limits, dry friction, brakes and clutches in a run.

use crate::dynamics::{Solvable, WithCapacityFactor, WithForces, WithInteractions};
use crate::integrate::Method;
use crate::math::scalar::Real;
use crate::measure::interacting::{Interacting, Unlimited};
use crate::measure::load::AppliedForces as _;
use crate::measure::scaled::ScaledCapacity;
use crate::measure::view::View;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::Beside;
use crate::nonsmooth::handle::InteractionHandle;
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
    /// - [`ModeFault::NoUniqueFriction`](crate::error::ModeFault::NoUniqueFriction) of friction by
    ///   load and of contacts, [`ModeFault::LoadNotUnique`](crate::error::ModeFault::LoadNotUnique)
    ///   of friction by load.
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

    /// Multiplies the capacity of dry friction, of a brake or of a clutch by a function of the
    /// motion and of the inputs, and the capacity of its [`Interaction::stiction`] likewise. Of
    /// friction by load it multiplies the coefficients, and of a contact that of both directions,
    /// by the handle of the first one. It is said behind
    /// [`Simulation::interactions`]. Several functions of one interaction are multiplied.
    ///
    /// Modes follow the capacity of the same instant: what sticks slides from where the capacity
    /// falls below the effort. The function is called at trial states and may remember nothing, as
    /// that of [`Simulation::forces`]. Say by [`Simulation::breaks`] where it jumps or bends in
    /// time. Inputs may jump: a controller or a handler begins a step.
    ///
    /// ```
    /// # use holonom::prelude::*;
    /// /// A wheel of 0.5 kg m^2 at 20 rad/s, with the pressure in its brake (bar).
    /// #[derive(Mechanism)]
    /// #[mechanism(coordinates = "joints")]
    /// struct Wheel {
    ///     #[input]
    ///     pressure: f64,
    ///     #[body(mass = 8.0, inertia = [0.5, 0.3, 0.3], angular_velocity = [20.0, 0.0, 0.0])]
    ///     wheel: Body,
    ///     #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     axle: Revolute,
    /// }
    /// let (wheel, h) = (Wheel::default(), Wheel::HANDLES);
    /// let interactions = [Interaction::brake(h.axle.angle(), 2.0)]; // N m for each bar
    /// let [brake] = Interaction::handles(&interactions);
    /// let report = wheel
    ///     .simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions(interactions)
    ///     .capacity_factor(brake, |_, inputs| inputs.pressure)
    ///     .every_period(0.1, |sample, inputs| inputs.pressure = 10.0 * sample.time())
    ///     .run(0.0..=1.0, every(0.1), |_| ())?;
    /// // 2 N m times 0, 1, .. 9 bar, for 0.1 s each
    /// let rate = wheel.view(1.0, &report.state)?.angle_rate(h.axle);
    /// assert!((rate - (20.0 - 0.1 * 45.0 * 2.0 / 0.5)).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors of the run
    /// - [`ModeFault::CapacityFactor`](crate::error::ModeFault::CapacityFactor) where the factor is
    ///   negative or not finite.
    /// - [`StartFault::MisplacedSetting`](crate::error::StartFault::MisplacedSetting) of limits, of
    ///   dogs, and of the second direction of a contact.
    /// - [`ReadingFault::NoSuchInteraction`](crate::error::ReadingFault::NoSuchInteraction).
    #[must_use]
    pub fn capacity_factor<G>(
        self,
        interaction: InteractionHandle<M>,
        factor: G,
    ) -> Simulation<'a, WithCapacityFactor<P, G>, I, H>
    where
        G: Fn(&View<'_, S, M>, &M::Inputs<S>) -> S,
    {
        const {
            assert!(
                P::Forces::INTERACTS,
                "`capacity_factor` is said behind `interactions`"
            )
        };
        self.exchange(|forces| ScaledCapacity::new(forces, interaction, factor))
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
