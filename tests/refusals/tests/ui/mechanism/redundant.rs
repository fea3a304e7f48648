//! Equations that follow from others.

use holonom::joints::{Distance, Revolute, Spherical};
use holonom::prelude::*;

/// A door on three hinges, one of them a ball.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0])]
struct Door {
    #[body(mass = 20.0, inertia = [6.7, 1.1, 7.7], position = [0.4, 1.0, 0.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.25, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 1.0, 0.0])]
    middle: Spherical,
    #[joint(between = [ground, leaf], point = [0.0, 1.75, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

/// A four-bar of parallel hinges.
#[derive(Mechanism)]
struct FourBar {
    #[body(mass = 1.2, inertia = [0.02, 0.02, 0.001], position = [0.0, 0.0, 0.15])]
    crank: Body,
    #[body(mass = 2.5, inertia = [0.21, 0.004, 0.21], position = [0.0, 0.5, 0.4])]
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

/// A bead on a stand of three legs and one too many.
#[derive(Mechanism)]
struct Stand {
    #[body(mass = 1.0, position = [0.0, 0.0, 1.0])]
    bead: Particle,
    #[joint(between = [ground, bead], point = [0.0, 0.0, 1.0])]
    top: Spherical,
    #[joint(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0])]
    leg: Distance,
}

#[derive(Mechanism)]
#[mechanism(redundant = "dorp")]
struct Misspelt {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
#[mechanism(redundant = keep)]
struct Word {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
#[mechanism(redundant)]
struct Bare {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

const HEIGHT: f64 = 1.5;

/// What cannot be seen cannot be left out.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Unseen {
    #[param]
    width: f64,
    #[body(mass = HEIGHT, inertia = [1.0, 1.0, 1.0], position = [0.5 * width, 1.0, 0.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.5, 0.0], axis = [0.0, 1.0, 0.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, HEIGHT, 0.0], axis = [0.0, 1.0, 0.0])]
    upper: Revolute,
}

#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Apart {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]))]
    lower: Spherical,
    #[joint(between = [ground, leaf], point = local([0.0, 1.0, 0.0], [0.0, 2.0, 0.0]))]
    upper: Spherical,
}

/// Rods that do not meet: each by itself could be satisfied from somewhere else.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Short {
    #[body(mass = 1.0)]
    bead: Particle,
    #[joint(between = [ground, bead], head = [-1.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 0.9)]
    left: Distance,
    #[joint(between = [ground, bead], head = [1.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 0.9)]
    right: Distance,
}

/// Nothing is redundant: either wish is granted.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Dropped {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
#[mechanism(redundant = "keep")]
struct Kept {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

fn main() {}
