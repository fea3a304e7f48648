//! What systems of this study offer to a method that is chosen at run time, beside their rates.
//!
//! A method of `holonom` says by its type what it needs, and a system by its type what it has: what
//! does not fit does not compile. Here both are values, so that a system answers whether it has
//! constraints to be solved for; [`Family::moves`](super::Family::moves) asks before a run.

use holonom::{
    AugmentedLagrangian, Baumgarte, Fault, Formulation, JointCoordinates, Mechanism, Penalty, Real,
    StandardLagrange,
    dynamics::{Dynamics, Problem},
    integrate::{AlphaEnd, AlphaStep, RigidConstraints as _, SecondOrder},
    measure::AppliedForces,
    mechanism::{Absolute, Coordinates, Orientation, Relative},
};

/// A step on rigid constraints, of a system that has them.
pub type OnConstraints<X> = Option<Result<AlphaEnd<X>, Fault>>;

/// A system that a method chosen at run time moves.
pub trait Movable<S: Real>: SecondOrder<S> {
    /// A step on rigid constraints, if it has them.
    fn on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, Self::State>,
    ) -> OnConstraints<Self::State>;
}

/// A formulation that says whether it has rigid constraints.
pub trait Studied<S: Real>: Formulation<S> {
    /// The step of a mechanism in absolute coordinates.
    fn on_constraints<M: Mechanism, A: AppliedForces<S, M>, P: Orientation>(
        dynamics: &mut Dynamics<Problem<M, Self, S, Absolute<P>, A>>,
        asked: AlphaStep<'_, S, M::State<S>>,
    ) -> OnConstraints<M::State<S>>;
}

impl<S: Real> Studied<S> for StandardLagrange {
    fn on_constraints<M: Mechanism, A: AppliedForces<S, M>, P: Orientation>(
        dynamics: &mut Dynamics<Problem<M, Self, S, Absolute<P>, A>>,
        asked: AlphaStep<'_, S, M::State<S>>,
    ) -> OnConstraints<M::State<S>> {
        Some(dynamics.step_on_constraints(asked))
    }
}

/// Formulations that let constraints yield.
macro_rules! yielding {
    ($($formulation:ident),*) => {$(
        impl<S: Real> Studied<S> for $formulation<S> {
            fn on_constraints<M: Mechanism, A: AppliedForces<S, M>, P: Orientation>(
                _dynamics: &mut Dynamics<Problem<M, Self, S, Absolute<P>, A>>,
                _asked: AlphaStep<'_, S, M::State<S>>,
            ) -> OnConstraints<M::State<S>> {
                None
            }
        }
    )*};
}

yielding!(Baumgarte, Penalty, AugmentedLagrangian);

/// Coordinates that say whether a mechanism has constraints in them.
pub trait Described<M: Mechanism>: Coordinates<M> {
    /// The step of a mechanism by some formulation.
    fn on_constraints<S: Real, F: Studied<S>, A: AppliedForces<S, M>>(
        dynamics: &mut Dynamics<Problem<M, F, S, Self, A>>,
        asked: AlphaStep<'_, S, Self::State<S>>,
    ) -> OnConstraints<Self::State<S>>;
}

impl<M: Mechanism, P: Orientation> Described<M> for Absolute<P> {
    fn on_constraints<S: Real, F: Studied<S>, A: AppliedForces<S, M>>(
        dynamics: &mut Dynamics<Problem<M, F, S, Self, A>>,
        asked: AlphaStep<'_, S, M::State<S>>,
    ) -> OnConstraints<M::State<S>> {
        F::on_constraints(dynamics, asked)
    }
}

impl<M: JointCoordinates> Described<M> for Relative {
    fn on_constraints<S: Real, F: Studied<S>, A: AppliedForces<S, M>>(
        _dynamics: &mut Dynamics<Problem<M, F, S, Self, A>>,
        _asked: AlphaStep<'_, S, M::JointState<S>>,
    ) -> OnConstraints<M::JointState<S>> {
        None
    }
}

impl<S, M, F, A, C> Movable<S> for Dynamics<Problem<M, F, S, C, A>>
where
    S: Real,
    M: Mechanism,
    F: Studied<S>,
    A: AppliedForces<S, M>,
    C: Described<M>,
{
    fn on_constraints(
        &mut self,
        asked: AlphaStep<'_, S, C::State<S>>,
    ) -> OnConstraints<C::State<S>> {
        C::on_constraints(self, asked)
    }
}
