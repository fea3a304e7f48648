//! Positions, velocities and accelerations of bodies and of named points.

use core::borrow::Borrow;

use nalgebra::Vector3;

use crate::math::scalar::Scalar;
use crate::math::vec3::{cross, plus, read};
use crate::measure::access::MechanismExt;
use crate::measure::reaction::in_global_axes;
use crate::measure::view::View;
use crate::mechanism::handle::{BodyHandle, PointHandle};
use crate::mechanism::kernels::Mechanism;
use crate::mechanism::point::{Located, Place};
use crate::state::vector::{Array, StateParts};

/// What is `at` a place: the centre of mass of a body, or a named point.
impl<S: Scalar, M: Mechanism, K: Borrow<M::Constants<S>>> View<'_, S, M, K> {
    /// The position (m, global).
    #[must_use]
    pub fn position(&self, at: impl Located<M>) -> Vector3<S> {
        match at.located() {
            Place::Body(body) => self.pose(body).position,
            Place::Point(point) => {
                let (body, arm) = self.arm(point);
                let Some(body) = body else { return arm.into() };
                Vector3::from(plus(&self.pose(body).position.into(), &arm))
            }
        }
    }

    /// The velocity (m/s, global).
    #[must_use]
    pub fn velocity(&self, at: impl Located<M>) -> Vector3<S> {
        match at.located() {
            Place::Body(body) => M::velocity(self.state(), body),
            Place::Point(point) => {
                let (body, arm) = self.arm(point);
                let Some(body) = body else {
                    return Vector3::from([S::zero(); 3]);
                };
                let centre = M::velocity(self.state(), body).into();
                let spin = self.angular_velocity_global(body).into();
                Vector3::from(plus(&centre, &cross(&spin, &arm)))
            }
        }
    }

    /// The acceleration (m/s^2, global), with the centripetal part.
    #[must_use]
    pub fn acceleration(&self, rates: &M::State<S>, at: impl Located<M>) -> Vector3<S> {
        let of_body = |body: BodyHandle<M>| -> [S; 3] {
            let place = body.info().map_or(usize::MAX, |info| info.velocity);
            read(rates.velocities().as_slice(), place)
        };
        match at.located() {
            Place::Body(body) => Vector3::from(of_body(body)),
            Place::Point(point) => {
                let (body, arm) = self.arm(point);
                let Some(body) = body else {
                    return Vector3::from([S::zero(); 3]);
                };
                let spin = self.angular_velocity_global(body).into();
                let turning = self.angular_acceleration_global(rates, body).into();
                let turned = plus(&cross(&turning, &arm), &cross(&spin, &cross(&spin, &arm)));
                Vector3::from(plus(&of_body(body), &turned))
            }
        }
    }

    /// The body of a named point, and the arm (m, global) from its centre of mass; from the origin
    /// on the ground.
    fn arm(&self, point: PointHandle<M>) -> (Option<BodyHandle<M>>, [S; 3]) {
        let components = M::named_point(self.constants(), point.index());
        let body = point.info().and_then(|info| info.body);
        let Some(body) = body.map(BodyHandle::<M>::new) else {
            return (None, components);
        };
        let state = self.state_of_kernels();
        (Some(body), in_global_axes::<S, M>(&state, body, components))
    }
}
