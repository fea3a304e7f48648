//! Joints that a user defines, on bodies and on a particle.

use holonom::joints::Spherical;
use holonom::prelude::*;
use holonom_assembler::assembler::Assembler;
use holonom_assembler::bodies::{self, GROUND};
use holonom_assembler::joints::Joint;
use nalgebra::Vector3;

use super::turned;
use crate::scene::Scene;

holonom::joint! {
    /// A massless rod between two points: their distance stays the same. 1 equation.
    pub joint Rod(i, j; head: Point, tail: Point, length: Length) {
        squared(j.tail - i.head) - length * length;
    }
}

holonom::joint! {
    /// A direction on either body: they stay perpendicular. 1 equation.
    pub joint Square(i, j; direction: Vector, other: Vector) {
        dot(i.direction, j.other);
    }
}

/// A body on a ball, kept square to a second one that a rod holds; a bead hangs from it on another
/// rod.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, -1.0, -9.81])]
pub(crate) struct Tethered {
    #[body(
        mass = 1.1,
        inertia = [0.08, 0.1, 0.09],
        position = [0.0, 0.3, 0.2],
        orientation = rotation([1.0, -1.0, 0.3], deg(25.0))
    )]
    plate: Body,
    #[body(mass = 0.6, inertia = [0.03, 0.02, 0.04], position = [0.5, 0.8, -0.1])]
    arm: Body,
    #[body(mass = 0.25, position = [0.9, 0.4, -0.6])]
    bead: Particle,
    #[joint(between = [plate, ground], point = [0.0, 0.1, 0.0])]
    ball: Spherical,
    #[joint(between = [plate, arm], direction = [0.8, 0.0, 0.6], other = [-0.6, 1.0, 0.8])]
    square: Square,
    #[joint(between = [arm, ground], head = [0.4, 0.9, 0.1], tail = [0.2, 0.5, 1.1], length = sqrt(1.2))]
    strut: Rod,
    #[joint(between = [arm, bead], head = [0.7, 0.6, -0.2], tail = [0.9, 0.4, -0.6], length = 0.5)]
    tether: Rod,
}

impl Scene for Tethered {
    fn assembler() -> Assembler {
        let mut scene = Assembler::new([0.0, -1.0, -9.81]);
        let plate = scene.add_body(
            bodies::Body::rigid(1.1, [0.08, 0.1, 0.09], [0.0, 0.3, 0.2])
                .with_euler(turned([1.0, -1.0, 0.3], 25.0)),
        );
        let arm = scene.add_body(bodies::Body::rigid(
            0.6,
            [0.03, 0.02, 0.04],
            [0.5, 0.8, -0.1],
        ));
        let bead = scene.add_body(bodies::Body::particle(0.25, [0.9, 0.4, -0.6]));
        scene.add_spherical([plate, GROUND], [0.0, 0.1, 0.0]);
        scene.add_joint(Joint::perpendicular_at(
            [plate, arm],
            [
                scene.to_body_vector(plate, [0.8, 0.0, 0.6]),
                scene.to_body_vector(arm, [-0.6, 1.0, 0.8]),
            ],
        ));
        scene.add_joint(Joint::distance_at(
            [arm, GROUND],
            [
                scene.to_body_point(arm, [0.4, 0.9, 0.1]),
                Vector3::new(0.2, 0.5, 1.1),
            ],
            1.2_f64.sqrt(),
        ));
        scene.add_joint(Joint::distance_at(
            [arm, bead],
            [scene.to_body_point(arm, [0.7, 0.6, -0.2]), Vector3::zeros()],
            0.5,
        ));
        scene
    }
}
