//! Poses in the types of `mint`, which graphics and game libraries take. Vectors and quaternions
//! are those of `nalgebra`, which converts them itself: `let v: mint::Vector3<f64> = v.into()`.

use crate::math::scalar::Scalar;
use crate::measure::access::Pose;

/// Position (m, global), and the rotation from the user's body axes to the global axes.
impl<S: Scalar> From<Pose<S>> for (mint::Point3<S>, mint::Quaternion<S>) {
    fn from(pose: Pose<S>) -> Self {
        let [x, y, z] = pose.position.into();
        (mint::Point3 { x, y, z }, pose.orientation.into())
    }
}

/// Position (m, global), and the rotation from the user's body axes to the global axes.
impl<S: Scalar> From<(mint::Point3<S>, mint::Quaternion<S>)> for Pose<S> {
    fn from(
        (mint::Point3 { x, y, z }, orientation): (mint::Point3<S>, mint::Quaternion<S>),
    ) -> Self {
        Self {
            position: nalgebra::Vector3::new(x, y, z),
            orientation: orientation.into(),
        }
    }
}
