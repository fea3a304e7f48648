//! Orientations as three angles, with the conventions of the words of `orientation`.
//!
//! Any three angles are singular somewhere (gimbal lock): there the first and the third turn about
//! one axis, and only their sum or difference is known. Such a reading is refused, and no angle is
//! made up. A program that goes on regardless takes the pose.

use nalgebra::Quaternion;

use crate::error::{AngleSet, Fault, ReadingFault, StepFault};
use crate::math::angles::{Angles, of_turns, rpy, xyz, zxz};
use crate::math::quaternion::{conjugate, product};
use crate::math::scalar::Real;
use crate::math::vec3::{read, square};
use crate::measure::access::MechanismExt as _;
use crate::measure::view::View;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// Whether the first and the third angle are known: to half of the digits of the numbers, at least.
fn is_regular<S: Real>((_, sine): &Angles<S>) -> bool {
    is_apart(*sine)
}

/// The same by the sine between the first and the third axis.
pub(super) fn is_apart<S: Real>(sine: S) -> bool {
    sine > S::EPSILON.sqrt()
}

/// Scalar first.
fn parameters<S: Real>(orientation: &Quaternion<S>) -> [S; 4] {
    let [x, y, z, w] = orientation.coords.into();
    [w, x, y, z]
}

/// Three numbers with names, from an array and as one.
macro_rules! as_array {
    ($name:ident: $($field:ident),*) => {
        impl<S> From<[S; 3]> for $name<S> {
            fn from([$($field),*]: [S; 3]) -> Self {
                Self { $($field),* }
            }
        }

        impl<S> From<$name<S>> for [S; 3] {
            fn from(numbers: $name<S>) -> Self {
                let $name { $($field),* } = numbers;
                [$($field),*]
            }
        }
    };
}
pub(super) use as_array;

macro_rules! angles {
    (
        $(#[$about:meta])*
        $name:ident, $read:ident, $singular:literal;
        $($(#[$field_about:meta])* $field:ident),*; $turns:tt
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<S> {
            $($(#[$field_about])* pub $field: S,)*
        }

        impl<S: Real> $name<S> {
            /// The angles of an orientation: a quaternion from body axes to the axes that it is
            /// measured against, of any length but zero.
            #[doc = concat!("`None` where ", $singular, " is below the square root of the")]
            /// resolution of the numbers (1.5e-8 in `f64`, 3.5e-4 in `f32`): the first and the
            /// third angle have lost half of their digits there. `None` too for a quaternion that
            /// is zero or not finite.
            #[must_use]
            pub fn of(orientation: &Quaternion<S>) -> Option<Self> {
                let angles = $read(&parameters(orientation));
                is_regular(&angles).then(|| angles.0.into())
            }

            /// The unit quaternion of these angles, from body axes to the axes that they are
            /// measured against.
            #[must_use]
            pub fn orientation(&self) -> Quaternion<S> {
                let Self { $($field),* } = *self;
                let [e0, e1, e2, e3] = of_turns($turns);
                Quaternion::new(e0, e1, e2, e3)
            }
        }

        as_array! { $name: $($field),* }
    };
}

angles! {
    /// Euler angles, z-x-z: the body's axes are turned about z by the precession, then about the
    /// new x by the nutation, then about the new z by the spin. The rotation from body axes is
    /// `A = Z(precession) X(nutation) Z(spin)`, as by `orientation = euler_zxz(..)`.
    ///
    /// They are singular where both z axes are parallel: in the reference configuration of most
    /// mechanisms. Flores, *Concepts and Formulations for Spatial Multibody Dynamics* (2015), its
    /// chapter on Euler angles, Bryant angles and Euler parameters.
    EulerAngles, zxz, "the sine of the nutation";
    /// About z (rad), from `-pi` to `pi`.
    precession,
    /// About the line of nodes, the new x (rad), from 0 to `pi`.
    nutation,
    /// About the body's z (rad), from `-pi` to `pi`.
    spin;
    [(2, precession), (0, nutation), (2, spin)]
}

angles! {
    /// Bryant angles, x-y-z, also called Cardan angles: the body's axes are turned about x by the
    /// first angle, then about the new y by the second, then about the new z by the third. The
    /// rotation from body axes is `A = X(first) Y(second) Z(third)`, as by
    /// `orientation = bryant_xyz(..)`.
    ///
    /// They are singular where the body's z axis is parallel to x. Flores, *Concepts and
    /// Formulations for Spatial Multibody Dynamics* (2015), its chapter on Euler angles, Bryant
    /// angles and Euler parameters.
    BryantAngles, xyz, "the cosine of the second angle";
    /// About x (rad), from `-pi` to `pi`.
    first,
    /// About the new y (rad), from `-pi / 2` to `pi / 2`.
    second,
    /// About the body's z (rad), from `-pi` to `pi`.
    third;
    [(0, first), (1, second), (2, third)]
}

angles! {
    /// Roll, pitch and yaw, as in URDF: turns about the fixed axes x, then y, then z. The rotation
    /// from body axes is `A = Z(yaw) Y(pitch) X(roll)`, as by `orientation = rpy(..)`.
    ///
    /// They are singular where the body's x axis is parallel to z.
    RollPitchYaw, rpy, "the cosine of the pitch";
    /// About x (rad), from `-pi` to `pi`.
    roll,
    /// About y (rad), from `-pi / 2` to `pi / 2`.
    pitch,
    /// About z (rad), from `-pi` to `pi`.
    yaw;
    [(2, yaw), (1, pitch), (0, roll)]
}

/// Orientations as three angles, from the user's body axes to global axes, or to those of another
/// body. A particle has the global axes.
///
/// All of these are refused, and return no angle, with [`ReadingFault::SingularAngles`] where the
/// first and the third angle turn about one axis, to half of the digits of the numbers: see
/// [`EulerAngles::of`](crate::measure::EulerAngles::of). [`StepFault::StateNotFinite`] and
/// [`StepFault::ZeroOrientation`] where the state holds no orientation.
impl<S: Real, M: Mechanism, K: core::borrow::Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// The orientation of a body against another: the unit quaternion from the user's axes of
    /// `body` to the user's axes of `base`.
    #[must_use]
    pub fn relative_orientation(&self, body: BodyHandle<M>, base: BodyHandle<M>) -> Quaternion<S> {
        let [e0, e1, e2, e3] = self.against(body, Some(base));
        Quaternion::new(e0, e1, e2, e3)
    }

    /// Euler angles (rad) of a body, z-x-z, against global axes.
    ///
    /// # Errors
    /// [`ReadingFault::SingularAngles`] where the body's z axis is parallel to the global one;
    /// [`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`].
    pub fn euler_angles(&self, body: BodyHandle<M>) -> Result<EulerAngles<S>, Fault> {
        self.regular_angles(body, None, AngleSet::EulerZxz)
    }

    /// Euler angles (rad) of a body, z-x-z, against the axes of another body.
    ///
    /// # Errors
    /// As [`View::euler_angles`].
    pub fn relative_euler_angles(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<EulerAngles<S>, Fault> {
        self.regular_angles(body, Some(base), AngleSet::EulerZxz)
    }

    /// Bryant angles (rad) of a body, x-y-z, against global axes.
    ///
    /// # Errors
    /// [`ReadingFault::SingularAngles`] where the body's z axis is parallel to the global x axis;
    /// [`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`].
    pub fn bryant_angles(&self, body: BodyHandle<M>) -> Result<BryantAngles<S>, Fault> {
        self.regular_angles(body, None, AngleSet::BryantXyz)
    }

    /// Bryant angles (rad) of a body, x-y-z, against the axes of another body.
    ///
    /// # Errors
    /// As [`View::bryant_angles`].
    pub fn relative_bryant_angles(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<BryantAngles<S>, Fault> {
        self.regular_angles(body, Some(base), AngleSet::BryantXyz)
    }

    /// Roll, pitch and yaw (rad) of a body, against global axes.
    ///
    /// # Errors
    /// [`ReadingFault::SingularAngles`] where the body's x axis is parallel to the global z axis;
    /// [`StepFault::StateNotFinite`], [`StepFault::ZeroOrientation`].
    pub fn roll_pitch_yaw(&self, body: BodyHandle<M>) -> Result<RollPitchYaw<S>, Fault> {
        self.regular_angles(body, None, AngleSet::RollPitchYaw)
    }

    /// Roll, pitch and yaw (rad) of a body, against the axes of another body.
    ///
    /// # Errors
    /// As [`View::roll_pitch_yaw`].
    pub fn relative_roll_pitch_yaw(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<RollPitchYaw<S>, Fault> {
        self.regular_angles(body, Some(base), AngleSet::RollPitchYaw)
    }

    fn regular_angles<A: From<[S; 3]>>(
        &self,
        body: BodyHandle<M>,
        base: Option<BodyHandle<M>>,
        angles: AngleSet,
    ) -> Result<A, Fault> {
        for body in [Some(body), base].into_iter().flatten() {
            self.check_orientation(body)?;
        }
        let found = read_as(angles, &self.against(body, base));
        if !is_regular(&found) {
            let body = body.name();
            return Err(Fault::Reading(ReadingFault::SingularAngles {
                body,
                angles,
            }));
        }
        Ok(found.0.into())
    }

    /// Angles of a body against global axes, of which the first and the third are `None` where
    /// they are singular.
    #[cfg(feature = "recorder")]
    pub(crate) fn known_angles(&self, body: BodyHandle<M>, angles: AngleSet) -> [Option<S>; 3] {
        let found = read_as(angles, &self.against(body, None));
        let [first, second, third] = found.0.map(Some);
        if is_regular(&found) {
            [first, second, third]
        } else {
            [None, second, None]
        }
    }

    /// Euler parameters from the user's axes of a body to global axes, or to those of another body.
    fn against(&self, body: BodyHandle<M>, base: Option<BodyHandle<M>>) -> [S; 4] {
        let p = M::orientation(self.state(), body);
        base.map_or(p, |base| {
            product(&conjugate(&M::orientation(self.state(), base)), &p)
        })
    }

    fn check_orientation(&self, body: BodyHandle<M>) -> Result<(), Fault> {
        let Some((_, place)) = body.orientation() else {
            return Ok(());
        };
        let p: [S; 4] = read(self.state().coordinates().as_slice(), place);
        let square = square(&p);
        if !square.is_finite() {
            return Err(Fault::Step(StepFault::StateNotFinite));
        }
        if square == S::zero() {
            let body = body.name();
            return Err(Fault::Step(StepFault::ZeroOrientation { body }));
        }
        Ok(())
    }
}

fn read_as<S: Real>(angles: AngleSet, p: &[S; 4]) -> Angles<S> {
    match angles {
        AngleSet::EulerZxz => zxz(p),
        AngleSet::BryantXyz => xyz(p),
        AngleSet::RollPitchYaw => rpy(p),
    }
}
