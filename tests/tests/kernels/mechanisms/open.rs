//! Open chains.

use holonom::forces::SpringDamper;
use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{self, GROUND};
use holonom_assembler::forces::Force;

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

/// Three hinges in a row: no axis along a principal axis, every body turned against the global
/// axes.
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

/// Four links with axes in turn and springs between neighbours, all by their numbers.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.4, -9.81])]
pub(crate) struct AlternatingChain {
    #[body(
        mass = 2.0 - 0.25 * k,
        inertia = [0.1, 0.02 + 0.01 * k, 0.11],
        position = [0.1 * (k % 2), 0.5 + k, 0.0],
        angular_velocity = if k == 2 { [0.0, 0.3, 0.0] } else { [0.2 * k, 0.0, -0.1] }
    )]
    links: [Body; 4],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [0.0, k, 0.0],
        axis = if k % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 0.2, 1.0] }
    )]
    pins: [Revolute; 4],
    #[force(
        between = [links[k], links[k + 1]],
        head = [0.0, 0.5 + k, 0.3],
        tail = [0.0, 1.5 + k, 0.2 * k],
        stiffness = 20.0 * (k + 1),
        damping = 0.5 * k,
        free_length = 0.8
    )]
    springs: [SpringDamper; 3],
}

impl Scene for AlternatingChain {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.4, -9.81]);
        let spins = [
            [0.0, 0.0, -0.1],
            [0.2, 0.0, -0.1],
            [0.0, 0.3, 0.0],
            [0.6, 0.0, -0.1],
        ];
        let links = [
            (2.0, 0.02, [0.0, 0.5, 0.0]),
            (1.75, 0.03, [0.1, 1.5, 0.0]),
            (1.5, 0.04, [0.0, 2.5, 0.0]),
            (1.25, 0.05, [0.1, 3.5, 0.0]),
        ];
        let mut before = GROUND;
        let mut bodies = Vec::new();
        for (k, (mass, moment, position)) in links.into_iter().enumerate() {
            let body = bodies::Body::rigid(mass, [0.1, moment, 0.11], position)
                .with_velocity([0.0; 3], spins[k]);
            let body = scene.add_body(body);
            let axis = [[1.0, 0.0, 0.0], [0.0, 0.2, 1.0]][k % 2];
            add_revolute(&mut scene, [before, body], [0.0, k as f64, 0.0], axis);
            bodies.push(body);
            before = body;
        }
        for (k, (stiffness, damping, lift)) in
            [(20.0, 0.0, 0.0), (40.0, 0.5, 0.2), (60.0, 1.0, 0.4)]
                .into_iter()
                .enumerate()
        {
            let height = k as f64;
            let force = Force::spring_damper(
                &scene,
                [bodies[k], bodies[k + 1]],
                [0.0, 0.5 + height, 0.3],
                [0.0, 1.5 + height, lift],
                stiffness,
                damping,
                0.8,
            );
            scene.add_force(force);
        }
        scene
    }
}
