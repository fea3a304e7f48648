//! Mechanisms with more equations than their motion needs.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{self, GROUND};

use super::{add_revolute, turned};
use crate::scene::Scene;

/// A door of 0.8 m x 2 m and 20 kg on two hinges: 10 equations, 5 of them independent. The edge
/// leans 10 degrees.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81 * cos(deg(10.0)), -9.81 * sin(deg(10.0))], redundant = "keep")]
pub(crate) struct Door {
    #[body(
        mass = 20.0,
        inertia = [6.66933333333333, 1.06933333333333, 7.73333333333333],
        position = [0.4, 1.0, 0.0]
    )]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 1.75, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

impl Scene for Door {
    fn assembler() -> Assembler {
        holonom_assembler::scenes::door()
    }
}

/// A four-bar of four parallel hinges: 20 equations on 18 velocities, and yet it moves.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "keep")]
pub(crate) struct PlanarFourBar {
    #[body(mass = 1.2, inertia = [0.02, 0.02, 0.001], position = [0.0, 0.0, 0.15])]
    crank: Body,
    #[body(
        mass = 2.5,
        inertia = [0.21, 0.004, 0.21],
        position = [0.0, 0.5, 0.4],
        orientation = rotation([1.0, 0.0, 0.0], deg(11.3))
    )]
    coupler: Body,
    #[body(mass = 1.8, inertia = [0.04, 0.04, 0.002], position = [0.0, 1.0, 0.25])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    drive: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 0.3], axis = [1.0, 0.0, 0.0])]
    near: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 1.0, 0.5], axis = [1.0, 0.0, 0.0])]
    far: Revolute,
    #[joint(between = [rocker, ground], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    support: Revolute,
}

impl Scene for PlanarFourBar {
    fn assembler() -> Assembler {
        const X: [f64; 3] = [1.0, 0.0, 0.0];
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let crank = scene.add_body(bodies::Body::rigid(
            1.2,
            [0.02, 0.02, 0.001],
            [0.0, 0.0, 0.15],
        ));
        let coupler = scene.add_body(
            bodies::Body::rigid(2.5, [0.21, 0.004, 0.21], [0.0, 0.5, 0.4])
                .with_euler(turned(X, 11.3)),
        );
        let rocker = scene.add_body(bodies::Body::rigid(
            1.8,
            [0.04, 0.04, 0.002],
            [0.0, 1.0, 0.25],
        ));
        add_revolute(&mut scene, [GROUND, crank], [0.0; 3], X);
        add_revolute(&mut scene, [crank, coupler], [0.0, 0.0, 0.3], X);
        add_revolute(&mut scene, [coupler, rocker], [0.0, 1.0, 0.5], X);
        add_revolute(&mut scene, [rocker, GROUND], [0.0, 1.0, 0.0], X);
        scene
    }
}
