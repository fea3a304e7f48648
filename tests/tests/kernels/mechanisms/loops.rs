//! A closed loop whose equations are independent.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{self, GROUND};

use super::{add_revolute, turned};
use crate::scene::Scene;

/// A four-bar in the yz plane at the start: crank and rocker on hinges, the coupler between two
/// balls. The coupler may turn about its own line and the hinges are not quite parallel, so that no
/// equation is redundant: 2 degrees of freedom.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub(crate) struct FourBar {
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
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 0.3])]
    near: Spherical,
    #[joint(between = [coupler, rocker], point = [0.0, 1.0, 0.5])]
    far: Spherical,
    #[joint(between = [rocker, ground], point = [0.0, 1.0, 0.0], axis = [1.0, 0.05, 0.1])]
    support: Revolute,
}

impl Scene for FourBar {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, 0.0, -9.81]);
        let crank = scene.add_body(bodies::Body::rigid(
            1.2,
            [0.02, 0.02, 0.001],
            [0.0, 0.0, 0.15],
        ));
        let coupler = scene.add_body(
            bodies::Body::rigid(2.5, [0.21, 0.004, 0.21], [0.0, 0.5, 0.4])
                .with_euler(turned([1.0, 0.0, 0.0], 11.3)),
        );
        let rocker = scene.add_body(bodies::Body::rigid(
            1.8,
            [0.04, 0.04, 0.002],
            [0.0, 1.0, 0.25],
        ));
        add_revolute(&mut scene, [GROUND, crank], [0.0; 3], [1.0, 0.0, 0.0]);
        scene.add_spherical([crank, coupler], [0.0, 0.0, 0.3]);
        scene.add_spherical([coupler, rocker], [0.0, 1.0, 0.5]);
        add_revolute(
            &mut scene,
            [rocker, GROUND],
            [0.0, 1.0, 0.0],
            [1.0, 0.05, 0.1],
        );
        scene
    }
}
