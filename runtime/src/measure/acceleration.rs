//! Accelerations by handle, from the rates of a state.

use core::borrow::Borrow;

use nalgebra::Vector3;

use crate::forward::{Forward, lifted};
use crate::math::quaternion::{rotate, rotate_back};
use crate::math::scalar::Scalar;
use crate::math::vec3::{cross, read};
use crate::measure::access::MechanismExt;
use crate::measure::view::View;
use crate::mechanism::handle::{BodyHandle, HasAngle, HasDisplacement, HasTwoAngles, JointHandle};
use crate::mechanism::kernels::Mechanism;
use crate::state::vector::{Array, StateParts};

/// A number that carries its derivative with time.
type Moving<S> = Forward<S, 1>;

/// Accelerations take the rates of the state, `(q', u')`, which an evaluation gives
/// ([`Evaluation::rates`](crate::mechanism::Evaluation::rates)). A [`Sample`](crate::Sample) has
/// them by itself.
impl<S: Scalar, M: Mechanism, K: Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// The angular acceleration (rad/s^2) along the user's body axes: the rate of
    /// [`View::angular_velocity`]. Zero for a particle.
    #[must_use]
    pub fn angular_acceleration(&self, rates: &M::State<S>, body: BodyHandle<M>) -> Vector3<S> {
        let Some((info, _)) = body.orientation() else {
            return Vector3::from([S::zero(); 3]);
        };
        let principal = read(rates.velocities().as_slice(), info.velocity + 3);
        let axes = M::user_axes(body.index()).map(S::constant);
        Vector3::from(rotate_back(&axes, &principal))
    }

    /// The angular acceleration (rad/s^2) along the global axes: the rate of
    /// [`View::angular_velocity_global`].
    #[must_use]
    pub fn angular_acceleration_global(
        &self,
        rates: &M::State<S>,
        body: BodyHandle<M>,
    ) -> Vector3<S> {
        let along_body = self.angular_acceleration(rates, body).into();
        let orientation = M::orientation(self.state(), body);
        Vector3::from(rotate(&orientation, &along_body))
    }

    /// The acceleration of a point of a body (m/s^2, global), given as in [`View::point`]: with the
    /// centripetal part.
    #[must_use]
    pub fn point_acceleration(
        &self,
        rates: &M::State<S>,
        body: BodyHandle<M>,
        point: Vector3<S>,
    ) -> Vector3<S> {
        let arm = rotate(&M::orientation(self.state(), body), &point.into());
        let spin = self.angular_velocity_global(body).into();
        let turning = self.angular_acceleration_global(rates, body).into();
        let [ax, ay, az] = self.acceleration(rates, body).into();
        let [tx, ty, tz] = cross(&turning, &arm);
        let [cx, cy, cz] = cross(&spin, &cross(&spin, &arm));
        Vector3::new(ax + tx + cx, ay + ty + cy, az + tz + cz)
    }

    /// The acceleration of the angle of a joint (rad/s^2), with the sign of [`View::angle`]: the
    /// rate of [`View::angle_rate`], exact to round-off.
    #[must_use]
    pub fn angle_acceleration<J: HasAngle>(
        &self,
        rates: &M::State<S>,
        joint: JointHandle<M, J>,
    ) -> S {
        let (constants, state) = self.moving(rates);
        let parts = M::joint_angle(&constants, &state, joint.index());
        let [acceleration] = parts.rate.derivatives();
        acceleration
    }

    /// The accelerations of both angles of a joint (rad/s^2), with the signs of [`View::angles`].
    #[must_use]
    pub fn angle_accelerations<J: HasTwoAngles>(
        &self,
        rates: &M::State<S>,
        joint: JointHandle<M, J>,
    ) -> [S; 2] {
        let (constants, state) = self.moving(rates);
        M::joint_angles(&constants, &state, joint.index()).map(|parts| {
            let [acceleration] = parts.rate.derivatives();
            acceleration
        })
    }

    /// The acceleration of the displacement of a joint (m/s^2), with the sign of
    /// [`View::displacement`].
    #[must_use]
    pub fn displacement_acceleration<J: HasDisplacement>(
        &self,
        rates: &M::State<S>,
        joint: JointHandle<M, J>,
    ) -> S {
        let (constants, state) = self.moving(rates);
        let time = Forward::new(self.time(), [S::one()]);
        let parts = M::joint_displacement(&constants, time, &state, joint.index());
        let [acceleration] = parts.rate.derivatives();
        acceleration
    }

    /// Constants, and the state as it moves at these rates.
    fn moving(&self, rates: &M::State<S>) -> (M::Constants<Moving<S>>, M::State<Moving<S>>) {
        let state = M::State::from_parts(
            moving(self.state().coordinates(), rates.coordinates()),
            moving(self.state().velocities(), rates.velocities()),
        );
        (lifted(self.constants()), state)
    }
}

/// Numbers with their rates.
fn moving<S: Scalar, A: Array<S>, B: Array<Moving<S>>>(numbers: &A, rates: &A) -> B {
    let mut moving = B::zeros();
    let pairs = numbers.as_slice().iter().zip(rates.as_slice());
    for (place, (&number, &rate)) in moving.as_mut_slice().iter_mut().zip(pairs) {
        *place = Forward::new(number, [rate]);
    }
    moving
}
