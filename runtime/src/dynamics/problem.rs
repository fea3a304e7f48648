//! What is solved, as one type.

use core::marker::PhantomData;

use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::interacting::{Heeding, Interacting};
use crate::measure::load::{AppliedForces, ForceLaw, NoForces};
use crate::measure::scaled::ScaledCapacity;
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::{Mechanism, StateOf};

/// A mechanism `M` with a formulation `F`, over numbers `S`, in coordinates `C`, and with forces
/// `A` beside those of its description.
///
/// What is not said is the usual: numbers of type `f64`, the coordinates that the attribute of the
/// mechanism names, no further forces. So `Problem<Rod, StandardLagrange>` is that of
/// `rod.simulation(StandardLagrange, ..)`, and `Problem<Rod, StandardLagrange, f32>` the same in
/// single precision.
///
/// It is never a value. It stands in the type of what solves it, such as
/// [`Simulation`](crate::Simulation) and [`Stepper`](crate::Stepper), where a struct of yours has
/// to name that:
///
/// ```
/// use holonom::dynamics::State;
/// use holonom::prelude::*;
///
/// # #[derive(Mechanism)]
/// # #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
/// # struct Rod {
/// #     #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
/// #     rod: Body,
/// #     #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
/// #     hinge: Revolute,
/// # }
/// type Swing = Problem<Rod, StandardLagrange>;
///
/// struct Plant {
///     stepper: Stepper<Swing, Rk4>,
///     state: State<Swing>,
/// }
///
/// let stepper = Rod::default().stepper(StandardLagrange, Rk4)?;
/// let mut plant = Plant { state: stepper.initial_state()?, stepper };
/// plant.stepper.step(&mut plant.state, 1e-3)?;
/// # Ok::<(), Fault>(())
/// ```
///
/// [`WithCoordinates`], [`WithForces`], [`WithInteractions`] and [`WithCapacityFactor`] say what
/// was changed, as in `Stepper<WithInteractions<Swing, 1>, Rk4>`.
///
/// A function over all problems asks for a [`Solvable`]. One that runs or steps asks its method for
/// [`Runs`](crate::Runs), [`Leads`](crate::run::Leads) or [`Steps`](crate::run::Steps) of it.
pub struct Problem<M: Mechanism, F, S = f64, C = <M as Mechanism>::Coordinates, A = NoForces>(
    PhantomData<Parts<M, F, S, C, A>>,
);

/// It has none of them.
type Parts<M, F, S, C, A> = fn() -> (M, F, S, C, A);

impl<M: Mechanism, F, S, C, A> core::fmt::Debug for Problem<M, F, S, C, A> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Problem").field(&M::REPORT.name).finish()
    }
}

/// What a [`Problem`] is made of. Nothing else implements it.
pub trait Posed: private::Sealed {
    /// The mechanism.
    type Mechanism: Mechanism;
    /// The formulation.
    type Formulation;
    /// The number type.
    type Number: Real;
    /// The coordinates in which the equations of motion are solved.
    type Coordinates;
    /// Forces beside those of the description.
    type Forces;
}

impl<M: Mechanism, F, S: Real, C, A> Posed for Problem<M, F, S, C, A> {
    type Mechanism = M;
    type Formulation = F;
    type Number = S;
    type Coordinates = C;
    type Forces = A;
}

/// A [`Problem`] whose parts go together: what can be solved. Nothing else implements it.
pub trait Solvable:
    Posed<
        Formulation: Formulation<<Self as Posed>::Number>,
        Coordinates: Coordinates<<Self as Posed>::Mechanism>,
        Forces: AppliedForces<<Self as Posed>::Number, <Self as Posed>::Mechanism>,
    >
{
}

impl<M, F, S, C, A> Solvable for Problem<M, F, S, C, A>
where
    M: Mechanism,
    F: Formulation<S>,
    S: Real,
    C: Coordinates<M>,
    A: AppliedForces<S, M>,
{
}

/// The state that a solution moves, in the coordinates of the problem.
pub type State<P> = <<P as Posed>::Coordinates as Coordinates<<P as Posed>::Mechanism>>::State<
    <P as Posed>::Number,
>;

/// The state of the bodies, which everything is read of.
pub type Bodies<P> = StateOf<<P as Posed>::Mechanism, <P as Posed>::Number>;

/// The problem in other coordinates.
pub type WithCoordinates<P, C> = Problem<
    <P as Posed>::Mechanism,
    <P as Posed>::Formulation,
    <P as Posed>::Number,
    C,
    <P as Posed>::Forces,
>;

/// The problem with other forces.
pub type WithForces<P, A> = Problem<
    <P as Posed>::Mechanism,
    <P as Posed>::Formulation,
    <P as Posed>::Number,
    <P as Posed>::Coordinates,
    A,
>;

/// The problem with forces of a closure `G`.
pub type WithLaw<P, G> = WithForces<
    P,
    <<P as Posed>::Forces as AppliedForces<<P as Posed>::Number, <P as Posed>::Mechanism>>::With<
        ForceLaw<G>,
    >,
>;

/// The problem with `N` interactions, the limits of the description among them.
pub type WithInteractions<P, const N: usize> = WithForces<
    P,
    Interacting<<P as Posed>::Number, <P as Posed>::Mechanism, <P as Posed>::Forces, N>,
>;

/// The problem with a function `G` that scales the capacity of one interaction.
pub type WithCapacityFactor<P, G> =
    WithForces<P, ScaledCapacity<<P as Posed>::Mechanism, <P as Posed>::Forces, G>>;

/// The problem with its forces under way, which have the limits of the description and the
/// statuses of all interactions: what a step solves.
pub type UnderWay<P> = Carrying<P, <P as Posed>::Forces>;

/// The same with other forces.
pub(crate) type Carrying<P, A> =
    WithForces<P, Heeding<<P as Posed>::Number, <P as Posed>::Mechanism, A>>;

mod private {
    pub trait Sealed {}

    impl<M: crate::Mechanism, F, S, C, A> Sealed for super::Problem<M, F, S, C, A> {}
}
