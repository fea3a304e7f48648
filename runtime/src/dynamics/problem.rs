//! What is solved, as one type.

use core::marker::PhantomData;

use crate::formulation::Formulation;
use crate::math::scalar::Real;
use crate::measure::load::{AppliedForces, NoForces};
use crate::mechanism::coordinates::Coordinates;
use crate::mechanism::kernels::Mechanism;

/// A mechanism `M` over numbers `S`, with a formulation `F`, forces `A` beside those of its
/// description, and coordinates `C`.
///
/// It is never a value. It stands in the type of what solves it, such as
/// [`Simulation`](crate::Simulation), where a struct of yours has to name that:
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
/// use holonom::dynamics::Problem;
/// use holonom::integrate::FixedStep;
///
/// struct Experiment<'a> {
///     run: Simulation<'a, Problem<f64, Rod, StandardLagrange>, FixedStep<f64, Rk4>>,
/// }
///
/// let rod = Rod::default();
/// let experiment = Experiment { run: rod.simulation(StandardLagrange, Rk4::every(1e-3)) };
/// experiment.run.run(0.0..=1.0, every(0.1), |_| ())?;
/// # Ok::<(), SimulationError<StateOf<Rod>>>(())
/// ```
pub struct Problem<S, M: Mechanism, F, A = NoForces, C = <M as Mechanism>::Coordinates>(
    PhantomData<Parts<S, M, F, A, C>>,
);

/// It has none of them.
type Parts<S, M, F, A, C> = fn() -> (S, M, F, A, C);

impl<S, M: Mechanism, F, A, C> core::fmt::Debug for Problem<S, M, F, A, C> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_tuple("Problem").field(&M::REPORT.name).finish()
    }
}

/// What a [`Problem`] is made of. Nothing else implements it.
pub trait Posed: private::Sealed {
    /// The number type.
    type Number: Real;
    /// The mechanism.
    type Mechanism: Mechanism;
    /// The formulation.
    type Formulation;
    /// Forces beside those of the description.
    type Forces;
    /// The coordinates in which the equations of motion are solved.
    type Coordinates;
}

impl<S: Real, M: Mechanism, F, A, C> Posed for Problem<S, M, F, A, C> {
    type Number = S;
    type Mechanism = M;
    type Formulation = F;
    type Forces = A;
    type Coordinates = C;
}

/// A [`Problem`] whose parts go together: what can be solved. Nothing else implements it.
pub trait Solvable:
    Posed<
        Formulation: Formulation<<Self as Posed>::Number>,
        Forces: AppliedForces<<Self as Posed>::Number, <Self as Posed>::Mechanism>,
        Coordinates: Coordinates<<Self as Posed>::Mechanism>,
    >
{
}

impl<S, M, F, A, C> Solvable for Problem<S, M, F, A, C>
where
    S: Real,
    M: Mechanism,
    F: Formulation<S>,
    A: AppliedForces<S, M>,
    C: Coordinates<M>,
{
}

mod private {
    pub trait Sealed {}

    impl<S, M: crate::Mechanism, F, A, C> Sealed for super::Problem<S, M, F, A, C> {}
}
