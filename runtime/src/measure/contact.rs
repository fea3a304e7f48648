//! Where two bodies touch.

use nalgebra::Vector3;

use crate::math::scalar::Scalar;

/// Where a body touches another, in global axes: of a joint that rolls
/// ([`View::contact`](crate::View::contact)), or of a contact of a run
/// ([`Sample::contact_of`](crate::Sample::contact_of)).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContactPoint<S> {
    /// The point (m).
    pub position: Vector3<S>,
    /// The direction from there into the body that rolls or touches, of length 1.
    pub normal: Vector3<S>,
    /// The velocity (m/s) of the material of that body there against the material of the other,
    /// along the surface. Of what rolls without slip it is zero, to the drift of the velocities.
    pub slip: Vector3<S>,
}

impl<S: Scalar> ContactPoint<S> {
    /// Of point, normal and slip.
    pub(crate) fn of([position, normal, slip]: [[S; 3]; 3]) -> Self {
        Self {
            position: position.into(),
            normal: normal.into(),
            slip: slip.into(),
        }
    }
}
