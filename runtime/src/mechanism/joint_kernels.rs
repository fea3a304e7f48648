//! Mechanisms that are described by their joints as well as by their bodies.

use core::fmt::Debug;

use crate::math::scalar::Scalar;
use crate::mechanism::kernels::{Mechanism, Pivot, Stabilisation, Terms};
use crate::mechanism::report::{Kernel, StateInfo};
use crate::state::joint_state::JointState;
use crate::state::sealed::Sealed;
use crate::state::vector::{Array, MovingState};

/// A mechanism with `#[mechanism(coordinates = "joints")]` or `"both"`: besides the kernels of
/// [`Mechanism`] it has those of its equations of motion in joint coordinates.
///
/// Bodies of a spanning tree move by what their joints leave free; only joints that close loops,
/// and those that do not say how they move, keep equations and multipliers:
///
/// ```text
/// [ M(q)  D^T ] [ u'     ]   [ forces along the velocities, less what the motion takes ]
/// [ D     -E  ] [ lambda ] = [ gamma*                                                  ]
/// ```
///
/// The four formulations mean what they mean for bodies, for the equations that remain.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not described by joint coordinates",
    label = "no joint coordinates here",
    note = "write `#[mechanism(coordinates = \"joints\")]` above the struct"
)]
pub trait JointCoordinates: Mechanism {
    /// The state: a pair of cosine and sine for every turn, displacements, Euler parameters and
    /// auxiliary variables, and the velocities.
    type JointState<S: Scalar>: JointParts<S>;
    /// One number per equation that remains.
    type ClosingMultipliers<S: Scalar>: Array<S>;
    /// What depends on parameters alone.
    type JointConstants<S: Scalar>: Array<S>;
    /// What depends on constants and on the coefficients of the formulation.
    type JointCoefficients<S: Scalar>: Array<S>;
    /// Body by body position and velocity (global), and of a rigid one the rotation matrix from
    /// principal to global axes, row by row, and the angular velocity in principal axes; behind
    /// them the auxiliary variables.
    type BodyMotions<S: Scalar>: Array<S>;

    /// What [`JointCoordinates::solve_joints`] takes from a state.
    type JointFactors<S: Scalar>: Copy + Debug;
    /// One number per velocity.
    type JointVelocities<S: Scalar>: Array<S>;

    /// What [`JointCoordinates::derivatives`] gives.
    type Derivatives<S: Scalar>: Array<S>;
    /// What [`JointCoordinates::motions_along`] gives.
    type MotionsAlong<S: Scalar>: Array<S>;
    /// What [`JointCoordinates::adjoint`] gives.
    type Adjoint<S: Scalar>: Array<S>;
    /// What it takes.
    type AdjointWeights<S: Scalar>: Array<S>;

    /// What the coordinates are, and what an evaluation costs.
    const JOINT_REPORT: JointReport;

    /// Computes once what depends on parameters only.
    fn prepare_joints<S: Scalar>(parameters: &Self::Parameters<S>) -> Self::JointConstants<S>;

    /// Computes again what depends on inputs, and leaves what does not.
    fn take_joint_inputs<S: Scalar>(
        parameters: &Self::Parameters<S>,
        constants: &mut Self::JointConstants<S>,
    );

    /// Computes once what depends on the coefficients of a formulation, with a compliance for each
    /// equation that remains.
    fn joint_coefficients<S: Scalar>(
        constants: &Self::JointConstants<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &Self::ClosingMultipliers<S>,
    ) -> Self::JointCoefficients<S>;

    /// The whole right-hand side in one straight line: the slope of the state, and the multipliers
    /// of the equations that remain. Writes every element of both; returns the smallest relative
    /// pivot.
    fn evaluate_joints_into<S: Scalar, T: Terms>(
        constants: &Self::JointConstants<S>,
        coefficients: &Self::JointCoefficients<S>,
        time: S,
        state: &Self::JointState<S>,
        rates: &mut Self::JointState<S>,
        multipliers: &mut Self::ClosingMultipliers<S>,
    ) -> Pivot<S>;

    /// The slope of the state alone, with the same pivot: what only the multipliers need is not
    /// computed.
    #[inline(always)]
    fn joint_rates_into<S: Scalar, T: Terms>(
        constants: &Self::JointConstants<S>,
        coefficients: &Self::JointCoefficients<S>,
        time: S,
        state: &Self::JointState<S>,
        rates: &mut Self::JointState<S>,
    ) -> Pivot<S> {
        let multipliers = &mut Array::zeros();
        Self::evaluate_joints_into::<S, T>(constants, coefficients, time, state, rates, multipliers)
    }

    /// With `kernels = [derivatives]`, the values by which there are derivatives, by their places
    /// in [`Report::values`](crate::Report::values): all inputs, and of `derivatives(length)` the
    /// parameters that are named.
    const DERIVED_BY: Option<&'static [usize]> = None;

    /// The accelerations of the rates of the joints and the rates of the user's own states, and
    /// behind them the columns of their derivatives. Columns are by the position of each joint, by
    /// each rate, by each of those states, by an effort along each rate, and by the values of
    /// [`JointCoordinates::DERIVED_BY`], all else held. There is no number where that is `None`.
    ///
    /// Where equations close loops, a column for each position follows, the rates that take away
    /// what it adds to `Phi'`. Then for each value a displacement that takes away what it adds to
    /// `Phi`, and then one of rates for `Phi'`. Last come relative pivots.
    fn derivatives<S: Scalar>(
        _constants: &Self::JointConstants<S>,
        _time: S,
        _state: &Self::JointState<S>,
    ) -> Self::Derivatives<S> {
        Array::zeros()
    }

    /// With [`JointCoordinates::derivatives`], what the velocities of the bodies change by, in the
    /// order and the axes of [`Mechanism::Velocities`]: along each rate, and then along the
    /// position of each joint. Along a rate they are also how its position displaces the bodies.
    /// Behind them stands what auxiliary variables change by along each position.
    fn motions_along<S: Scalar>(
        _constants: &Self::JointConstants<S>,
        _time: S,
        _state: &Self::JointState<S>,
    ) -> Self::MotionsAlong<S> {
        Array::zeros()
    }

    /// Whether there is [`JointCoordinates::forward_dynamics`]: in a tree with
    /// `kernels = [forward]`.
    const HAS_FORWARD: bool = false;

    /// The accelerations of the joints' rates under these efforts along them and the described
    /// forces. Zeros where [`JointCoordinates::HAS_FORWARD`] says that they are not there.
    fn forward_dynamics<S: Scalar>(
        _constants: &Self::JointConstants<S>,
        _time: S,
        _state: &Self::JointState<S>,
        _efforts: &Self::JointVelocities<S>,
    ) -> Self::JointVelocities<S> {
        Array::zeros()
    }

    /// With `kernels = [adjoint]` the inputs by which there are slopes, by their places in
    /// [`Report::values`](crate::Report::values). `None` where an equation that closes a loop has a
    /// spline, or where [`JointReport::rewraps`] says that angles are put right after a step.
    const ADJOINT_BY: Option<&'static [usize]> = None;

    /// What a weighted sum of the accelerations of the joints' rates and of the rates of the user's
    /// own states changes by: with the position of each joint, with each rate, with each of these
    /// states, and with the inputs of [`JointCoordinates::ADJOINT_BY`]. There is no number where
    /// that is `None`.
    ///
    /// Where equations close loops, it is that of terms without a compliance.
    fn adjoint<S: Scalar, T: Terms>(
        _constants: &Self::JointConstants<S>,
        _coefficients: &Self::JointCoefficients<S>,
        _time: S,
        _state: &Self::JointState<S>,
        _weights: &Self::AdjointWeights<S>,
    ) -> Self::Adjoint<S> {
        Array::zeros()
    }

    /// Factorises the matrix of the equations of motion; with compliance where `T::COMPLIANT`. Its
    /// pivots are those of the evaluation of the same `T`.
    fn factor_joints<S: Scalar, T: Terms>(
        constants: &Self::JointConstants<S>,
        coefficients: &Self::JointCoefficients<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> Self::JointFactors<S>;

    /// Solves the equations of motion for forces and moments on the bodies alone (N, global, at the
    /// centre of mass; N m, principal body axes; as [`Mechanism::forces`]), with factors of the
    /// same `T`:
    ///
    /// ```text
    /// [ M(q)  D^T ] [ u'     ]   [ upper, along the velocities ]
    /// [ D     -E  ] [ lambda ] = [ lower                       ]
    /// ```
    ///
    /// To be added to what an evaluation gives: the equations are linear in their right-hand sides.
    fn solve_joints<S: Scalar, T: Terms>(
        constants: &Self::JointConstants<S>,
        coefficients: &Self::JointCoefficients<S>,
        factors: &Self::JointFactors<S>,
        upper: &Self::Velocities<S>,
        lower: &Self::ClosingMultipliers<S>,
    ) -> (Self::JointVelocities<S>, Self::ClosingMultipliers<S>);

    /// The rates of the coordinates at the velocities of a state; those of the velocities are zero.
    fn joint_coordinate_rates<S: Scalar>(
        constants: &Self::JointConstants<S>,
        time: S,
        state: &Self::JointState<S>,
    ) -> Self::JointState<S>;

    /// How the bodies stand and move.
    fn body_motions<S: Scalar>(
        constants: &Self::JointConstants<S>,
        state: &Self::JointState<S>,
    ) -> Self::BodyMotions<S>;

    /// The joint coordinates of bodies that stand and move as the joints of the tree let them; of
    /// others, those of the nearest such motion.
    fn joint_state<S: Scalar>(
        constants: &Self::JointConstants<S>,
        state: &Self::State<S>,
    ) -> Self::JointState<S>;
}

/// Access to the parts of a [`JointState`], for code that is generic over the mechanism.
pub trait JointParts<S: Scalar>: MovingState<S> {
    /// Cosine and sine of every turn; of a slope, the rate of the angle first.
    fn pairs_slice(&self) -> &[[S; 2]];

    /// The further coordinates.
    fn rest_slice(&self) -> &[S];

    /// The further coordinates, to be written.
    fn rest_slice_mut(&mut self) -> &mut [S];
}

impl<S, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize> Sealed
    for JointState<S, TURNS, REST, RATES, A>
{
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize>
    MovingState<S> for JointState<S, TURNS, REST, RATES, A>
{
    #[inline(always)]
    fn zeros() -> Self {
        Self::of_parts(
            [[S::zero(); 2]; TURNS],
            [S::zero(); REST],
            [S::zero(); RATES],
        )
    }

    #[inline(always)]
    fn rates_slice(&self) -> &[S] {
        self.rates()
    }

    #[inline(always)]
    fn rates_slice_mut(&mut self) -> &mut [S] {
        self.rates_mut()
    }
}

impl<S: Scalar, const TURNS: usize, const REST: usize, const RATES: usize, const A: usize>
    JointParts<S> for JointState<S, TURNS, REST, RATES, A>
{
    #[inline(always)]
    fn pairs_slice(&self) -> &[[S; 2]] {
        self.pairs()
    }

    #[inline(always)]
    fn rest_slice(&self) -> &[S] {
        self.rest()
    }

    #[inline(always)]
    fn rest_slice_mut(&mut self) -> &mut [S] {
        self.rest_mut()
    }
}

/// What the coordinates of a mechanism's joints are.
///
/// The macro writes it, and a program only reads it: it, and what it has, may gain fields.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointReport {
    /// The motions in the order of the velocities; a ball has three of these.
    pub motions: &'static [JointMotion],
    /// The joint of each equation that remains.
    pub closing: &'static [&'static str],
    /// The row of `Phi` that each of them is; `None` where the equations of the bodies leave it
    /// out.
    pub rows: &'static [Option<usize>],
    /// What the evaluations cost, and `rates ..` without the multipliers, which is what a step
    /// takes; one alone where no equation remains.
    pub kernels: &'static [Kernel],
    /// What the kernels cost that were asked for by `kernels = [..]`, by their words.
    pub asked: &'static [Kernel],
    /// The places of Euler parameters among the further coordinates.
    pub euler_parameters: &'static [usize],
    /// What the auxiliary variables count, one after the other.
    pub counters: &'static [JointCounter],
    /// How many of the further coordinates are auxiliary variables; they are the last but for the
    /// user's own states.
    pub auxiliaries: usize,
    /// The user's own states, which are the last of the further coordinates.
    pub states: &'static [StateInfo],
    /// Whether some of these count angles that are no sums of the turns of joints, so that they are
    /// put right after every step.
    pub rewraps: bool,
    /// Whether every equation determines a velocity: then pivots go with the distance from where
    /// one vanishes, and not with its square.
    pub determines: bool,
}

/// One motion of a joint that carries a body.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointMotion {
    /// The joint; empty for a body that no joint carries, which moves freely.
    pub joint: &'static str,
    /// The body that it carries.
    pub body: &'static str,
    /// What it is.
    pub freedom: Freedom,
    /// The place of its first coordinate: of a turn or a screw among [`pairs`](JointState::pairs),
    /// of others among [`rest`](JointState::rest).
    pub coordinate: usize,
    /// The place of its first velocity among [`rates`](JointState::rates).
    pub velocity: usize,
    /// The motion whose angle and rate are to be taken off, because both are measured against what
    /// carries a run of parallel axes: those of this motion are sums along the run.
    pub against: Option<usize>,
    /// The angle (rad) in the reference configuration, where that of the joint is zero. Zero of a
    /// slide and of a ball.
    pub zero: f64,
}

/// An auxiliary variable of a state: an angle that counts turns (rad).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct JointCounter {
    /// The field of the joint or force that counts it.
    pub element: &'static str,
    /// Its place among [`rest`](JointState::rest).
    pub coordinate: usize,
}

/// What a motion is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Freedom {
    /// An angle: a pair of cosine and sine, and a rate (rad/s). In a run of parallel axes, both may
    /// be measured against what carries the run ([`JointMotion::against`]); and the angle need not
    /// be zero in the reference configuration ([`JointMotion::zero`]).
    Turn {
        /// Whether it counts against the joint's own angle.
        is_reversed: bool,
    },
    /// A displacement (m) and its rate (m/s).
    Slide,
    /// As a turn, with a displacement in proportion to the angle over any number of turns.
    Screw {
        /// Whether it counts against the joint's own angle.
        is_reversed: bool,
        /// The place among [`rest`](JointState::rest) of the joint's own angle over any number of
        /// turns (rad): one of the [`counters`](JointReport::counters).
        counter: usize,
    },
    /// Euler parameters from principal to global axes, and an angular velocity (rad/s) in principal
    /// axes.
    Ball,
}
