//! Bodies with a full inertia tensor.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{self, GROUND, rotation};
use holonom_assembler::joints::Joint;
use nalgebra::{Matrix3, Vector3, Vector4};

use super::{add_revolute_at, parameters, rotation_of, turned};
use crate::scene::Scene;

/// The tensor of `tilted` in its own axes (kg m^2).
pub(crate) const TILTED: [[f64; 3]; 3] =
    [[0.20, 0.03, -0.01], [0.03, 0.15, 0.02], [-0.01, 0.02, 0.10]];

/// The tensor of `upright` in its own axes (kg m^2).
pub(crate) const UPRIGHT: [[f64; 3]; 3] = [[0.05, 0.0, 0.01], [0.0, 0.06, 0.0], [0.01, 0.0, 0.04]];

/// Two bodies with full tensors, one of them turned; the second joint is given by points on the
/// bodies, in the axes in which the bodies are described, and is violated by some centimetres at
/// the start.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub(crate) struct FullTensors {
    #[body(
        mass = 1.5,
        inertia = [[0.20, 0.03, -0.01], [0.03, 0.15, 0.02], [-0.01, 0.02, 0.10]],
        position = [0.2, 0.3, -0.1],
        orientation = rotation([0.4, -0.2, 1.0], deg(65.0)),
        velocity = [0.5, -0.5, 0.25],
        angular_velocity = [0.3, 1.2, -0.7]
    )]
    tilted: Body,
    #[body(
        mass = 0.8,
        inertia = [[0.05, 0.0, 0.01], [0.0, 0.06, 0.0], [0.01, 0.0, 0.04]],
        position = [0.6, 0.7, 0.1]
    )]
    upright: Body,
    #[joint(between = [ground, tilted], point = [0.0, 0.1, 0.2], axis = [0.5, -1.0, 0.25])]
    hinge: Revolute,
    #[joint(between = [tilted, upright], point = local([0.4, 0.1, 0.2], [-0.2, -0.15, 0.05]))]
    ball: Spherical,
}

/// Euler parameters of the principal axes of a body, and its principal moments, from the user's
/// axes and tensor and the rotation that the mechanism says is between them. The rotation must make
/// the tensor diagonal.
fn principal<M: Mechanism>(
    body: usize,
    tensor: [[f64; 3]; 3],
    orientation: [f64; 4],
) -> ([f64; 4], [f64; 3], Matrix3<f64>) {
    /// Round-off of three rotations of a tensor of the size 0.2.
    const ROUND_OFF: f64 = 1e-15;
    let axes = M::user_axes(body);
    let into_principal = rotation(&Vector4::from(axes));
    let tensor = Matrix3::from_fn(|row, column| tensor[row][column]);
    let turned = into_principal * tensor * into_principal.transpose();
    let moments = turned.diagonal();
    assert!((turned - Matrix3::from_diagonal(&moments)).amax() <= ROUND_OFF);
    let euler = rotation_of(orientation) * rotation_of(axes).inverse();
    (parameters(euler), moments.into(), into_principal)
}

impl Scene for FullTensors {
    fn assembler() -> Assembler {
        let user = turned([0.4, -0.2, 1.0], 65.0);
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let (euler, moments, into_tilted) = principal::<Self>(0, TILTED, user);
        let spin = into_tilted * Vector3::new(0.3, 1.2, -0.7);
        let tilted = scene.add_body(
            bodies::Body::rigid(1.5, moments, [0.2, 0.3, -0.1])
                .with_euler(euler)
                .with_velocity([0.5, -0.5, 0.25], spin.into()),
        );
        let (euler, moments, into_upright) = principal::<Self>(1, UPRIGHT, [1.0, 0.0, 0.0, 0.0]);
        let upright =
            scene.add_body(bodies::Body::rigid(0.8, moments, [0.6, 0.7, 0.1]).with_euler(euler));
        let hinge = [GROUND, tilted].map(|body| scene.to_body_point(body, [0.0, 0.1, 0.2]));
        add_revolute_at(&mut scene, [GROUND, tilted], hinge, [0.5, -1.0, 0.25]);
        scene.add_joint(Joint::spherical_at(
            [tilted, upright],
            [
                into_tilted * Vector3::new(0.4, 0.1, 0.2),
                into_upright * Vector3::new(-0.2, -0.15, 0.05),
            ],
        ));
        scene
    }
}
