//! What generated code may call. Not an interface: it changes with every release.

pub use holonom_macros::{assemble, joint_impl};

use crate::scalar::elementary;

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

/// Defines a joint: a constraint between bodies, symbolically, so that mechanisms in any crate can use it.
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
/// In the parentheses stand the names of the bodies, then the parameters with their kinds; a mechanism gives the
/// parameters as attributes of the same names. In the braces stand expressions that are zero, each with a `;`: a scalar
/// gives one equation, a vector three, two vectors or two scalars (see `normals`) twice as many.
///
/// | kind | what a mechanism gives | on a body |
/// |---|---|---|
/// | `Point` | a point in global axes at the initial configuration, or `local(..)`: one for each body from its centre of mass in its own axes | `i.name`: the point fixed on `i`, as it moves |
/// | `Axis` | a direction, likewise; any length but zero, used as a unit vector | `i.name`: the unit vector fixed on `i`; `i.name.normals()`: two unit vectors on `i` perpendicular to it |
/// | `Vector` | a vector, likewise | `i.name` |
/// | `Length`, `Angle`, `Number` | a number (m, rad, 1) | the same for all bodies: `name` |
///
/// Also: `i.origin`, the centre of mass; `a + b`, `a - b`, `-a`; `x * a` for scalars and vectors; `dot(a, b)`;
/// `cross(a, b)`; `squared(a)`, the square of a vector's length. `angle about axis;` gives the joint an angle: that of the
/// second body against the first, right-handed about the axis, zero in the described configuration. A joint connects one
/// or more bodies; the `ground` of a mechanism may be any of them.
///
/// Points are in m and vectors in the unit they are given in; the joint's reaction is `-D^T lambda`, whatever the units of its
/// equations are.
#[macro_export]
macro_rules! joint {
    ($($definition:tt)*) => {
        $crate::__private::joint_impl! { [$crate] $($definition)* }
    };
}

/// A body or a joint: what the fields of a mechanism are.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is neither a body nor a joint",
    label = "described as a body or a joint",
    note = "a body is a `Body` or a `Particle`; a joint is one of `holonom::joints`, or defined with `holonom::joint!`"
)]
pub trait Part {}

#[diagnostic::do_not_recommend]
impl Part for crate::Body {}

#[diagnostic::do_not_recommend]
impl Part for crate::Particle {}

#[diagnostic::do_not_recommend]
impl<J: crate::Joint> Part for J {}

/// Asks whether a type is a body or a joint.
pub const fn part<T: Part>() {}

/// In a stub, the type of a field that is described as a joint and is none: it may be used like any joint.
#[derive(Clone, Copy, Debug)]
pub struct AnyJoint;

impl crate::Joint for AnyJoint {
    const NAME: &'static str = "";
    const EQUATIONS: usize = 0;
    const BODIES: usize = 0;
    const FINGERPRINT: u64 = 0;
}

impl crate::HasAngle for AnyJoint {}

impl crate::HasDisplacement for AnyJoint {}

impl crate::Driven for AnyJoint {
    const ROW: usize = 0;
}

/// The stub of a mechanism whose description has faults: it keeps further errors away and is never run.
#[doc(hidden)]
#[macro_export]
macro_rules! __stub_mechanism {
    (@handle body) => { $crate::BodyHandle<__M> };
    (@handle joint) => { $crate::JointHandle<__M, $crate::__private::AnyJoint> };
    (@handle joint $path:path) => { $crate::JointHandle<__M, $path> };
    (@value body) => { $crate::BodyHandle::new(0) };
    (@value joint $($path:path)?) => { $crate::JointHandle::new(0) };
    (
        [$($declared:tt)*] [$mechanism:ty] [$($bounds:tt)*]
        $($field:ident: $kind:ident $($path:path)?,)*
    ) => {
        #[allow(warnings, clippy::all, clippy::pedantic)]
        const _: () = {
            pub struct __Handles<__M> {
                $(pub $field: $crate::__stub_mechanism!(@handle $kind $($path)?),)*
                __mechanism: ::core::marker::PhantomData<fn() -> __M>,
            }
            impl<__M> ::core::clone::Clone for __Handles<__M> {
                fn clone(&self) -> Self { *self }
            }
            impl<__M> ::core::marker::Copy for __Handles<__M> {}
            impl<__M> ::core::fmt::Debug for __Handles<__M> {
                fn fmt(&self, _: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result { loop {} }
            }
            impl $($declared)* $crate::Mechanism for $mechanism
            where
                $mechanism: 'static,
                $($bounds)*
            {
                type State<__S: $crate::Scalar> = $crate::State<__S, 0, 0>;
                type Velocities<__S: $crate::Scalar> = [__S; 0];
                type Multipliers<__S: $crate::Scalar> = [__S; 0];
                type Jacobian<__S: $crate::Scalar> = [__S; 0];
                type Parameters<__S: $crate::Scalar> = ();
                type Constants<__S: $crate::Scalar> = [__S; 0];
                type Coefficients<__S: $crate::Scalar> = [__S; 0];
                type Factors<__S: $crate::Scalar> = [__S; 0];
                type Handles = __Handles<Self>;
                const HANDLES: __Handles<Self> = __Handles {
                    $($field: $crate::__stub_mechanism!(@value $kind $($path)?),)*
                    __mechanism: ::core::marker::PhantomData,
                };
                const REPORT: $crate::Report = $crate::Report {
                    name: "",
                    bodies: &[],
                    joints: &[],
                    blocks: &[],
                    coordinates: 0,
                    velocities: 0,
                    equations: 0,
                    degrees_of_freedom: 0,
                    kernels: &[],
                    plan: "",
                };
                fn parameters<__S: $crate::Scalar>(&self) {}
                fn prepare<__S: $crate::Scalar>(_: &()) -> ::core::result::Result<[__S; 0], $crate::ParameterError> { loop {} }
                fn coefficients<__S: $crate::Scalar>(_: &[__S; 0], _: &$crate::Stabilisation<__S>) -> [__S; 0] { [] }
                fn initial_state<__S: $crate::Scalar>(_: &[__S; 0]) -> Self::State<__S> { loop {} }
                fn constraints<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn constraint_rates<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn jacobian<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn gamma<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn mass<__S: $crate::Scalar>(_: &[__S; 0]) -> [__S; 0] { [] }
                fn forces<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> [__S; 0] { [] }
                fn kinetic_energy<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>) -> __S { loop {} }
                fn potential_energy<__S: $crate::Scalar>(_: &[__S; 0], _: __S, _: &Self::State<__S>) -> __S { loop {} }
                fn coordinate_rates<__S: $crate::Scalar>(_: &Self::State<__S>) -> [__S; 0] { [] }
                fn evaluate<__S: $crate::Scalar, __T: $crate::Terms, __P: $crate::Orientation>(
                    _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::State<__S>,
                ) -> $crate::Evaluation<__S, Self> { loop {} }
                fn factor<__S: $crate::Scalar, __T: $crate::Terms>(
                    _: &[__S; 0], _: &[__S; 0], _: __S, _: &Self::State<__S>,
                ) -> ([__S; 0], $crate::Pivot<__S>) { loop {} }
                fn solve<__S: $crate::Scalar, __T: $crate::Terms>(
                    _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0], _: &[__S; 0],
                ) -> ([__S; 0], [__S; 0]) { ([], []) }
                fn joint_angle<__S: $crate::Scalar>(_: &[__S; 0], _: &Self::State<__S>, _: usize) -> $crate::AngleParts<__S> { loop {} }
                fn joint_point<__S: $crate::Scalar>(_: &[__S; 0], _: usize, _: usize) -> [__S; 3] { loop {} }
                fn user_axes(_: usize) -> [f64; 4] { [1.0, 0.0, 0.0, 0.0] }
            }
            impl $($declared)* ::core::default::Default for $mechanism
            where
                $($bounds)*
            {
                fn default() -> Self { loop {} }
            }
        };
    };
}
