//! A point mass has no orientation.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Point {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = [1.0, 0.0, 0.0, 0.0], angular_velocity = [0.0, 0.0, 1.0])]
    bead: Particle,
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    bob: Particle,
    #[joint(between = [ground, bead], point = [0.0, 0.0, 0.0])]
    held: Spherical,
    #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0])]
    beside: Spherical,
    #[joint(between = [ground, bob], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    turned: Revolute,
}

fn main() {}
