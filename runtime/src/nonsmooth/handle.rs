//! Handles of interactions, and what they name in the list of a run.

use core::fmt::{self, Debug};
use core::marker::PhantomData;

use crate::error::{Fault, ReadingFault, StartFault};
use crate::math::scalar::Real;
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::interaction::Interaction;
use crate::nonsmooth::law::Law;
use crate::nonsmooth::quantity::{JointQuantity, JointReading, Quantity};
use crate::nonsmooth::status::{Show, Tracked};

/// An interaction of a run of the mechanism `M`: one of a list, by [`Interaction::handles`], or the
/// limits of a joint, by [`JointQuantity::limits`].
///
/// A handle of another mechanism is refused by the compiler:
///
/// ```compile_fail,E0308
/// # use holonom::prelude::*;
/// # use holonom::run::InteractionHandle;
/// # #[derive(Mechanism)]
/// # struct Cart {
/// #     #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
/// #     cart: Body,
/// #     #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
/// #     rail: Prismatic,
/// # }
/// # #[derive(Mechanism)]
/// # struct Drum {
/// #     #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
/// #     drum: Body,
/// #     #[joint(between = [ground, drum], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
/// #     shaft: Revolute,
/// # }
/// fn holds(sample: &Sample<'_, f64, Cart>, brake: InteractionHandle<Drum>) -> bool {
///     sample.mode(brake).is_ok()
/// }
/// ```
pub struct InteractionHandle<M> {
    which: Which,
    mechanism: PhantomData<fn() -> M>,
}

/// Which interaction of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Which {
    /// The one at a place of the list that the run was given, which is of this kind.
    Listed(usize, Kind),
    /// The limits of a quantity, wherever they come from.
    Limits(JointReading),
}

/// What an interaction is, without its numbers: it tells most lists apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Kind {
    is_limits: bool,
    quantity: Quantity<()>,
}

impl Kind {
    fn of<S, M>(interaction: &Interaction<S, M>) -> Self {
        Self {
            is_limits: matches!(interaction.law, Law::Limits(_)),
            quantity: interaction.quantity.without_numbers(),
        }
    }
}

copied! {
    [M] InteractionHandle<M>;
}

impl<M> PartialEq for InteractionHandle<M> {
    fn eq(&self, other: &Self) -> bool {
        self.which == other.which
    }
}

impl<M> Eq for InteractionHandle<M> {}

/// The place in the list with what is there, or the quantity.
impl<M> Debug for InteractionHandle<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.which.fmt(f)
    }
}

impl<M> InteractionHandle<M> {
    fn of(which: Which) -> Self {
        Self {
            which,
            mechanism: PhantomData,
        }
    }
}

impl<S, M> Interaction<S, M> {
    /// The handles of a list, for handlers and observers of the run that is given this list.
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
    /// let interactions = [
    ///     Interaction::limits(h.hinge.angle(), [-1.0, 1.0]),
    ///     Interaction::brake(h.hinge.angle(), 9.0),
    /// ];
    /// let [stop, brake] = Interaction::handles(&interactions);
    /// rod.simulation(StandardLagrange, DormandPrince::default())
    ///     .interactions(interactions)
    ///     .on("let go", Crossing::Rising, |s| s.time() - 0.5, move |event| event.release(brake))
    ///     .run(0.0..=1.0, every(0.01), |sample| -> Result<(), Fault> {
    ///         let is_struck = sample.impact(stop)?.is_some();
    ///         assert!(!is_struck || sample.time() > 0.5);
    ///         Ok(())
    ///     })?;
    /// # Ok::<(), RunError<StateOf<Rod>, Fault>>(())
    /// ```
    #[must_use]
    pub fn handles<const K: usize>(list: &[Self; K]) -> [InteractionHandle<M>; K] {
        let mut places = 0..K;
        list.each_ref().map(|interaction| {
            let place = places.next().unwrap_or(K);
            InteractionHandle::of(Which::Listed(place, Kind::of(interaction)))
        })
    }
}

impl<M> JointQuantity<M> {
    /// The limits of the quantity in a run: those of the description, `#[joint(.., limits = ..)]`,
    /// or the first ones in the list of
    /// [`Simulation::interactions`](crate::Simulation::interactions), which take their place.
    #[must_use]
    pub fn limits(self) -> InteractionHandle<M> {
        InteractionHandle::of(Which::Limits(self.reading))
    }
}

/// What a handle names among the interactions of a run, with its place there.
pub(crate) fn named<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    handle: InteractionHandle<M>,
) -> Result<(usize, &Tracked<S, M>), ReadingFault> {
    let mut all = list.iter().enumerate();
    match handle.which {
        Which::Listed(number, kind) => {
            let mut given = all.filter(|(_, of)| !of.interaction.is_described);
            let interactions = given.clone().count();
            let named = given.nth(number);
            let named = named.filter(|(_, of)| Kind::of(&of.interaction) == kind);
            named.ok_or(ReadingFault::NoSuchInteraction {
                number,
                interactions,
            })
        }
        Which::Limits(reading) => {
            let limits_it = |(_, tracked): &(usize, &Tracked<S, M>)| {
                let Interaction { quantity, law, .. } = &tracked.interaction;
                let is_of_it = matches!(quantity, Quantity::Joint(of) if *of == reading);
                is_of_it && law.limits().is_some() && !tracked.interaction.is_dropped
            };
            all.find(limits_it).ok_or(ReadingFault::NoSuchLimits {
                joint: Quantity::<S>::Joint(reading).name::<M>(),
            })
        }
    }
}

/// The effort (N m, N) of what a handle names, by what shows the efforts of all.
pub(crate) fn effort_of<S: Real, M: Mechanism>(
    list: &[Tracked<S, M>],
    handle: InteractionHandle<M>,
    find: impl FnOnce(&mut Show<'_, S>) -> Result<(), Fault>,
) -> Result<S, Fault> {
    let (place, _) = named(list, handle)?;
    let mut effort = S::zero();
    find(&mut |all| effort = all.get(place).map_or(effort, |exerted| exerted.effort))?;
    Ok(effort)
}

/// Engages or releases what a handle names. A limit is neither, nor friction of a contact.
pub(crate) fn engage<S: Real, M: Mechanism>(
    list: &mut [Tracked<S, M>],
    handle: InteractionHandle<M>,
    is_engaged: bool,
) -> Result<(), Fault> {
    let (place, tracked) = named(list, handle)?;
    let law = &tracked.interaction.law;
    if law.limits().is_some() || law.tangent().is_some() {
        return Err(Fault::Start(StartFault::MisplacedSetting {
            joint: tracked.interaction.name(),
            setting: if is_engaged { "engage" } else { "release" },
        }));
    }
    if let Some(tracked) = list.get_mut(place) {
        tracked.status.engage(is_engaged);
    }
    Ok(())
}
