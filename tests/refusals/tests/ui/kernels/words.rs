//! Kernels by words that there are, of joint coordinates.

use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mas, inverse, inverse, M(q)])]
struct Words {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = "mass")]
struct NoList {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

#[derive(Mechanism)]
#[mechanism(kernels = [mass])]
struct OfBodies {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {
    // Nothing is said of what is used.
    let rod = OfBodies::default();
    let space = rod.coordinates([OfBodies::HANDLES.hinge]).unwrap();
    let state = space.state([0.0_f64], [0.0]).unwrap();
    space.mass(&state).unwrap();
}
