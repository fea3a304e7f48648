//! Bodies that no joint names.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Alone {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    lost: Body,
    #[body(mass = 1.0)]
    stray: Particle,
    #[body(mass = 1.0, free)]
    comet: Particle,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

// With a name that nobody knows, `rocker` may be the body that was meant.
#[derive(Mechanism)]
struct Misspelt {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rocker: Body,
    #[joint(between = [ground, roker], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() {}
