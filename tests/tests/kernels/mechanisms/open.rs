//! Open chains.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom_tests::assembler::Assembler;
use holonom_tests::bodies::{self, GROUND};

use super::{add_revolute, turned};
use crate::scene::Scene;

/// A hinge with an axis along no coordinate, then a ball.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.3, -0.7, -9.81])]
pub(crate) struct DoublePendulum {
    #[body(
        mass = 2.0,
        inertia = [0.3, 0.4, 0.5],
        position = [0.1, 0.4, -0.2],
        velocity = [0.1, 0.2, 0.3],
        angular_velocity = [1.0, -2.0, 0.5]
    )]
    upper: Body,
    #[body(
        mass = 0.7,
        inertia = [0.02, 0.05, 0.04],
        position = [0.6, 0.9, 0.3],
        orientation = [0.2, 1.4, 1.0, 1.0]
    )]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.2, 0.1, 0.3], axis = [1.0, 2.0, -0.5])]
    hinge: Revolute,
    #[joint(between = [upper, lower], point = [0.4, 0.6, 0.1])]
    ball: Spherical,
}

impl Scene for DoublePendulum {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.3, -0.7, -9.81]);
        let upper = scene.add_body(
            bodies::Body::rigid(2.0, [0.3, 0.4, 0.5], [0.1, 0.4, -0.2])
                .with_velocity([0.1, 0.2, 0.3], [1.0, -2.0, 0.5]),
        );
        let lower = scene.add_body(
            bodies::Body::rigid(0.7, [0.02, 0.05, 0.04], [0.6, 0.9, 0.3])
                .with_euler([0.1, 0.7, 0.5, 0.5]),
        );
        add_revolute(
            &mut scene,
            [GROUND, upper],
            [0.2, 0.1, 0.3],
            [1.0, 2.0, -0.5],
        );
        scene.add_spherical([upper, lower], [0.4, 0.6, 0.1]);
        scene
    }
}

/// Three hinges in a row: no axis along a principal axis, every body turned against the global axes.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub(crate) struct ObliqueChain {
    #[body(
        mass = 3.0,
        inertia = [0.2, 0.25, 0.1],
        position = [0.3, 0.4, 0.1],
        orientation = rotation([1.0, 1.0, 0.5], deg(40.0))
    )]
    first: Body,
    #[body(
        mass = 2.0,
        inertia = [0.05, 0.15, 0.12],
        position = [0.9, 0.8, 0.2],
        orientation = rotation([-0.3, 0.2, 1.0], deg(-75.0))
    )]
    second: Body,
    #[body(
        mass = 1.0,
        inertia = [0.03, 0.02, 0.04],
        position = [1.3, 1.2, -0.1],
        orientation = rotation([0.0, 1.0, 0.0], deg(120.0))
    )]
    third: Body,
    #[joint(between = [first, ground], point = [0.0, 0.1, 0.0], axis = [0.2, -0.3, 0.9])]
    shoulder: Revolute,
    #[joint(between = [first, second], point = [0.6, 0.6, 0.2], axis = [1.0, 1.0, 1.0])]
    elbow: Revolute,
    #[joint(between = [third, second], point = [1.1, 1.0, 0.0], axis = [-0.7, 0.1, 0.4])]
    wrist: Revolute,
}

impl Scene for ObliqueChain {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let first = scene.add_body(
            bodies::Body::rigid(3.0, [0.2, 0.25, 0.1], [0.3, 0.4, 0.1])
                .with_euler(turned([1.0, 1.0, 0.5], 40.0)),
        );
        let second = scene.add_body(
            bodies::Body::rigid(2.0, [0.05, 0.15, 0.12], [0.9, 0.8, 0.2])
                .with_euler(turned([-0.3, 0.2, 1.0], -75.0)),
        );
        let third = scene.add_body(
            bodies::Body::rigid(1.0, [0.03, 0.02, 0.04], [1.3, 1.2, -0.1])
                .with_euler(turned([0.0, 1.0, 0.0], 120.0)),
        );
        add_revolute(
            &mut scene,
            [first, GROUND],
            [0.0, 0.1, 0.0],
            [0.2, -0.3, 0.9],
        );
        add_revolute(&mut scene, [first, second], [0.6, 0.6, 0.2], [1.0; 3]);
        add_revolute(
            &mut scene,
            [third, second],
            [1.1, 1.0, 0.0],
            [-0.7, 0.1, 0.4],
        );
        scene
    }
}
