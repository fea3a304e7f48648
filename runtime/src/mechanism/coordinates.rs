//! The coordinates in which the equations of motion of a mechanism are solved.
//!
//! [`Coordinates`] has two implementations: [`Absolute`] (`absolute.rs`) by the kernels of
//! [`Mechanism`], [`Relative`] (`relative.rs`) by those of
//! [`JointCoordinates`](crate::JointCoordinates). Everything that solves, steps or runs is written
//! once, over this trait.

use core::fmt::Debug;
use core::marker::PhantomData;

use crate::error::StepFault;
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::kernels::{Mechanism, Normalised, Orientation, Pivot, Stabilisation, Terms};
use crate::state::sealed::Sealed;
use crate::state::sums::sum_of_sizes_in_both;
use crate::state::vector::{Array, MovingState, Vector};

/// Absolute (Cartesian) coordinates: position and Euler parameters of every body, one multiplier
/// for every equation of the joints.
#[derive(Clone, Copy, Debug, Default)]
pub struct Absolute<P = Normalised>(PhantomData<P>);

/// Relative (joint) coordinates: bodies of a spanning tree move as their joints let them, and only
/// joints that close loops keep equations and multipliers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Relative;

/// What depends on parameters, on the formulation, and the compliance of every row.
#[derive(Clone, Copy, Debug)]
pub struct Equations<K, O, L> {
    /// What depends on parameters alone.
    pub(crate) constants: K,
    /// What depends on constants and on the coefficients of the formulation.
    pub(crate) coefficients: O,
    /// The compliance of every row; zeros for a formulation without.
    pub(crate) compliances: L,
}

/// The equations of a mechanism in some coordinates.
pub(crate) type EquationsIn<S, M, C> = Equations<
    <C as Coordinates<M>>::Constants<S>,
    <C as Coordinates<M>>::Coefficients<S>,
    <C as Coordinates<M>>::Multipliers<S>,
>;

/// The equations of a mechanism in absolute coordinates, however Euler parameters are read.
pub(crate) type AbsoluteEquations<S, M> = Equations<
    <M as Mechanism>::Constants<S>,
    <M as Mechanism>::Coefficients<S>,
    <M as Mechanism>::Multipliers<S>,
>;

/// Coordinates of a mechanism, with the kernels of its equations of motion:
///
/// ```text
/// [ M   D^T ] [ u'     ]   [ upper ]
/// [ D   -E  ] [ lambda ] = [ lower ]
/// ```
///
/// It is implemented by [`Absolute`] and [`Relative`], and by nothing else: what a program may do
/// with it is in [`Dynamics`](crate::dynamics::Dynamics).
pub trait Coordinates<M: Mechanism>: Copy + Debug + Sealed + 'static {
    /// Coordinates and velocities. The rates of a state have the same type.
    type State<S: Scalar>: MovingState<S>;
    /// One number per velocity.
    type Velocities<S: Scalar>: Array<S>;
    /// One number per equation that is solved.
    type Multipliers<S: Scalar>: Array<S>;
    /// What depends on parameters alone.
    type Constants<S: Scalar>: Array<S>;
    /// What depends on constants and on the coefficients of the formulation.
    type Coefficients<S: Scalar>: Array<S>;
    /// The factorised saddle system.
    type Factors<S: Scalar>: Copy + Debug;
    /// Their equations, where these are others than those in absolute coordinates.
    #[doc(hidden)]
    type Own<S: Scalar>: Copy;
    /// How the rates of Euler parameters are read.
    #[doc(hidden)]
    type Orientation: Orientation;

    /// Whether joints of a tree hold by themselves, so that bodies follow from the state.
    const IS_RELATIVE: bool;
    /// Whether pivots are recorded.
    #[doc(hidden)]
    const HAS_PIVOTS: bool;
    /// Whether these go with the distance from where one vanishes, and not with its square.
    #[doc(hidden)]
    const HAS_LINEAR_PIVOTS: bool;

    /// The equations, of those in absolute coordinates and their own.
    #[doc(hidden)]
    fn equations<'e, S: Scalar>(
        absolute: &'e AbsoluteEquations<S, M>,
        own: &'e Self::Own<S>,
    ) -> &'e EquationsIn<S, M, Self>;

    /// Prepares their own equations.
    #[doc(hidden)]
    fn own<S: Scalar>(
        parameters: &M::Parameters<S>,
        stabilisation: &Stabilisation<S>,
        absolute: &AbsoluteEquations<S, M>,
    ) -> Self::Own<S>;

    /// Computes again what depends on inputs, and leaves what does not.
    #[doc(hidden)]
    fn take_inputs<S: Scalar>(parameters: &M::Parameters<S>, own: &mut Self::Own<S>);

    /// Writes the Jacobian of the rates by a kernel of its own; whether there is one.
    #[doc(hidden)]
    fn differentiated<S: Real, T: Terms>(
        _constants: &Self::Constants<S>,
        _coefficients: &Self::Coefficients<S>,
        _time: S,
        _state: &Self::State<S>,
        _columns: &mut <Self::State<S> as Vector<S>>::Each<Self::State<S>>,
    ) -> bool {
        false
    }

    /// The whole right-hand side in one straight line: rates of the state and multipliers, without
    /// forces of a closure and with no multipliers before.
    fn evaluate_into<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &Self::State<S>,
        rates: &mut Self::State<S>,
        multipliers: &mut Self::Multipliers<S>,
    ) -> Pivot<S>;

    /// The same for a step: multipliers may stay as they are where they cost more.
    #[inline(always)]
    fn rates_into<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &Self::State<S>,
        rates: &mut Self::State<S>,
        multipliers: &mut Self::Multipliers<S>,
    ) -> Pivot<S> {
        Self::evaluate_into::<S, T>(constants, coefficients, time, state, rates, multipliers)
    }

    /// Factorises the system and solves it once, with forces and moments on bodies that a `law`
    /// adds to those of the description; calls with that, so that nothing large is handed back.
    /// Leaves in `rates` what [`Coordinates::finish`] needs.
    #[doc(hidden)]
    fn begin<S: Scalar, T: Terms, R>(
        prepared: Prepared<'_, S, M, Self>,
        time: S,
        state: &Self::State<S>,
        rates: &mut Self::State<S>,
        law: Option<impl FnOnce(&Self::State<S>, &mut M::Velocities<S>)>,
        then: impl FnOnce(&First<'_, S, M, Self>, &mut Self::State<S>) -> R,
    ) -> R;

    /// The state as kernels read it, of the state and of what [`Coordinates::begin`] left.
    #[doc(hidden)]
    fn as_read<'s, S: Scalar>(
        state: &'s Self::State<S>,
        rates: &'s Self::State<S>,
    ) -> &'s Self::State<S>;

    /// The solution after multipliers `lambda` that yielded `E lambda`.
    #[doc(hidden)]
    fn solve_after<S: Scalar, T: Terms>(
        prepared: (&Self::Constants<S>, &Self::Coefficients<S>),
        factors: &Self::Factors<S>,
        right: RightSide<'_, S, M, Self>,
        yielded: &Self::Multipliers<S>,
    ) -> (Self::Velocities<S>, Self::Multipliers<S>);

    /// Calls with the solution for forces and moments on the bodies alone, and with what solutions
    /// with multipliers before start from.
    #[doc(hidden)]
    fn solve_loads<S: Scalar, T: Terms, R>(
        prepared: (&Self::Constants<S>, &Self::Coefficients<S>),
        factors: &Self::Factors<S>,
        loads: &M::Velocities<S>,
        then: impl FnOnce(RightSide<'_, S, M, Self>, (Self::Velocities<S>, Self::Multipliers<S>)) -> R,
    ) -> R;

    /// Completes the rates of a state by accelerations.
    #[doc(hidden)]
    fn finish<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
        rates: &mut Self::State<S>,
        accelerations: &Self::Velocities<S>,
    );

    /// The rates of coordinates at other velocities, along a way that is no motion in time: the
    /// user's own states stay what they are. The rates of velocities are zero.
    #[doc(hidden)]
    fn way<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
        velocities: &Self::Velocities<S>,
    ) -> Self::State<S>;

    /// Replaces the rates of coordinates by those at the velocities `u + step u'`.
    #[doc(hidden)]
    fn with_new_velocities<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
        step: S,
        rates: &mut Self::State<S>,
    );

    /// Scales Euler parameters to length 1, and their rates with them, and rewraps turns. Returns
    /// by how much a length was off, where there are any.
    #[doc(hidden)]
    fn normalise<S: Real>(
        absolute: &AbsoluteEquations<S, M>,
        constants: &Self::Constants<S>,
        state: &mut Self::State<S>,
        rates: Option<&mut Self::State<S>>,
    ) -> Option<S>;

    /// The same of numbers that cannot be compared. Whether it could: where a length is not near 1
    /// or turns are counted, the state stays as it is.
    #[doc(hidden)]
    fn normalise_near<S: Scalar>(state: &mut Self::State<S>) -> bool;

    /// Calls with the bodies of a state, with Euler parameters as kernels read them.
    #[doc(hidden)]
    fn with_bodies<S: Real, R>(
        constants: &Self::Constants<S>,
        state: &Self::State<S>,
        then: impl FnOnce(&M::State<S>) -> R,
    ) -> R;

    /// A sum of speeds (rad/s) in two states, which that of the angle of no joint exceeds.
    #[doc(hidden)]
    #[inline(always)]
    fn turning<S: Scalar>(from: &Self::State<S>, to: &Self::State<S>) -> S {
        sum_of_sizes_in_both(from.rates_slice(), to.rates_slice())
    }

    /// How the bodies stand and move.
    fn bodies<S: Real>(constants: &Self::Constants<S>, state: &Self::State<S>) -> M::State<S>;

    /// The same, with those signs of Euler parameters that are nearer to those of a moment ago.
    #[doc(hidden)]
    fn bodies_near<S: Real>(
        constants: &Self::Constants<S>,
        state: &Self::State<S>,
        near: &M::State<S>,
    ) -> M::State<S>;

    /// The state in which bodies stand and move so, or nearly so.
    fn of_bodies<S: Real>(constants: &Self::Constants<S>, bodies: &M::State<S>) -> Self::State<S>;

    /// The same, with those signs of Euler parameters that are nearer to those of another state: a
    /// method that looks back at former steps does not know that both are one orientation.
    #[doc(hidden)]
    fn of_bodies_near<S: Real>(
        constants: &Self::Constants<S>,
        bodies: &M::State<S>,
        near: &Self::State<S>,
    ) -> Self::State<S>;

    /// Refuses a state that is not finite, or has Euler parameters that are zero.
    ///
    /// # Errors
    /// What is wrong with it.
    fn check<S: Real>(state: &Self::State<S>) -> Result<(), StepFault>;

    /// The body whose velocity stands at a place.
    fn body_of_velocity(place: usize) -> Option<&'static str>;

    /// The joint of a row.
    fn joint_of_row(row: usize) -> Option<&'static str>;

    /// The row of `Phi` that a row of the solution is; `None` where the equations in absolute
    /// coordinates leave it out.
    #[doc(hidden)]
    fn row_of_all(row: usize) -> Option<usize>;

    /// Whether a joint keeps equations, or holds by itself.
    #[doc(hidden)]
    fn keeps_equations(joint: &str) -> bool;

    /// A solution by the rows of all joints, in coordinates that have these.
    #[doc(hidden)]
    fn by_all_rows<'s, S: Scalar>(
        _constants: &'s Self::Constants<S>,
        _state: &'s Self::State<S>,
        _right: RightSide<'s, S, M, Self>,
        _accelerations: &'s Self::Velocities<S>,
        _multipliers: &'s Self::Multipliers<S>,
    ) -> Option<ByAllRows<'s, S, M>> {
        None
    }
}

/// What is known before a state.
#[doc(hidden)]
pub struct Prepared<'e, S: Scalar, M: Mechanism, C: Coordinates<M>> {
    pub(crate) constants: &'e C::Constants<S>,
    pub(crate) coefficients: &'e C::Coefficients<S>,
    /// Of `Phi'` and of `Phi` in the right-hand sides of the constraints.
    pub(crate) gains: [S; 2],
}

/// What solutions with multipliers before start from, one number for each velocity and for each
/// equation.
#[doc(hidden)]
pub type RightSide<'r, S, M, C> = (
    &'r <C as Coordinates<M>>::Velocities<S>,
    &'r <C as Coordinates<M>>::Multipliers<S>,
);

/// A first solution from parts.
#[doc(hidden)]
pub struct First<'a, S: Scalar, M: Mechanism, C: Coordinates<M>> {
    pub(crate) factors: &'a C::Factors<S>,
    pub(crate) right: RightSide<'a, S, M, C>,
    pub(crate) pivot: Pivot<S>,
    pub(crate) accelerations: &'a C::Velocities<S>,
    pub(crate) multipliers: &'a C::Multipliers<S>,
}

/// A solution by the rows of all joints, and what it solves.
#[doc(hidden)]
pub struct ByAllRows<'s, S: Scalar, M: Mechanism> {
    pub(crate) constants: &'s M::Constants<S>,
    pub(crate) state: &'s M::State<S>,
    pub(crate) upper: &'s M::Velocities<S>,
    pub(crate) lower: &'s M::Multipliers<S>,
    pub(crate) accelerations: &'s M::Velocities<S>,
    pub(crate) multipliers: &'s M::Multipliers<S>,
}

/// Rates of the state, multipliers and the verdict on the pivots.
#[non_exhaustive]
pub struct Evaluation<S: Scalar, M: Mechanism, C: Coordinates<M> = Absolute> {
    /// `(q', u')`.
    pub rates: C::State<S>,
    /// `lambda`, one per equation that is solved; in absolute coordinates the reaction on the
    /// bodies is `-D^T lambda`.
    pub multipliers: C::Multipliers<S>,
    /// The smallest relative pivot.
    pub pivot: Pivot<S>,
}

impl<S: Scalar, M: Mechanism, C: Coordinates<M>> Evaluation<S, M, C> {
    /// A place for results, see
    /// [`Dynamics::evaluate_into`](crate::dynamics::Dynamics::evaluate_into).
    #[inline(always)]
    #[must_use]
    pub fn zeros() -> Self {
        Self {
            rates: C::State::zeros(),
            multipliers: Array::zeros(),
            pivot: Pivot::unchecked(),
        }
    }
}

copied!([S: Scalar, M: Mechanism, C: Coordinates<M>] Evaluation<S, M, C>);

impl<S: Scalar, M: Mechanism, C: Coordinates<M>> Debug for Evaluation<S, M, C> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Evaluation")
            .field("rates", &self.rates)
            .field("multipliers", &self.multipliers)
            .field("pivot", &self.pivot)
            .finish()
    }
}
