//! The trait that `#[derive(Mechanism)]` implements: a mechanism as a set of kernels.

use core::fmt::Debug;

use crate::error::{AnalysisFault, Fault, LeavesOut, ParameterError, StartFault, StepFault};
use crate::math::scalar::{Real, Scalar};
use crate::mechanism::coordinates::{Coordinates, Evaluation};
use crate::mechanism::limits::{JointLimits, Several};
use crate::mechanism::readout::{AngleParts, DisplacementParts, ForceParts};
use crate::mechanism::report::{Comment, Report};
use crate::mechanism::switch::Switch;
use crate::state::vector::{Array, StateParts};

pub use super::pivot::Pivot;
pub use super::terms::{
    Compliant, Normalised, Orientation, Plain, Rigid, Stabilisation, Stabilised, Terms,
};

/// The state of a mechanism, with numbers of type `f64` unless another one is named:
/// `StateOf<Arm>`, `StateOf<Arm, f32>`.
pub type StateOf<M, S = f64> = <M as Mechanism>::State<S>;

/// The inputs of a mechanism, likewise: `InputsOf<Arm>`, `InputsOf<Arm, f32>`.
pub type InputsOf<M, S = f64> = <M as Mechanism>::Inputs<S>;

/// A mechanism whose kernels were generated at compile time.
///
/// Notation: `r` position of a centre of mass (m, global), `p` Euler parameters (scalar first, from
/// body to global axes), `v = r'` (m/s, global), `w` angular velocity (rad/s, body axes),
/// `q = (r, p)` and `u = (v, w)` of all bodies; a prime is the time derivative. Body axes are here
/// the *principal* axes about the centre of mass, which are the user's own axes unless a full
/// inertia tensor was given; access by handle ([`MechanismExt`](crate::MechanismExt)) speaks the
/// user's axes.
///
/// Equations (Nikravesh 1988, chapter 8; Flores 2015, chapter 11), with `gamma*` from
/// [`Stabilisation`] and a diagonal matrix `E` of compliances `e`, one for each row:
///
/// ```text
/// [ M   D^T ] [ u'     ]   [ g                           ]      Phi(q, t) = 0,  Phi' = D u + Phi_t
/// [ D   -E  ] [ lambda ] = [ gamma* - E lambda_previous  ]    on the bodies: -D^T lambda
/// ```
///
/// Kernels neither branch on data nor fail. A singular system shows in the [`Pivot`] that comes
/// with the result.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a mechanism",
    label = "not derived by `#[derive(Mechanism)]`, or its derive came to no end",
    note = "if it has `#[derive(Mechanism)]`, see the error at the type of one of its fields: a name that is not found, or an alias, ends the derive"
)]
pub trait Mechanism: Sized + 'static {
    /// The state: coordinates and velocities. The rates of a state have the same type.
    type State<S: Scalar>: StateParts<S, Velocities = Self::Velocities<S>>;
    /// One number per velocity: accelerations `u'` (m/s^2 global, rad/s^2 body axes), forces (N
    /// global) and moments (N m, body axes, about the centre of mass).
    type Velocities<S: Scalar>: Array<S>;
    /// One number per constraint equation: multipliers, `Phi`, `Phi'`, `gamma`.
    type Multipliers<S: Scalar>: Array<S>;
    /// The coordinates in which its equations of motion are solved where nothing else is said:
    /// [`Relative`](crate::mechanism::Relative) with `#[mechanism(coordinates = "joints")]`, else
    /// [`Absolute`](crate::mechanism::Absolute).
    type Coordinates: Coordinates<Self>;
    /// The blocks of the Jacobian one after the other, see [`Report::blocks`].
    type Jacobian<S: Scalar>: Array<S>;
    /// Values that are set once per mechanism, and inputs.
    type Parameters<S: Scalar>: Array<S>;
    /// A struct with the fields that are inputs (`#[input]`), under their names; `()` without any.
    /// Zero by default.
    type Inputs<S: Scalar>: Copy + Debug + Default + PartialEq;
    /// What depends on parameters alone; without elements where everything folds at compile time.
    type Constants<S: Scalar>: Array<S>;
    /// What depends on constants and on the coefficients of the formulation.
    type Coefficients<S: Scalar>: Array<S>;
    /// The factorised saddle system, to be used by [`Mechanism::solve`].
    type Factors<S: Scalar>: Copy + Debug;
    /// A struct with one handle per field of the mechanism, under the field's name; an array of
    /// handles where the field is an array.
    type Handles: Copy + Debug;
    /// As many things as joints have limits.
    #[doc(hidden)]
    type PerLimit<T: Clone>: Several<T>;

    /// One handle per field of the mechanism, under the field's name.
    const HANDLES: Self::Handles;
    /// Sizes, names, operation counts.
    const REPORT: Report;
    /// The first rows of equations between vectors. Each has three rows, which share one
    /// compliance: axes are not told apart.
    const VECTOR_ROWS: &'static [usize] = &[];
    /// The expressions in laws whose signs decide; none where no law switches.
    const SWITCHES: &'static [Switch] = &[];
    /// The doc comments above the struct and its fields, as they were written; that of the struct
    /// is the first, if there is one.
    const COMMENTS: &'static [Comment] = &[];
    /// The bodies whose masses and moments are `as_given`, whether a body may have them or not.
    #[doc(hidden)]
    const AS_GIVEN: &'static [usize] = &[];
    /// Those of them with a mass or a moment that is not positive. The mechanism moves by its
    /// joints alone then.
    #[doc(hidden)]
    const WITHOUT_INERTIA: &'static [usize] = &[];
    /// The forces that turn round where a length passes through zero, one for each such length.
    #[doc(hidden)]
    const SEPARATIONS: &'static [&'static str] = &[];

    /// The parameters of this value, checked as the `f64` that they are: here are all numbers that
    /// the macro could not see.
    ///
    /// # Errors
    /// A mass or an inertia that is not positive, an axis of length zero, a number that is not
    /// finite.
    fn parameters<S: Scalar>(&self) -> Result<Self::Parameters<S>, ParameterError>;

    /// The limits of joints with parameters that were accepted, in the order of the fields.
    #[doc(hidden)]
    fn limits_of<S: Scalar, T: Clone>(
        parameters: &Self::Parameters<S>,
        make: impl FnMut(JointLimits<S>) -> T,
    ) -> Self::PerLimit<T>;

    /// Checks by numbers that what was decided at typical values (`#[param(like = 0.8)]`) holds for
    /// the parameters of this value, unless they were accepted before: the mechanism can be
    /// assembled, its equations are independent at the start, and those that were left out follow
    /// from them.
    ///
    /// `new` of the mechanism, [`Dynamics::new`](crate::dynamics::Dynamics::new) and `update` call
    /// it. It uses double precision and takes some dozens of evaluations. It does nothing where no
    /// typical value was used.
    ///
    /// # Errors
    /// The parameter, and the joint where it shows:
    /// [`ParameterFault::NotAssembled`](crate::error::ParameterFault::NotAssembled), `Dependent` or
    /// `Independent`; what [`Mechanism::parameters`] refuses.
    #[inline]
    fn check_likes<S: Real>(
        &self,
        _since: Option<&Self::Parameters<S>>,
    ) -> Result<(), ParameterError> {
        Ok(())
    }

    /// The value and the gradient, over the velocities, of an equation that was left out at typical
    /// values of parameters, by its number among those. `None` behind the last one, and where no
    /// typical value was used.
    #[inline]
    fn left_out<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _number: usize,
    ) -> Option<(S, Self::Velocities<S>)> {
        None
    }

    /// The inputs of this value.
    fn inputs<S: Scalar>(&self) -> Self::Inputs<S>;

    /// Puts inputs among the parameters.
    ///
    /// # Errors
    /// An input that is not finite; the parameters are then as before.
    #[inline]
    fn put_inputs<S: Real>(
        _inputs: &Self::Inputs<S>,
        _parameters: &mut Self::Parameters<S>,
    ) -> Result<(), ParameterError> {
        Ok(())
    }

    /// The inputs that were put among the parameters.
    #[inline]
    #[must_use]
    fn inputs_of<S: Scalar>(_parameters: &Self::Parameters<S>) -> Self::Inputs<S> {
        Self::Inputs::default()
    }

    /// Computes once what depends on parameters and inputs only.
    fn prepare<S: Scalar>(parameters: &Self::Parameters<S>) -> Self::Constants<S>;

    /// Computes again what depends on inputs, and leaves what does not.
    #[inline]
    fn take_inputs<S: Scalar>(
        _parameters: &Self::Parameters<S>,
        _constants: &mut Self::Constants<S>,
    ) {
    }

    /// Computes once what depends on the coefficients of a formulation, with one compliance for all
    /// rows.
    fn coefficients<S: Scalar>(
        constants: &Self::Constants<S>,
        stabilisation: &Stabilisation<S>,
    ) -> Self::Coefficients<S> {
        let mut compliances = Self::Multipliers::<S>::zeros();
        compliances.as_mut_slice().fill(stabilisation.compliance);
        Self::coefficients_by_row(constants, stabilisation, &compliances)
    }

    /// Computes once what depends on the coefficients of a formulation, with a compliance for each
    /// row in the place of [`Stabilisation::compliance`]. Of the three rows of a vector equation
    /// the first counts, see [`Mechanism::VECTOR_ROWS`].
    fn coefficients_by_row<S: Scalar>(
        constants: &Self::Constants<S>,
        stabilisation: &Stabilisation<S>,
        compliances: &Self::Multipliers<S>,
    ) -> Self::Coefficients<S>;

    /// The state that the attributes of the bodies describe.
    fn initial_state<S: Scalar>(constants: &Self::Constants<S>) -> Self::State<S>;

    /// `Phi(q, t)`.
    fn constraints<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Self::Multipliers<S>;

    /// `Phi' = D u + Phi_t`.
    fn constraint_rates<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Self::Multipliers<S>;

    /// The Jacobian `D` with `Phi' = D u + Phi_t`, by blocks.
    fn jacobian<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Self::Jacobian<S>;

    /// `gamma` with `D u' = gamma`.
    fn gamma<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Self::Multipliers<S>;

    /// The diagonal of the mass matrix: `(m, m, m, J1, J2, J3)` for a body.
    fn mass<S: Scalar>(constants: &Self::Constants<S>) -> Self::Velocities<S>;

    /// The same with masses and moments that are positive, also of bodies that are `as_given`: what
    /// sizes of motions are measured by, and projections take the least of. No motion follows from
    /// it.
    #[doc(hidden)]
    #[inline]
    fn metric<S: Scalar>(constants: &Self::Constants<S>) -> Self::Velocities<S> {
        Self::mass(constants)
    }

    /// `g`: gravity, forces of the language, and the gyroscopic moment `-w x J w`.
    fn forces<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Self::Velocities<S>;

    /// Kinetic energy (J).
    fn kinetic_energy<S: Scalar>(constants: &Self::Constants<S>, state: &Self::State<S>) -> S;

    /// Potential energy (J): of gravity, zero where all centres of mass are at the global origin,
    /// and of forces with a potential.
    fn potential_energy<S: Scalar>(
        constants: &Self::Constants<S>,
        time: S,
        state: &Self::State<S>,
    ) -> S;

    /// The power (W) of the forces of the language that have no potential: of dampers, actuators
    /// and given forces.
    fn power<S: Scalar>(_constants: &Self::Constants<S>, _time: S, _state: &Self::State<S>) -> S {
        S::zero()
    }

    /// Potential energy and power of one force by its index; zeros for a force that is not there.
    fn force_parts<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _force: usize,
    ) -> ForceParts<S> {
        ForceParts {
            potential: S::zero(),
            power: S::zero(),
        }
    }

    /// What one force exerts on one of its bodies, by its place in `between`: force (N, global) and
    /// moment about the centre of mass (N m, principal body axes). Zeros for the ground.
    fn force_load<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _force: usize,
        _place: usize,
    ) -> [S; 6] {
        [S::zero(); 6]
    }

    /// The rates of the coordinates: `r' = v`, `p' = 1/2 L(p)^T w` with `p` as it is; behind them
    /// the rates of the auxiliary variables, and zeros for the user's own states: a motion of the
    /// bodies leaves these as they are.
    fn coordinate_rates<S: Scalar>(
        constants: &Self::Constants<S>,
        state: &Self::State<S>,
    ) -> <Self::State<S> as StateParts<S>>::Coordinates;

    /// Writes the rates of the user's own states in their places ([`Report::states`]), and leaves
    /// the others. Without effect where there are none.
    #[inline(always)]
    fn state_rates_into<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _rates: &mut <Self::State<S> as StateParts<S>>::Coordinates,
    ) {
    }

    /// Writes the values of [`Mechanism::SWITCHES`] where their sides are among the parameters, and
    /// leaves the others. Without effect where there are none.
    #[doc(hidden)]
    #[inline(always)]
    fn switches_into<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _readings: &mut Self::Parameters<S>,
    ) {
    }

    /// The same of those that depend on the time alone; nothing is read of the state.
    #[doc(hidden)]
    #[inline(always)]
    fn switches_of_time_into<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _readings: &mut Self::Parameters<S>,
    ) {
    }

    /// Calls `visit` with the place of each of [`Mechanism::SEPARATIONS`] and its vectors (m), of
    /// one frame, at two times (s).
    #[doc(hidden)]
    #[inline(always)]
    fn separations<S: Scalar>(
        _constants: &Self::Constants<S>,
        _ends: [(S, &Self::State<S>); 2],
        _visit: &mut impl FnMut(usize, [[S; 3]; 2]),
    ) {
    }

    /// A point or direction that a joint or force names, by its place in [`Report::markers`]: in
    /// principal axes of its body, a point from the centre of mass (m); in global axes on the
    /// ground. Zeros for a marker that is not there.
    fn marker<S: Scalar>(_constants: &Self::Constants<S>, _marker: usize) -> [S; 3] {
        [S::zero(); 3]
    }

    /// A named point by its place in [`Report::points`], from the centre of mass (m) in principal
    /// axes of its body; global on the ground. Zeros for a point that is not there.
    fn named_point<S: Scalar>(_constants: &Self::Constants<S>, _point: usize) -> [S; 3] {
        [S::zero(); 3]
    }

    /// The sizes (m) of a shape by its place in [`Report::shapes`], as
    /// [`ShapeKind`](crate::mechanism::ShapeKind) lists them; zeros behind them, and for a shape
    /// that is not there.
    fn shape<S: Scalar>(_constants: &Self::Constants<S>, _shape: usize) -> [S; 3] {
        [S::zero(); 3]
    }

    /// Sets every auxiliary variable to its exact value for the orientations in the state: an angle
    /// that counts turns becomes the one that is nearest to the value it has. Without effect where
    /// there are none.
    ///
    /// An integrator moves an auxiliary variable along with the orientations; after a state was set
    /// or displaced otherwise, this puts it right as long as it is off by less than half a turn.
    fn rewrap<S: Scalar>(_constants: &Self::Constants<S>, _state: &mut Self::State<S>) {}

    /// The whole right-hand side in one straight line: rates of the state and multipliers, from the
    /// saddle system with `lambda_previous = 0` and without applied forces of a user. Writes every
    /// element of both; returns the smallest relative pivot.
    ///
    /// `A(p)` is evaluated at `p / |p|`, a rotation to round-off for any `p` but zero. The rates of
    /// Euler parameters are `p' = 1/2 L(p)^T w` with `p` as it is: only so does `p / |p|` turn at
    /// `w`, whatever the length has become in the stages of a step.
    ///
    /// `T` names the terms that the formulation has. With `coordinates = "joints"` it is put
    /// together from [`Mechanism::factor`], [`Mechanism::solve`] and the kernels of the right-hand
    /// side.
    fn evaluate_into<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &Self::State<S>,
        rates: &mut Self::State<S>,
        multipliers: &mut Self::Multipliers<S>,
    ) -> Pivot<S>;

    /// The same, with its results in one value.
    #[inline(always)]
    fn evaluate<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &Self::State<S>,
    ) -> Evaluation<S, Self> {
        let mut evaluation = Evaluation::<S, Self>::zeros();
        let Evaluation {
            rates,
            multipliers,
            pivot,
        } = &mut evaluation;
        *pivot =
            Self::evaluate_into::<S, T>(constants, coefficients, time, state, rates, multipliers);
        evaluation
    }

    /// Whether there is [`Mechanism::rate_columns`]: with `coordinates = "bodies"` and
    /// `kernels = [derivatives]`.
    const HAS_RATE_COLUMNS: bool = false;

    /// Gives the derivatives of the rates of a state: a column by each of its coordinates, as they
    /// are stored, and then by each velocity, with its number. Nothing where
    /// [`Mechanism::HAS_RATE_COLUMNS`] says that they are not there.
    fn rate_columns<S: Scalar, T: Terms>(
        _constants: &Self::Constants<S>,
        _coefficients: &Self::Coefficients<S>,
        _time: S,
        _state: &Self::State<S>,
        _put: impl FnMut(usize, Self::State<S>),
    ) {
    }

    /// Factorises the matrix of the saddle system; with compliance where `T::COMPLIANT`. `p` is
    /// read as it is.
    fn factor<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        time: S,
        state: &Self::State<S>,
    ) -> (Self::Factors<S>, Pivot<S>);

    /// Solves `[M D^T; D -E] (a, lambda) = (upper, lower)` with factors of the same `T`.
    fn solve<S: Scalar, T: Terms>(
        constants: &Self::Constants<S>,
        coefficients: &Self::Coefficients<S>,
        factors: &Self::Factors<S>,
        upper: &Self::Velocities<S>,
        lower: &Self::Multipliers<S>,
    ) -> (Self::Velocities<S>, Self::Multipliers<S>);

    /// The angle of a joint by its index, zero in the configuration that the attributes describe.
    ///
    /// For a joint without an angle `cosine = 1`, `sine = rate = 0`, no count of turns.
    fn joint_angle<S: Scalar>(
        constants: &Self::Constants<S>,
        state: &Self::State<S>,
        joint: usize,
    ) -> AngleParts<S>;

    /// Both angles of a joint by its index, without a count of turns. For a joint that has not two
    /// angles each has `cosine = 1`, `sine = rate = 0`.
    fn joint_angles<S: Scalar>(
        _constants: &Self::Constants<S>,
        _state: &Self::State<S>,
        _joint: usize,
    ) -> [AngleParts<S>; 2] {
        [AngleParts::none(); 2]
    }

    /// The displacement of a joint by its index, as its definition states it, and its rate; zeros
    /// for a joint without one.
    fn joint_displacement<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _joint: usize,
    ) -> DisplacementParts<S> {
        DisplacementParts::none()
    }

    /// The contact of a joint by its index, as its definition states it, in global axes: the point
    /// (m), the normal, and the velocity of the material of the second body there against that of
    /// the first (m/s). Zeros for a joint without one.
    fn joint_contact<S: Scalar>(
        _constants: &Self::Constants<S>,
        _time: S,
        _state: &Self::State<S>,
        _joint: usize,
    ) -> [[S; 3]; 3] {
        [[S::zero(); 3]; 3]
    }

    /// Positive where a joint is on the side that is meant, of the configurations that satisfy its
    /// equations; what is least where its definition says more than one thing (`require .. > 0`),
    /// and 1 where it says nothing.
    fn joint_side<S: Scalar>(
        _constants: &Self::Constants<S>,
        _state: &Self::State<S>,
        _joint: usize,
    ) -> S {
        S::one()
    }

    /// The joint's point on one of its bodies, by its place in `between`: from the centre of mass
    /// to the point, in principal body axes (m); in global axes from the origin for the ground.
    fn joint_point<S: Scalar>(constants: &Self::Constants<S>, joint: usize, place: usize)
    -> [S; 3];

    /// The user's body axes, as Euler parameters `c` (scalar first, unit) of the rotation from the
    /// user's to the principal axes: `A(c)` takes components along the user's axes to components
    /// along the principal axes, so that the user's axes are turned against the global ones by
    /// `A(p) A(c)`, with Euler parameters `p c` (quaternion product). `(1, 0, 0, 0)` where the user
    /// gave principal moments, and for a particle.
    fn user_axes(body: usize) -> [f64; 4];
}

/// Refuses a mechanism whose bodies have no equations of motion.
pub(crate) fn have_equations<M: Mechanism>() -> Result<(), StepFault> {
    match M::WITHOUT_INERTIA {
        [] => Ok(()),
        [first, ..] => Err(StepFault::WithoutInertia {
            body: M::REPORT.bodies.get(*first).map_or("", |body| body.name),
        }),
    }
}

/// Refuses a mechanism with states of the user's own.
pub(crate) fn bodies_alone<M: Mechanism>(by: LeavesOut) -> Result<(), StartFault> {
    match M::REPORT.states {
        [] => Ok(()),
        [first, ..] => Err(StartFault::StateLeftOut {
            state: first.name,
            by,
        }),
    }
}

/// Refuses a mechanism whose equations do not all hold configurations.
pub(crate) fn configurations_alone<M: Mechanism>() -> Result<(), Fault> {
    match M::REPORT.velocity_rows {
        [] => Ok(()),
        [first, ..] => Err(Fault::Analysis(AnalysisFault::VelocityEquations {
            joint: M::REPORT.joint_of(*first).unwrap_or_default(),
        })),
    }
}

/// Whether principal moments of inertia are those of no body: one is larger than the others
/// together.
#[doc(hidden)]
#[must_use]
pub fn is_no_inertia(a: f64, b: f64, c: f64) -> bool {
    let excess = |x: f64, y: f64, z: f64| x > (y + z) * (1.0 + 1e-9);
    excess(a, b, c) || excess(b, c, a) || excess(c, a, b)
}
