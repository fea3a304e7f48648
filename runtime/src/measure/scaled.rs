//! Capacities that a function of the motion and of the inputs scales.

use core::fmt::{self, Debug};

use crate::error::{Fault, ModeFault, StartFault};
use crate::math::scalar::{Real, Scalar};
use crate::measure::load::{AppliedForces, Loads};
use crate::measure::view::View;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::Nothing;
use crate::nonsmooth::handle::{InteractionHandle, named};
use crate::nonsmooth::status::Tracked;
use crate::state::sealed::Sealed;

/// Forces `A`, and a function `G` that scales the capacity of one interaction
/// ([`Simulation::capacity_factor`](crate::Simulation::capacity_factor)).
pub struct ScaledCapacity<M, A, G> {
    forces: A,
    interaction: InteractionHandle<M>,
    factor: G,
}

impl<M, A: Clone, G: Clone> Clone for ScaledCapacity<M, A, G> {
    fn clone(&self) -> Self {
        Self {
            forces: self.forces.clone(),
            interaction: self.interaction,
            factor: self.factor.clone(),
        }
    }
}

/// The interaction.
impl<M, A, G> Debug for ScaledCapacity<M, A, G> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ScaledCapacity")
            .field("interaction", &self.interaction)
            .finish_non_exhaustive()
    }
}

impl<M, A, G> ScaledCapacity<M, A, G> {
    pub(crate) fn new(forces: A, interaction: InteractionHandle<M>, factor: G) -> Self {
        Self {
            forces,
            interaction,
            factor,
        }
    }
}

impl<M, A, G> Sealed for ScaledCapacity<M, A, G> {}

impl<S, M, A, G> AppliedForces<S, M> for ScaledCapacity<M, A, G>
where
    S: Scalar,
    M: Mechanism,
    A: AppliedForces<S, M>,
    G: Fn(&View<'_, S, M>, &M::Inputs<S>) -> S,
{
    const PRESENT: bool = A::PRESENT;
    const INTERACTS: bool = A::INTERACTS;
    const HEEDS: bool = A::HEEDS;
    const SCALES: bool = true;

    type Tracked = A::Tracked;
    type Own = A::Own;
    type List = Nothing;
    type With<B: AppliedForces<S, M>> = ScaledCapacity<M, A::With<B>, G>;

    #[inline(always)]
    fn apply(&self, time: S, state: &M::State<S>, loads: &mut Loads<'_, S, M>) {
        self.forces.apply(time, state, loads);
    }

    fn tracked(&self, parameters: &M::Parameters<S>) -> A::Tracked
    where
        S: Real,
    {
        self.forces.tracked(parameters)
    }

    fn own(&self, parameters: &M::Parameters<S>) -> A::Own
    where
        S: Real,
    {
        self.forces.own(parameters)
    }

    fn with<B: AppliedForces<S, M>>(self, forces: B) -> Self::With<B> {
        ScaledCapacity {
            forces: self.forces.with(forces),
            interaction: self.interaction,
            factor: self.factor,
        }
    }

    fn scale(
        &self,
        view: &View<'_, S, M>,
        inputs: &M::Inputs<S>,
        list: &mut [Tracked<S, M>],
    ) -> Result<(), Fault>
    where
        S: Real,
    {
        self.forces.scale(view, inputs, list)?;
        let (place, tracked) = named(list, self.interaction)?;
        let is_finite = |tracked: &Tracked<S, M>| {
            let friction = tracked.interaction.law.friction();
            // Of a contact the first direction has the coefficient of both.
            let is_first = tracked.tangent().is_none_or(|tangent| tangent.behind == 1);
            is_first && friction.is_some_and(|friction| friction.at_rest().is_finite())
        };
        if !is_finite(tracked) {
            return Err(Fault::Start(StartFault::MisplacedSetting {
                joint: tracked.interaction.name(),
                setting: "capacity_factor",
            }));
        }
        let factor = (self.factor)(view, inputs);
        let is_factor = factor.is_finite() && factor >= S::zero();
        if !is_factor {
            return Err(Fault::Mode(ModeFault::CapacityFactor {
                joint: tracked.interaction.name(),
                factor: factor.to_f64(),
                time: view.time().to_f64(),
            }));
        }
        if let Some(tracked) = list.get_mut(place) {
            tracked.status.factor = tracked.status.factor * factor;
        }
        Ok(())
    }
}
