//! Equations that no start near the reference one satisfies.

use holonom::joints::{Distance, Revolute, Universal};
use holonom::prelude::*;

/// The arms of the cross are one.
#[derive(Mechanism)]
struct Shaft {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis_i = [1.0, 0.0, 0.0], axis_j = [1.0, 0.0, 0.0])]
    cross: Universal,
}

/// A rod of some length between a point and itself.
#[derive(Mechanism)]
struct Point {
    #[body(mass = 1.0)]
    bead: Particle,
    #[joint(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 1.0)]
    rod: Distance,
}

/// Axes in those of the bodies may be meant for another configuration.
#[derive(Mechanism)]
struct Elsewhere {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    shaft: Body,
    #[joint(
        between = [ground, shaft],
        point = [0.0, 0.0, 0.0],
        axis_i = local([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        axis_j = local([1.0, 0.0, 0.0], [1.0, 0.0, 0.0])
    )]
    cross: Universal,
}

/// In a singular configuration, which is no fault.
#[derive(Mechanism)]
struct Straight {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
    crank: Body,
    #[body(mass = 1.0, position = [2.0, 0.0, 0.0])]
    bead: Particle,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [crank, bead], head = [1.0, 0.0, 0.0], tail = [2.0, 0.0, 0.0])]
    rod: Distance,
    #[joint(between = [ground, bead], head = [3.0, 0.0, 0.0], tail = [2.0, 0.0, 0.0])]
    other: Distance,
}

fn main() {
    let _ = Shaft::default();
}
