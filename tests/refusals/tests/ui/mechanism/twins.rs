//! What is wrong only by a name.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

/// The compiler says it; what would come after is not said.
#[derive(Mechanism)]
struct Bodies {
    #[body(mass = 1.0, free)]
    bead: Particle,
    #[body(mass = 2.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
struct Joints {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    hinge: Spherical,
}

#[derive(Mechanism)]
struct Raw {
    #[body(mass = 1.0, free)]
    bead: Particle,
    #[body(mass = 2.0, free)]
    r#bead: Particle,
}

#[derive(Mechanism)]
struct Values {
    #[param]
    mass: f64,
    #[param]
    mass: f64,
    #[body(mass = mass, free)]
    bead: Particle,
}

/// The ground's own name, and a joint that misspells another.
#[derive(Mechanism)]
struct Ground {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    ground: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    lower: Body,
    #[joint(between = [ground, lwer], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {
    let _ = Simulation::new(&Joints::default(), StandardLagrange, Rk4::every(1e-3));
    let _ = Joints::HANDLES.hinge;
}
