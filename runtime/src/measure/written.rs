//! Poses and wrenches as they are written to a file: vectors as arrays, Euler parameters scalar
//! first, as everywhere in this crate.

use nalgebra::{Quaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::math::scalar::Scalar;
use crate::measure::access::Pose;
use crate::measure::reaction::Wrench;

/// A pose, as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Pose", deny_unknown_fields)]
pub(crate) struct WrittenPose<S> {
    position: [S; 3],
    orientation: [S; 4],
}

impl<S: Scalar> From<Pose<S>> for WrittenPose<S> {
    fn from(pose: Pose<S>) -> Self {
        let [x, y, z, w] = pose.orientation.coords.into();
        Self {
            position: pose.position.into(),
            orientation: [w, x, y, z],
        }
    }
}

impl<S: Scalar> From<WrittenPose<S>> for Pose<S> {
    fn from(written: WrittenPose<S>) -> Self {
        let [e0, e1, e2, e3] = written.orientation;
        Self {
            position: Vector3::from(written.position),
            orientation: Quaternion::new(e0, e1, e2, e3),
        }
    }
}

/// A wrench, as it is written.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Wrench", deny_unknown_fields)]
pub(crate) struct WrittenWrench<S> {
    force: [S; 3],
    moment: [S; 3],
    point: [S; 3],
    is_unique: bool,
}

impl<S: Scalar> From<Wrench<S>> for WrittenWrench<S> {
    fn from(wrench: Wrench<S>) -> Self {
        Self {
            force: wrench.force.into(),
            moment: wrench.moment.into(),
            point: wrench.point.into(),
            is_unique: wrench.is_unique,
        }
    }
}

impl<S: Scalar> From<WrittenWrench<S>> for Wrench<S> {
    fn from(written: WrittenWrench<S>) -> Self {
        Self {
            force: Vector3::from(written.force),
            moment: Vector3::from(written.moment),
            point: Vector3::from(written.point),
            is_unique: written.is_unique,
        }
    }
}
