//! Names of other tools: the compiler knows what is called so here.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Linkage {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Hinge,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    ball: Ball,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slider: Slider,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    weld: Weld,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = 1.0)]
    motor: Motor,
}

#[derive(Mechanism)]
struct Weight {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    weight: RigidBody,
    #[joint(between = [ground, weight], point = [0.0, 0.0, 0.0])]
    pivot: Spherical,
}

fn main() {}
