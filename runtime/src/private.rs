//! What generated code may call. Not an interface: it changes with every release.

#[path = "private/stubs.rs"]
mod stubs;

pub use holonom_macros::{assemble, force_impl, joint_impl};
#[cfg(feature = "urdf")]
pub use holonom_urdf_macros::urdf_impl;

pub use crate::dynamics::likes::{Like, check_likes};
pub use crate::error::ParameterFault;
pub use crate::forward::slope;
pub use crate::math::side::{above, below, side};
pub use crate::math::spline::{Order, SplineFault, Table, evaluate_numbers};
pub use crate::mechanism::by_rows::{Profile, RowFactors, factor_by_rows, solve_by_rows};
pub use crate::mechanism::table::{Sources, angle_of, least};
pub use crate::mechanism::{
    Absolute, AngleParts, Block, BodyInfo, BodyKind, Carrier, CountsTurns, DisplacementParts,
    Driven, ElementPlace, ExplicitTime, Force, ForceInfo, ForceParts, Freedom, HasAngle,
    HasContact, HasCoriolis, HasDisplacement, HasGravity, HasInverse, HasJacobian, HasMassMatrix,
    HasTwoAngles, Joint, JointCounter, JointInfo, JointMotion, JointRates, JointReport, Kernel,
    Marker, MarkerKind, Operations, Pivot, PointHandle, PointInfo, Rank, RedundantRow, Relative,
    Shape, ShapeKind, Stabilisation, StateHandle, StateInfo, Terms, ValueHandle, ValueInfo,
};
pub use crate::state::sums::zero_if_finite;
pub use crate::state::{Array, JointState, State};

use crate::error::ParameterError;
use crate::math::quaternion::{product, rotate};
use crate::math::scalar::{Real, Scalar, elementary};
use crate::mechanism::absolute::stabilised;
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::orientations::{scale_euler_rates, with_unit_orientations};
use crate::state::vector::StateParts;

/// [`Mechanism::evaluate_into`] from the other kernels, with the gains of `Phi'` and of `Phi`.
#[inline]
pub fn evaluate_in_parts<S: Scalar, M: Mechanism, T: Terms>(
    constants: &M::Constants<S>,
    coefficients: &M::Coefficients<S>,
    gains: [S; 2],
    time: S,
    state: &M::State<S>,
    rates: &mut M::State<S>,
    multipliers: &mut M::Multipliers<S>,
) -> Pivot<S> {
    let read = with_unit_orientations::<S, M>(state);
    let (factors, pivot) = M::factor::<S, T>(constants, coefficients, time, &read);
    let upper = M::forces(constants, time, &read);
    let lower = stabilised::<S, M, T>(constants, gains, time, &read);
    let (accelerations, solved) =
        M::solve::<S, T>(constants, coefficients, &factors, &upper, &lower);
    let mut coordinate_rates = M::coordinate_rates(constants, &read);
    // Those of Euler parameters are made of these as they are.
    scale_euler_rates::<S, M>(&mut coordinate_rates, state, |length| length);
    M::state_rates_into(constants, time, &read, &mut coordinate_rates);
    *rates = M::State::from_parts(coordinate_rates, accelerations);
    *multipliers = solved;
    pivot
}

/// [`Mechanism::put_inputs`] of inputs with their places among the run-time values and their names.
///
/// # Errors
/// An input that is not finite; nothing is then put.
#[inline]
pub fn put_inputs<S: Real>(
    inputs: &[(usize, &'static str, S)],
    parameters: &mut [S],
) -> Result<(), ParameterError> {
    for &(_, field, value) in inputs {
        if !value.is_finite() {
            return Err(ParameterError {
                field,
                attribute: "value",
                fault: ParameterFault::NotFinite,
            });
        }
    }
    for &(place, _, value) in inputs {
        if let Some(parameter) = parameters.get_mut(place) {
            *parameter = value;
        }
    }
    Ok(())
}

/// Square root.
#[must_use]
pub fn sqrt(x: f64) -> f64 {
    elementary::sqrt64(x)
}

/// Sine of an angle in radians.
#[must_use]
pub fn sin(x: f64) -> f64 {
    elementary::sin64(x)
}

/// Cosine of an angle in radians.
#[must_use]
pub fn cos(x: f64) -> f64 {
    elementary::cos64(x)
}

/// Tangent of an angle in radians.
#[must_use]
pub fn tan(x: f64) -> f64 {
    elementary::tan64(x)
}

/// Exponential function.
#[must_use]
pub fn exp(x: f64) -> f64 {
    elementary::exp64(x)
}

/// An angle in radians, given in degrees.
#[must_use]
pub fn deg(x: f64) -> f64 {
    x.to_radians()
}

/// Euler parameters of a rotation after another one.
#[must_use]
pub fn composed<S: Scalar>(outer: [S; 4], inner: [S; 4]) -> [S; 4] {
    product(&outer, &inner)
}

/// A vector that is turned by Euler parameters of length 1.
#[must_use]
pub fn turned<S: Scalar>(p: [S; 4], vector: [S; 3]) -> [S; 3] {
    rotate(&p, &vector)
}

/// A rotation that is seen in a mirror across an axis.
#[must_use]
pub fn mirrored<S: Scalar>(p: [S; 4], axis: usize) -> [S; 4] {
    let [e0, e1, e2, e3] = p;
    let seen = |place: usize, e: S| if place == axis { e } else { -e };
    [e0, seen(0, e1), seen(1, e2), seen(2, e3)]
}

pub use crate::mechanism::kernels::is_no_inertia;

/// Whether all components are zero.
#[must_use]
pub fn is_zero<const N: usize>(components: [f64; N]) -> bool {
    components.iter().all(|component| *component == 0.0)
}

/// Defines a joint: a constraint between bodies, symbolically, so that mechanisms in any crate can
/// use it.
///
/// ```
/// holonom::joint! {
///     /// A massless rod between two points: their distance stays the same. 1 equation.
///     pub joint Rod(i, j; head: Point, tail: Point, length: Length) {
///         squared(j.tail - i.head) - length * length;
///     }
/// }
/// ```
///
/// In the parentheses stand the names of the bodies, then the parameters with their kinds; a
/// mechanism gives the parameters as attributes of the same names. In the braces stand expressions
/// that are zero, each with a `;`: a scalar gives one equation, a vector three, two vectors or two
/// scalars (see `normals`) twice as many.
///
/// | kind | what a mechanism gives | in the definition |
/// |---|---|---|
/// | `Point` | a point in global axes in the reference configuration, or `local(..)`: one for each body from its centre of mass in its own axes | `i.name`: the point fixed on `i`, as it moves |
/// | `Axis` | a direction, likewise; any length but zero, used as a unit vector | `i.name`: the unit vector fixed on `i`; `i.name.normal()` and `i.name.binormal()`: unit vectors on `i` that make it a right-handed frame, in directions that are fixed but arbitrary (take a second `Axis` or `Vector` where they matter); `i.name.normals()`: both of them, twofold |
/// | `Vector` | a vector, likewise | `i.name` |
/// | `Length`, `Angle`, `Number` | a number (m, rad, 1); may have a default, as in `ratio: Number = 1.0` | `name` |
/// | `Law`, `Law(x, y)` | an expression of `time` and of the names in parentheses, such as `0.5 * sin(3.0 * time)` | `name()`, `name(a, b)`: its value |
///
/// Expressions:
///
/// | | |
/// |---|---|
/// | vectors | `i.origin` (the centre of mass), `[x, y, z]` (global axes), `a + b`, `a - b`, `-a`, `x * a`, `a / x`, `cross(a, b)`, `fixed(i, a)`: the vector `a` as it is in the reference configuration, fixed on `i` |
/// | scalars | numbers, `PI`, `TAU`, `time`, `+ - * /`, `dot(a, b)`, `length(a)`, `squared(a)` (the square of the length), `sqrt sin cos exp (x)`, `smooth_step(x)`: 0 below 0, 1 above 1, `6 x^5 - 15 x^4 + 10 x^3` between |
/// | | `angle(i, j, axis)`: the angle (rad) of `j` against `i` about an `Axis`, right-handed, zero in the reference configuration. Turns are counted, by an auxiliary variable of the state |
/// | | `initial(x)`: the scalar `x` as it is in the reference configuration |
///
/// Statements beside equations: `let name = expression;`, `drive x to y;`, the equation `x - y` of
/// a driver, with `y` a function of time, whose effort can be read
/// ([`Sample::driving_effort`](crate::Sample::driving_effort)), `angle about axis;` and
/// `displacement x;`, which can be read ([`View::angle`](crate::View::angle),
/// [`View::displacement`](crate::View::displacement)), `contact point, normal;`, the point where
/// the second body touches the first, and the direction from there into the second
/// ([`View::contact`](crate::View::contact)), and `motion ..;`, which says how the second of two
/// bodies moves against the first: motions separated by commas, each carried by those before it,
/// or `none`.
///
/// | motion | |
/// |---|---|
/// | `turn axis at point` | a rotation about the line through `point` along `axis` |
/// | `slide axis` | a translation along `axis` |
/// | `screw axis at point by pitch` | a rotation, and a translation along its axis by the `Length` `pitch` for every right-handed turn |
/// | `ball at point` | every rotation about `point`: three motions |
///
/// An axis is an `Axis` of the joint, or the `.normal()` or `.binormal()` of one, a point a
/// `Point`, as they are in the reference configuration. The axis of a screw is an `Axis` itself,
/// and an equation counts its turns by `angle(i, j, axis)` of it. Motions that are not those that
/// the equations leave are refused, where that can be told without a mechanism. A joint connects
/// one or more bodies; the `ground` of a mechanism may be any of them.
///
/// The joint's reaction is `-D^T lambda`, whatever the units of its equations are. What a good
/// equation looks like, and a joint in use: [`guide::joint`](crate::guide::joint).
#[macro_export]
macro_rules! joint {
    ($($definition:tt)*) => {
        $crate::__private::joint_impl! { [$crate] $($definition)* }
    };
}

/// Defines a force: what acts on bodies, symbolically, so that mechanisms in any crate can use it.
///
/// ```
/// holonom::force! {
///     /// A spring that stiffens as it is stretched, and a damper beside it.
///     pub force Bungee(i, j; head: Point, tail: Point, stiffness: Number, damping: Number = 0.0) {
///         let stretch = length(j.tail - i.head) - initial(length(j.tail - i.head));
///         potential 0.25 * stiffness * stretch * stretch * stretch * stretch;
///         -damping * rate(stretch) along stretch;
///     }
/// }
/// ```
///
/// Signature and expressions are those of [`joint!`](crate::joint!), examples in
/// [`guide::forces`](crate::guide::forces); `rate(x)` is the time derivative of a scalar.
/// Statements:
///
/// | statement | what acts |
/// |---|---|
/// | `potential v;` | minus the gradient of the energy `v` (J), which the generator differentiates; it is part of the potential energy of the mechanism |
/// | `f along x;` | a generalised force: for `x` a length the force `f` (N) that lengthens it, for `x` an angle the moment (N m) that enlarges it. Power `f rate(x)` |
/// | `force a at i.point;` | the force `a` (N) at a point of a body |
/// | `moment a on i;` | the moment `a` (N m) on a body |
/// | `let name = expression;` | nothing |
#[macro_export]
macro_rules! force {
    ($($definition:tt)*) => {
        $crate::__private::force_impl! { [$crate] $($definition)* }
    };
}

/// The handles of a part in a stub.
#[doc(hidden)]
#[macro_export]
macro_rules! __stub_part {
    ($part:ident $($field:ident: $([$length:expr])? $kind:ident $($path:ty)?,)*) => {
        pub struct $part<__M> {
            $(pub $field: $crate::__stub_mechanism!(@handle $([$length])? $kind $($path)?),)*
            __mechanism: ::core::marker::PhantomData<fn() -> __M>,
        }
        impl<__M> ::core::clone::Clone for $part<__M> {
            fn clone(&self) -> Self { *self }
        }
        impl<__M> ::core::marker::Copy for $part<__M> {}
        impl<__M> ::core::fmt::Debug for $part<__M> {
            fn fmt(&self, _: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result { loop {} }
        }
        impl<__M> $part<__M> {
            const VALUE: Self = Self {
                $($field: $crate::__stub_mechanism!(@value $([$length])? $kind $($path)?),)*
                __mechanism: ::core::marker::PhantomData,
            };
        }
    };
}

/// Makes a mechanism of a URDF file. It needs the feature `urdf`.
///
/// ```
/// use holonom::prelude::*;
///
/// holonom::urdf! {
///     /// The arm of the cell.
///     #[urdf(round_angles)]
///     pub struct Arm = "../urdf/arm.urdf";
/// }
///
/// let mut arm = Arm::default();
/// arm.shoulder_torque = 4.0; // N m
/// assert_eq!(Arm::REPORT.degrees_of_freedom, 2);
/// assert_eq!(Arm::EFFORT_LIMITS[1], 50.0);
/// ```
///
/// The path begins at the folder of the crate's `Cargo.toml`. The struct is the one that the
/// command `holonom-urdf` prints, with the same fields, constants and documentation. It is made
/// anew when the file changes. Every fault of the file is an error of the compiler, with its line.
///
/// | `#[urdf(..)]` | |
/// |---|---|
/// | `floating` | the root link is a free body; else it is the ground |
/// | `passive` | joints have no inputs and no motors; damping stays |
/// | `inertia = "as given"` | masses and inertias that no body has are taken as the file gives them, if the robot as a whole has inertia |
/// | `round_angles` | angles of frames within 1e-5 rad of a quarter turn are exact: 1.5708 is pi / 2 |
///
/// A `#[mechanism(..)]` of your own stands beside the one that is printed,
/// `#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]`. What yours names is as you
/// write it, the rest stays. Other attributes are added.
/// Fields of your own follow the file in braces. They name bodies by their fields. So you close a
/// loop or add a spring without a copy of the struct:
///
/// ```
/// use holonom::prelude::*;
///
/// holonom::urdf! {
///     pub struct Sprung = "../urdf/arm.urdf" {
///         #[param]
///         stiffness: f64,
///         #[force(between = [upper_arm, forearm], axis = [0.0, 1.0, 0.0], stiffness = stiffness)]
///         spring: TorsionalSpringDamper,
///     }
/// }
///
/// let arm = Sprung::new(20.0)?;
/// assert_eq!(Sprung::REPORT.forces.len(), 3); // two motors and the spring
/// # Ok::<(), holonom::ParameterError>(())
/// ```
#[cfg(feature = "urdf")]
#[macro_export]
macro_rules! urdf {
    ($($robot:tt)*) => {
        $crate::__private::urdf_impl! { [$crate] $($robot)* }
    };
}

/// A type made by `joint!`, by `force!` or by `#[derive(Assembly)]`.
pub trait Element {}

/// A type made by `#[derive(Assembly)]`.
pub trait Assembly {
    /// Tells descriptions apart.
    const FINGERPRINT: u64;

    /// A parameter or an input by its number, in the order of the fields and of those of parts.
    fn value(&self, number: usize) -> f64;
}

/// A constant that an assembly names by its path, by the fingerprint of that.
pub trait ConstantOf<const FINGERPRINT: u64> {
    /// Its value.
    const VALUE: f64;
}

/// A spline that an assembly names by its path, by the fingerprint of that.
pub trait TableOf<const FINGERPRINT: u64> {
    /// Its table.
    const TABLE: Table<'static>;
}

/// The type of a field of an assembly, of an element if it is an array, by its number.
pub trait FieldOf<const NUMBER: usize> {
    /// The type.
    type Type;
}

/// A body, a joint, a force or an assembly: what the fields of a mechanism are.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is neither a body nor a joint, a force or an assembly",
    label = "described as a body, a joint, a force or a part",
    note = "a body is a `Body` or a `Particle`; a joint is one of `holonom::joints`, or defined with `holonom::joint!`; a force is one of `holonom::forces`, or defined with `holonom::force!`; an assembly is a struct with `#[derive(Assembly)]`"
)]
pub trait Part {}

#[diagnostic::do_not_recommend]
impl Part for crate::Body {}

#[diagnostic::do_not_recommend]
impl Part for crate::Particle {}

#[diagnostic::do_not_recommend]
impl<E: Element> Part for E {}

/// Asks whether a type is a body, a joint, a force or an assembly.
pub const fn part<T: Part>() {}

/// In a stub, the type of a field that is described as a joint and is none: it may be used like any
/// joint.
#[derive(Clone, Copy, Debug)]
pub struct AnyJoint;

impl crate::mechanism::Joint for AnyJoint {
    const NAME: &'static str = "";
    const EQUATIONS: usize = 0;
    const BODIES: usize = 0;
    const FINGERPRINT: u64 = 0;
}

impl crate::mechanism::HasAngle for AnyJoint {}
impl crate::mechanism::HasTwoAngles for AnyJoint {}

impl crate::mechanism::HasDisplacement for AnyJoint {}

impl crate::mechanism::HasContact for AnyJoint {}

impl crate::mechanism::Driven for AnyJoint {
    const ROW: usize = 0;
}
