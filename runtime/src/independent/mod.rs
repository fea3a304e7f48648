//! The equations of motion in coordinates that are chosen by handle: as many joints as there are
//! degrees of freedom, and everything else follows.
//!
//! - `choice.rs`: what can be chosen.
//! - `determined.rs`: whether a state is one to compute by.
//! - `partition.rs`: the other rates, from the equations that close loops (coordinate partitioning,
//!   Wehage and Haug 1982).
//! - `equations.rs`: mass matrix and efforts. `points.rs`, `momentum.rs`: Jacobians. `states.rs`:
//!   the way to states and back; `followed.rs`: the same near a singular configuration.
//! - `derived.rs`: accelerations with their derivatives by a kernel of their own.
//! - `directions.rs`: derivatives along coordinates, rates and values; `whole.rs`: along those of
//!   all joints, chosen or not.
//! - `elimination.rs`: Gauss-Jordan, for these equations and for Newton's method.
//! - `linear.rs`, `linearised.rs`: linearisation and its result; `modes.rs`: natural motions,
//!   over `spectrum.rs` and `jacobi.rs`;
//!   `lqr.rs`: the gain of a regulator.
//! - `nonholonomic.rs`: more coordinates than rates, where joints roll.
//! - `equilibrium.rs`: states without accelerations, over `balance.rs`; `trim.rs`: with inputs and
//!   parameters as unknowns (`varied.rs`). `switched.rs`: states on the switch of a law.
//! - `continuation.rs`: equilibria along a parameter; `walk.rs`: points and steps, `folds.rs`:
//!   folds and branchings, `stability.rs`: eigenvalues of the stiffness.
//! - `regressor.rs`: inverse dynamics by inertial parameters. `identification.rs`: these from
//!   measured efforts; `base_parameters.rs`: their combinations that efforts depend on.
//!
//! All of it is generic over [`Scalar`] where it can be, so that derivatives go through it.
//!
//! Chosen rates `z` give those of all joints: `w = B z + d`, with `D B = 0` and `D d = -dPhi/dt`.
//! Accelerations are `w' = B z' + b`, with `D b = gamma`. Efforts `f` of all joints do the work of
//! `B^T f` on `z` (Jourdain's principle).

mod balance;
#[cfg(feature = "std")]
mod base_parameters;
mod carrying;
mod choice;
mod continuation;
mod derived;
mod determined;
mod directions;
mod elimination;
mod equations;
mod equilibrium;
mod folds;
mod followed;
#[cfg(feature = "std")]
mod identification;
mod jacobi;
mod linear;
mod linearised;
mod lqr;
#[cfg(feature = "std")]
mod modes;
mod momentum;
mod nonholonomic;
mod partition;
mod places;
mod points;
mod readings;
mod regressor;
#[cfg(feature = "std")]
mod spectrum;
mod stability;
mod states;
mod switched;
mod trim;
mod varied;
mod walk;
#[cfg(feature = "std")]
mod whole;

use core::fmt;

#[cfg(feature = "std")]
pub use base_parameters::{BaseParameters, InertialParameter};
pub use choice::{Chosen, Coordinate, Motion};
pub use continuation::{BranchEnd, BranchPoint, Continuation, PointKind};
pub use directions::Direction;
pub(crate) use directions::vary;
#[cfg(feature = "std")]
pub(crate) use directions::{Along, StateAlong};
#[cfg(feature = "std")]
pub(crate) use equations::not_finite;
#[cfg(feature = "std")]
pub use identification::{Identification, Identified};
pub use linearised::{Linearised, to_discrete};
pub use lqr::discrete_lqr;
#[cfg(feature = "std")]
pub use modes::Mode;
pub use nonholonomic::{LinearMotion, NonholonomicCoordinates, NonholonomicExt};
pub use regressor::INERTIAL_PARAMETERS;
pub use varied::Varied;
#[cfg(feature = "std")]
pub(crate) use whole::{Whole, changes, rates_of_joints};

use self::places::Places;
use crate::error::{AssemblyFault, Fault, ParameterError};
use crate::math::scalar::{Real, Scalar};
use crate::math::without_bounds::copied;
use crate::mechanism::joint_rates::JointRates;
use crate::mechanism::kernels::Mechanism;
use crate::nonsmooth::described::check_limits;

/// The equations of motion of a mechanism in chosen coordinates, by
/// [`IndependentExt::coordinates`].
///
/// States are those of joint coordinates. Rates are read as [`View`](crate::View) reads them: rad/s
/// for an angle, m/s for a displacement, with the sign of the joint. Efforts are N m and N,
/// positive where they push the coordinate upwards.
///
/// In a mechanism with loops the coordinates that are not chosen follow. Where they do not, because
/// the chosen ones stand at a dead point, [`AnalysisFault::NotDetermined`] names a joint that can
/// still move. States have to satisfy the constraints.
///
/// What it holds is prepared once; [`IndependentCoordinates::set_inputs`] and
/// [`IndependentCoordinates::set_time`] change it without preparing again.
///
/// [`AnalysisFault::NotDetermined`]: crate::error::AnalysisFault::NotDetermined
pub struct IndependentCoordinates<M: JointRates, const N: usize, S: Scalar = f64> {
    pub(crate) parameters: M::Parameters<S>,
    /// In absolute coordinates.
    constants: M::Constants<S>,
    equations: Equations<M, N, S>,
    /// The described state of a tree, and the chosen coordinates there: whence states are set.
    described: Option<(M::JointState<S>, [S; N])>,
    /// Whether the limits of the description are left out.
    pub(crate) passes_limits: bool,
}

/// What the kernels take beside a state, in any scalar.
struct Equations<M: JointRates, const N: usize, S: Scalar> {
    constants: M::JointConstants<S>,
    places: Places<N>,
    time: S,
    /// A length of the mechanism (m), by which displacements compare with angles.
    length: S,
    /// The sizes of the rows that close loops, see `determined.rs`.
    sizes: M::ClosingMultipliers<S>,
    /// The largest part of the size of a row that its terms do not resolve.
    resolved: f64,
    /// Whether the chosen ones are coordinates, which equations of velocities leave free.
    leaves_velocities: bool,
}

/// Coordinates by handle, by a method of the mechanism.
pub trait IndependentExt: JointRates {
    /// The equations of motion in the coordinates of these joints, at time zero.
    ///
    /// A handle stands for the angle or the displacement of a joint with one motion;
    /// [`Motion::of`] chooses among several. Joints of one type stand in brackets, of different
    /// ones in a tuple: `arm.coordinates((h.slide, h.hinge))?`.
    ///
    /// ```
    /// use holonom::prelude::*;
    ///
    /// /// Two rods on hinges.
    /// #[derive(Mechanism)]
    /// #[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
    /// struct Arm {
    ///     #[body(mass = 3.0, inertia = [0.25, 0.25, 0.001], position = [0.0, 0.0, -0.5])]
    ///     upper: Body,
    ///     #[body(mass = 3.0, inertia = [0.25, 0.25, 0.001], position = [0.0, 0.0, -1.5])]
    ///     lower: Body,
    ///     #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    ///     shoulder: Revolute,
    ///     #[joint(between = [upper, lower], point = [0.0, 0.0, -1.0], axis = [1.0, 0.0, 0.0])]
    ///     elbow: Revolute,
    /// }
    ///
    /// let (arm, h) = (Arm::default(), Arm::HANDLES);
    /// let space = arm.coordinates([h.shoulder, h.elbow])?;
    /// let hanging = space.state([0.0, 0.0], [0.0, 0.0])?;
    /// let m = space.mass(&hanging)?;
    /// assert!((m[(0, 0)] - 8.0).abs() < 1e-14 && (m[(1, 1)] - 1.0).abs() < 1e-14);
    /// // The torques that hold it stretched out to the side.
    /// let aside = space.state([core::f64::consts::FRAC_PI_2, 0.0], [0.0, 0.0])?;
    /// let torques = space.inverse(&aside, [0.0, 0.0])?;
    /// assert!((torques[0] - 6.0 * 9.81).abs() < 1e-13);
    /// # Ok::<(), Fault>(())
    /// ```
    ///
    /// # Errors
    /// - [`AnalysisFault::ChosenCount`]: more or fewer than there are degrees of freedom.
    /// - [`AnalysisFault::SeveralMotions`]: a joint that has more than one.
    /// - [`AssemblyFault::CarriesNothing`]: a joint that closes a loop or drives.
    ///   [`AnalysisFault::Carried`]: a body that a joint carries.
    /// - [`AnalysisFault::ChosenTwice`]; a parameter that is not acceptable.
    ///
    /// [`AnalysisFault::ChosenCount`]: crate::error::AnalysisFault::ChosenCount
    /// [`AnalysisFault::SeveralMotions`]: crate::error::AnalysisFault::SeveralMotions
    /// [`AnalysisFault::Carried`]: crate::error::AnalysisFault::Carried
    /// [`AnalysisFault::ChosenTwice`]: crate::error::AnalysisFault::ChosenTwice
    fn coordinates<const N: usize>(
        &self,
        chosen: impl Chosen<Self, N>,
    ) -> Result<IndependentCoordinates<Self, N>, Fault> {
        self.coordinates_in(chosen)
    }

    /// [`IndependentExt::coordinates`] in numbers of another type:
    /// `arm.coordinates_in::<f32, 2>([h.shoulder, h.elbow])?`.
    ///
    /// # Errors
    /// As [`IndependentExt::coordinates`].
    fn coordinates_in<S: Real, const N: usize>(
        &self,
        chosen: impl Chosen<Self, N>,
    ) -> Result<IndependentCoordinates<Self, N, S>, Fault> {
        let places = Places::of::<Self>(choice::places::<Self, N>(chosen)?);
        let parameters = self.parameters()?;
        let constants = Self::prepare(&parameters);
        let mut space = IndependentCoordinates {
            equations: Equations::prepared((&parameters, &constants), places, S::zero()),
            constants,
            parameters,
            described: None,
            passes_limits: false,
        };
        space.describe();
        Ok(space)
    }
}

impl<M: JointRates> IndependentExt for M {}

impl<M: JointRates, const N: usize, S: Scalar> IndependentCoordinates<M, N, S> {
    /// The time (s) that drivers and laws are taken at.
    #[must_use]
    pub const fn time(&self) -> S {
        self.equations.time
    }

    /// Takes drivers and laws at another time (s).
    pub const fn set_time(&mut self, time: S) {
        self.equations.time = time;
    }

    /// Passes the limits of the description, `#[joint(.., limits = [-1.0, 1.0])]`: in equilibria,
    /// trims, sensitivities and gradients of this space.
    #[must_use]
    pub const fn without_limits(mut self) -> Self {
        self.passes_limits = true;
        self
    }

    /// Whether all joints are between the limits of the description.
    ///
    /// # Errors
    /// [`AssemblyFault::BeyondLimit`] with the first one that is not, where it is, and its limit.
    pub fn check_limits(&self, state: &M::JointState<S>) -> Result<(), AssemblyFault>
    where
        S: Real,
    {
        let bodies = self.bodies(state);
        check_limits::<S, M>(&self.parameters, &self.constants, (self.time(), &bodies))
    }

    /// A state that was found, unless it is beyond limits that count.
    fn within_limits(&self, state: M::JointState<S>) -> Result<M::JointState<S>, Fault>
    where
        S: Real,
    {
        if !self.passes_limits {
            self.check_limits(&state)?;
        }
        Ok(state)
    }

    /// The joint, or the free body, of a chosen coordinate.
    fn joint(&self, number: usize) -> &'static str {
        let place = self.equations.places.get(number);
        place.map_or("", |&place| M::JOINT_REPORT.mover_of_rate(place))
    }

    /// The joints of the coordinates, in their order.
    #[must_use]
    pub fn names(&self) -> [&'static str; N] {
        core::array::from_fn(|number| self.joint(number))
    }

    /// Sets the inputs of the mechanism, with which its described forces act.
    ///
    /// # Errors
    /// An input that is not finite; the former ones then stay.
    pub fn set_inputs(&mut self, inputs: &M::Inputs<S>) -> Result<(), ParameterError>
    where
        S: Real,
    {
        M::put_inputs(inputs, &mut self.parameters)?;
        M::take_inputs(&self.parameters, &mut self.constants);
        M::take_joint_inputs(&self.parameters, &mut self.equations.constants);
        Ok(())
    }
}

copied! {
    [M: JointRates, const N: usize, S: Scalar] IndependentCoordinates<M, N, S>;
    [M: JointRates, const N: usize, S: Scalar] Equations<M, N, S>;
}

impl<M: JointRates, const N: usize, S: Scalar> fmt::Debug for IndependentCoordinates<M, N, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("IndependentCoordinates")
            .field("rates", &*self.equations.places)
            .field("time", &self.equations.time)
            .finish_non_exhaustive()
    }
}

/// The number of degrees of freedom, as the equations have it.
fn degrees_of_freedom<M: Mechanism>() -> usize {
    usize::try_from(M::REPORT.degrees_of_freedom).unwrap_or(0)
}
