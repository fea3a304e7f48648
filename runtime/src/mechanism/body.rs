//! Bodies, as types of a mechanism's fields.
//!
//! Each is a type and a macro of one name: the macro carries the kind of the body to where the
//! mechanism is put together.

/// A rigid body with position and orientation: 7 coordinates, 6 velocities.
///
/// Described by `#[body(..)]` above the field:
///
/// | attribute | meaning | unit, axes | default |
/// |---|---|---|---|
/// | `mass` | mass | kg | required |
/// | `inertia` | three principal moments, or the full symmetric tensor as three rows | kg m^2, about the centre of mass, the user's body axes | required |
/// | `position` | centre of mass at the start | m, global | origin |
/// | `orientation` | body axes at the start: four Euler parameters (scalar first, of any length), or `rotation(axis, angle)` | from body to global axes | global axes |
/// | `velocity` | velocity of the centre of mass at the start | m/s, global | at rest |
/// | `angular_velocity` | angular velocity at the start | rad/s, body axes | at rest |
/// | `free` | the body may go without a joint | - | - |
#[doc(alias("RigidBody", "Rigid", "Link", "Solid"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Body;

/// A point mass without orientation: 3 coordinates, 3 velocities.
///
/// Described by `#[body(..)]` with `mass`, `position`, `velocity` and `free` as for a [`Body`].
/// Joints may hold it at its own position only.
#[doc(alias("PointMass", "Mass"))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Particle;

macro_rules! carrier {
    ($dollar:tt $name:ident, $kind:ident, $type:ident, $message:literal) => {
        #[doc(hidden)]
        #[macro_export]
        macro_rules! $name {
            (@holonom1 [] [$dollar($dollar definitions:tt)*] $dollar payload:tt) => {
                $dollar crate::__private::assemble! {
                    [$dollar crate] [$dollar($dollar definitions)* [$kind]] $dollar payload
                }
            };
            (
                @holonom1 [[$dollar($dollar next:tt)+] $dollar($dollar rest:tt)*]
                [$dollar($dollar definitions:tt)*] $dollar payload:tt
            ) => {
                const _: () = $dollar crate::__private::part::<$dollar($dollar next)+>();
                $dollar($dollar next)+ ! {
                    @holonom1 [$dollar($dollar rest)*] [$dollar($dollar definitions)* [$kind]] $dollar payload
                }
            };
            (@ $dollar($dollar other:tt)*) => {
                ::core::compile_error! {
                    "bodies and joints come from different versions of holonom; use one version throughout"
                }
            };
            ($dollar($dollar other:tt)*) => {
                ::core::compile_error! { $message }
            };
        }
        #[doc(hidden)]
        pub use $name as $type;
    };
}

carrier! { $ __holonom_body, body, Body, "`Body` is a type: name it as the type of a field in a struct with `#[derive(Mechanism)]`" }
carrier! { $ __holonom_particle, particle, Particle, "`Particle` is a type: name it as the type of a field in a struct with `#[derive(Mechanism)]`" }
