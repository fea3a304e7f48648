//! Rates of the three angles of an orientation, singular where the angles are.
//!
//! The angular velocity is the sum of three turns: the rate of each angle about its axis. The
//! second axis is perpendicular to both others, so its rate is a component. Across it the third
//! rate counts with the sine between the first and the third axis, which must not be zero. What
//! remains along the first axis is the first rate. Flores, *Concepts and Formulations for Spatial
//! Multibody Dynamics* (2015), its chapter on angular velocity.

use nalgebra::Vector3;

use crate::error::{AngleSet, Fault, ReadingFault, StepFault};
use crate::math::quaternion::rotate_back;
use crate::math::scalar::Real;
use crate::math::vec3::minus;
use crate::measure::access::MechanismExt as _;
use crate::measure::angles::{BryantAngles, EulerAngles, RollPitchYaw, as_array, is_apart};
use crate::measure::view::View;
use crate::mechanism::handle::BodyHandle;
use crate::mechanism::kernels::Mechanism;

macro_rules! rates {
    (
        $(#[$about:meta])*
        $name:ident of $angles:ident, sets $set:ident, $singular:literal;
        $($(#[$field_about:meta])* $field:ident),*
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub struct $name<S> {
            $($(#[$field_about])* pub $field: S,)*
        }

        impl<S: Real> $angles<S> {
            /// The rates (rad/s) of these angles, from the angular velocity (rad/s) against the
            /// axes that they are measured against, and along these axes.
            #[doc = concat!("`None` where ", $singular, " is below the square root of the")]
            /// resolution of the numbers, as for the angles themselves, or where a rate would not
            /// be finite.
            #[must_use]
            pub fn rates(&self, angular_velocity: &Vector3<S>) -> Option<$name<S>> {
                let Self { $($field),* } = *self;
                let rates = rates(AngleSet::$set, [$($field),*], (*angular_velocity).into())?;
                Some(rates.into())
            }

            /// The angular velocity (rad/s) that these rates are, against and along the axes that
            /// the angles are measured against.
            #[must_use]
            pub fn angular_velocity(&self, rates: &$name<S>) -> Vector3<S> {
                let Self { $($field),* } = *self;
                turning(AngleSet::$set, [$($field),*], (*rates).into()).into()
            }
        }

        as_array! { $name: $($field),* }
    };
}

rates! {
    /// Rates of [`EulerAngles`]: `w = precession' z + nutation' n + spin' k`, with the line of
    /// nodes `n` and the body's z axis `k`.
    EulerAngleRates of EulerAngles, sets EulerZxz, "the sine of the nutation";
    /// About z (rad/s).
    precession,
    /// About the line of nodes (rad/s).
    nutation,
    /// About the body's z (rad/s).
    spin
}

rates! {
    /// Rates of [`BryantAngles`].
    BryantAngleRates of BryantAngles, sets BryantXyz, "the cosine of the second angle";
    /// About x (rad/s).
    first,
    /// About the new y (rad/s).
    second,
    /// About the body's z (rad/s).
    third
}

rates! {
    /// Rates of [`RollPitchYaw`].
    RollPitchYawRates of RollPitchYaw, sets RollPitchYaw, "the cosine of the pitch";
    /// About the body's x (rad/s).
    roll,
    /// About the y axis that yaw has turned (rad/s).
    pitch,
    /// About z (rad/s).
    yaw
}

/// The sine and cosine of an angle.
type Turn<S> = [S; 2];

/// The turn of the outer angle, by which the axes of the others are turned, and how far apart the
/// outer and the inner axis are.
struct Axes<S> {
    /// The outer angle.
    outer: Turn<S>,
    /// The sine between the outer and the inner axis, from 0 to 1.
    apart: S,
    /// The cosine between them.
    along: S,
}

fn turn<S: Real>(angle: S) -> Turn<S> {
    [angle.sin(), angle.cos()]
}

/// The angles by the turns that they are, the outer first.
fn axes<S: Real>(set: AngleSet, [first, second, third]: [S; 3]) -> Axes<S> {
    let [sine, cosine] = turn(second);
    let (outer, apart, along) = match set {
        AngleSet::EulerZxz => (first, sine, cosine),
        AngleSet::BryantXyz => (first, cosine, sine),
        AngleSet::RollPitchYaw => (third, cosine, -sine),
    };
    let outer = turn(outer);
    Axes {
        outer,
        apart,
        along,
    }
}

/// Components along the outer axis, along the second axis, and along what is perpendicular to both,
/// on the side of the inner axis.
fn components<S: Real>(set: AngleSet, [sine, cosine]: Turn<S>, [x, y, z]: [S; 3]) -> [S; 3] {
    match set {
        AngleSet::EulerZxz => [z, x * cosine + y * sine, x * sine - y * cosine],
        AngleSet::BryantXyz => [x, y * cosine + z * sine, z * cosine - y * sine],
        AngleSet::RollPitchYaw => [z, y * cosine - x * sine, x * cosine + y * sine],
    }
}

/// The vector of these components.
fn vector<S: Real>(
    set: AngleSet,
    [sine, cosine]: Turn<S>,
    [outer, second, side]: [S; 3],
) -> [S; 3] {
    match set {
        AngleSet::EulerZxz => [
            second * cosine + side * sine,
            second * sine - side * cosine,
            outer,
        ],
        AngleSet::BryantXyz => [
            outer,
            second * cosine - side * sine,
            second * sine + side * cosine,
        ],
        AngleSet::RollPitchYaw => [
            side * cosine - second * sine,
            second * cosine + side * sine,
            outer,
        ],
    }
}

/// Rates in the order of the angles, from an angular velocity.
fn rates<S: Real>(set: AngleSet, angles: [S; 3], turning: [S; 3]) -> Option<[S; 3]> {
    let axes = axes(set, angles);
    if !is_apart(axes.apart) {
        return None;
    }
    let [outer, second, side] = components(set, axes.outer, turning);
    let inner = side.quotient(axes.apart);
    let outer = outer - inner * axes.along;
    let rates = in_order(set, [outer, second, inner]);
    rates.iter().all(|rate| rate.is_finite()).then_some(rates)
}

/// The angular velocity of rates in the order of the angles.
fn turning<S: Real>(set: AngleSet, angles: [S; 3], rates: [S; 3]) -> [S; 3] {
    let axes = axes(set, angles);
    let [outer, second, inner] = in_order(set, rates);
    let along = outer + inner * axes.along;
    vector(set, axes.outer, [along, second, inner * axes.apart])
}

/// From the outer, second and inner turn to the order of the fields, and back.
fn in_order<S>(set: AngleSet, [outer, second, inner]: [S; 3]) -> [S; 3] {
    match set {
        AngleSet::EulerZxz | AngleSet::BryantXyz => [outer, second, inner],
        AngleSet::RollPitchYaw => [inner, second, outer],
    }
}

/// Why there are no rates of angles that are regular: by rounding of the second angle, they are
/// singular after all, or the state is not finite.
fn no_rates<S: Real, M: Mechanism>(
    body: BodyHandle<M>,
    angles: AngleSet,
    turning: &Vector3<S>,
) -> Fault {
    let body = body.name();
    if turning.iter().all(|component| component.is_finite()) {
        Fault::Reading(ReadingFault::SingularAngles { body, angles })
    } else {
        Fault::Step(StepFault::StateNotFinite)
    }
}

/// Rates (rad/s) of the angles of an orientation, against global axes or those of another body.
///
/// All are refused where the angles are. That is [`ReadingFault::SingularAngles`] where the first
/// and the third turn about one axis, and [`StepFault::ZeroOrientation`] where the state holds no
/// orientation. Beside that, [`StepFault::StateNotFinite`] where a rate would not be finite.
impl<S: Real, M: Mechanism, K: core::borrow::Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// Rates (rad/s) of [`View::euler_angles`].
    ///
    /// # Errors
    /// As [`View::euler_angles`]; [`StepFault::StateNotFinite`] for a rate too.
    pub fn euler_angle_rates(&self, body: BodyHandle<M>) -> Result<EulerAngleRates<S>, Fault> {
        let angles = self.euler_angles(body)?;
        let turning = self.turning(body, None);
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::EulerZxz, &turning))
    }

    /// Rates (rad/s) of [`View::relative_euler_angles`].
    ///
    /// # Errors
    /// As [`View::euler_angle_rates`].
    pub fn relative_euler_angle_rates(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<EulerAngleRates<S>, Fault> {
        let angles = self.relative_euler_angles(body, base)?;
        let turning = self.turning(body, Some(base));
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::EulerZxz, &turning))
    }

    /// Rates (rad/s) of [`View::bryant_angles`].
    ///
    /// # Errors
    /// As [`View::bryant_angles`]; [`StepFault::StateNotFinite`] for a rate too.
    pub fn bryant_angle_rates(&self, body: BodyHandle<M>) -> Result<BryantAngleRates<S>, Fault> {
        let angles = self.bryant_angles(body)?;
        let turning = self.turning(body, None);
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::BryantXyz, &turning))
    }

    /// Rates (rad/s) of [`View::relative_bryant_angles`].
    ///
    /// # Errors
    /// As [`View::bryant_angle_rates`].
    pub fn relative_bryant_angle_rates(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<BryantAngleRates<S>, Fault> {
        let angles = self.relative_bryant_angles(body, base)?;
        let turning = self.turning(body, Some(base));
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::BryantXyz, &turning))
    }

    /// Rates (rad/s) of [`View::roll_pitch_yaw`].
    ///
    /// # Errors
    /// As [`View::roll_pitch_yaw`]; [`StepFault::StateNotFinite`] for a rate too.
    pub fn roll_pitch_yaw_rates(&self, body: BodyHandle<M>) -> Result<RollPitchYawRates<S>, Fault> {
        let angles = self.roll_pitch_yaw(body)?;
        let turning = self.turning(body, None);
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::RollPitchYaw, &turning))
    }

    /// Rates (rad/s) of [`View::relative_roll_pitch_yaw`].
    ///
    /// # Errors
    /// As [`View::roll_pitch_yaw_rates`].
    pub fn relative_roll_pitch_yaw_rates(
        &self,
        body: BodyHandle<M>,
        base: BodyHandle<M>,
    ) -> Result<RollPitchYawRates<S>, Fault> {
        let angles = self.relative_roll_pitch_yaw(body, base)?;
        let turning = self.turning(body, Some(base));
        let rates = angles.rates(&turning);
        rates.ok_or_else(|| no_rates(body, AngleSet::RollPitchYaw, &turning))
    }

    /// The angular velocity of a body (rad/s), global; or against another body, along its axes.
    fn turning(&self, body: BodyHandle<M>, base: Option<BodyHandle<M>>) -> Vector3<S> {
        let own = M::angular_velocity_global(self.state(), body);
        let Some(base) = base else { return own };
        let against = M::angular_velocity_global(self.state(), base);
        let difference = minus(&own.into(), &against.into());
        rotate_back(&M::orientation(self.state(), base), &difference).into()
    }
}
