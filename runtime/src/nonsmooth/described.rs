//! The limits that a description has, and interactions of a run beside them.

use crate::error::{AssemblyFault, StartFault, Unheeding};
use crate::math::scalar::Real;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::limits::Several;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::law::Law;
use crate::nonsmooth::scene::Scene;
use crate::nonsmooth::status::Tracked;
use crate::state::vector::Array as _;

/// A mechanism with `N` joints that have limits, `#[joint(.., limits = [-1.0, 1.0])]`; the macro
/// implements it. Runs and steppers heed them without a word.
#[diagnostic::on_unimplemented(
    message = "no joint of `{Self}` has limits",
    label = "without limits in its description",
    note = "a hinge or a slide has limits by `#[joint(.., limits = [-1.0, 1.0])]`"
)]
pub trait Limited<const N: usize>: Mechanism {
    /// The limits as an array.
    #[doc(hidden)]
    fn described<S: Real>(parameters: &Self::Parameters<S>) -> [Interaction<S, Self>; N];

    /// The limits in the order of the fields, to give them another setting or another place in the
    /// list of [`Simulation::interactions`](crate::Simulation::interactions). What stands in that
    /// list takes the place of the limits that the run has of itself:
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
    /// let [hinge] = rod.limits();
    /// rod.simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions([hinge.rest_below(0.1), Interaction::friction(h.hinge.angle(), 0.2)])
    ///     .run(0.0..=10.0, every(0.01), |sample| {
    ///         assert!(sample.angle(h.hinge) > -1.0 - 1e-9);
    ///     })?;
    /// # Ok::<(), SimulationError<StateOf<Rod>>>(())
    /// ```
    ///
    /// Limits that are parameters have the values of this mechanism. With parameters that are not
    /// acceptable, for which any run is refused, they say nothing.
    fn limits<S: Real>(&self) -> [Interaction<S, Self>; N] {
        let parameters = self.parameters::<S>();
        Self::described(&parameters.unwrap_or_else(|_| Self::Parameters::zeros()))
    }
}

/// A mechanism of which a run with `K` interactions has `ALL`: those, and the limits of the
/// description behind them. The macro implements it.
#[diagnostic::on_unimplemented(
    message = "a run of `{Self}` does not take {K} interactions",
    label = "beside the limits in its description a run takes at most 32 interactions",
    note = "a function that is generic in the mechanism asks for `M: holonom::run::Beside<K, ALL>`"
)]
pub trait Beside<const K: usize, const ALL: usize>: Mechanism {
    /// All of them. Limits have no numbers yet, see [`renewed`].
    #[doc(hidden)]
    fn beside<S: Real>(own: [Interaction<S, Self>; K]) -> [Interaction<S, Self>; ALL] {
        const {
            let described = <Self::PerLimit<()> as Several<()>>::COUNT;
            assert!(ALL == K + described, "all are those given and the limits");
        };
        let parameters = Self::Parameters::zeros();
        let described = Self::limits_of(&parameters, Interaction::of_description);
        let own = own.map(|mut own| {
            own.is_described = false;
            own
        });
        let limits = described.as_ref().iter().copied().map(|mut limits| {
            limits.is_dropped = own.iter().any(|own| own.limits_the_same(&limits));
            limits
        });
        let mut all = own.iter().copied().chain(limits);
        core::array::from_fn(|_| all.next().unwrap_or_else(Interaction::nothing))
    }
}

/// A joint at this part of the way between its limits beyond one of them is beyond it.
const BEYOND: f64 = 1e-6;

/// Refuses a state in which a joint is beyond a limit of the description. An angle is that of all
/// turns which the state has counted.
pub(crate) fn check_limits<S: Real, M: Mechanism>(
    parameters: &M::Parameters<S>,
    constants: &M::Constants<S>,
    (time, bodies): (S, &M::State<S>),
) -> Result<(), AssemblyFault> {
    let described = M::limits_of(parameters, Interaction::<S, M>::of_description);
    let described: &[Interaction<S, M>] = described.as_ref();
    let scene = Scene::<S, M> {
        constants,
        time,
        bodies,
    };
    for interaction in described {
        let (Some(limits), quantity) = (interaction.law.limits(), &interaction.quantity) else {
            continue;
        };
        let [lower, upper] = limits.bounds;
        let way = upper - lower;
        let value = quantity.value(&scene);
        let beyond = S::constant(BEYOND) * way;
        let limit = if value < lower - beyond {
            lower
        } else if value > upper + beyond {
            upper
        } else {
            continue;
        };
        return Err(AssemblyFault::BeyondLimit {
            joint: interaction.name(),
            value: value.to_f64(),
            limit: limit.to_f64(),
        });
    }
    Ok(())
}

/// The first joint with a limit in the description.
fn first_limited<M: Mechanism>() -> Option<&'static str> {
    let parameters = M::Parameters::<f64>::zeros();
    let joints = M::limits_of(&parameters, |limits| limits.joint);
    let first = joints.as_ref().first()?;
    M::REPORT.joints.get(*first).map(|info| info.name)
}

/// Refuses to leave out the limits of the description.
pub(crate) fn refuse_limits<M: Mechanism>(by: Unheeding) -> Result<(), StartFault> {
    match first_limited::<M>() {
        Some(joint) => Err(StartFault::LimitsLeftOut { joint, by }),
        None => Ok(()),
    }
}

/// Interactions of a run that begins, with the limits of the description by its parameters.
pub(crate) fn renewed<S: Real, M: Mechanism, const K: usize>(
    interactions: &[Interaction<S, M>; K],
    parameters: &M::Parameters<S>,
    heeds: bool,
) -> [Tracked<S, M>; K] {
    let described = M::limits_of(parameters, |limits| {
        Interaction::<S, M>::of_description(limits).law
    });
    let described: &[Law<S>] = described.as_ref();
    let mut described = described.iter();
    interactions.map(|mut interaction| {
        if interaction.is_described
            && let Some(&law) = described.next()
        {
            interaction.law = law;
            interaction.is_dropped |= !heeds;
        }
        Tracked::new(interaction)
    })
}
