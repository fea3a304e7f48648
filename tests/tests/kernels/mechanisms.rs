//! The mechanisms of these tests: with the derive, and beside it once more for the assembler.
//!
//! For the assembler everything that a body carries is worked out here, by
//! [`Assembler::to_body_point`] and [`Assembler::to_body_vector`]; the two normals of an axis come
//! from the rule that both sides document, applied to the axis in global axes.

mod loops;
mod open;
mod published;
mod redundant;
mod tensors;
mod users_joints;

use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::BodyId;
use holonom_assembler::joints::{Joint, normals};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

pub(crate) use loops::FourBar;
pub(crate) use open::{AlternatingChain, DoublePendulum, ObliqueChain};
pub(crate) use redundant::{Door, PlanarFourBar};
pub(crate) use tensors::{FullTensors, TILTED, UPRIGHT};
pub(crate) use users_joints::Tethered;

/// Adds a revolute joint whose normals follow from its axis in global axes.
fn add_revolute(scene: &mut Assembler, between: [BodyId; 2], point: [f64; 3], axis: [f64; 3]) {
    let points = between.map(|body| scene.to_body_point(body, point));
    add_revolute_at(scene, between, points, axis);
}

/// The same with the points given on their bodies (m, principal axes from the centre of mass).
fn add_revolute_at(
    scene: &mut Assembler,
    between: [BodyId; 2],
    points: [Vector3<f64>; 2],
    axis: [f64; 3],
) {
    let axis = Vector3::from(axis).normalize();
    let normals = normals(&axis).map(|n| scene.to_body_vector(between[0], n.into()));
    let axis = scene.to_body_vector(between[1], axis.into());
    scene.add_joint(Joint::revolute_at(between, points, normals, axis));
}

/// Euler parameters of a rotation about an axis by an angle in degrees.
fn turned(axis: [f64; 3], degrees: f64) -> [f64; 4] {
    let axis = nalgebra::Unit::new_normalize(Vector3::from(axis));
    parameters(UnitQuaternion::from_axis_angle(&axis, degrees.to_radians()))
}

fn parameters(rotation: UnitQuaternion<f64>) -> [f64; 4] {
    [rotation.w, rotation.i, rotation.j, rotation.k]
}

/// A rotation from its Euler parameters, of any length.
pub(crate) fn rotation_of(p: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(p[0], p[1], p[2], p[3]))
}
