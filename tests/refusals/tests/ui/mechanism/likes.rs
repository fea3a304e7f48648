//! What parameters are said to be like.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

const LENGTH: f64 = 0.8;

#[derive(Mechanism)]
struct Written {
    #[param(like = "long")]
    text: f64,
    #[param(like = crate::LENGTH)]
    path: f64,
    #[param(like = 2.0 * text)]
    other: f64,
    #[param(like)]
    nothing: f64,
    #[param(like = 1e50)]
    huge: f64,
    #[param(like = 0.0 / 0.0)]
    undefined: f64,
    #[param(like = [1.0, 2.0])]
    several: f64,
    #[param(like = [1.0, 2.0])]
    few: [f64; 3],
    #[param(like = 1.0, like = 2.0)]
    twice: f64,
    #[param(likes = 1.0)]
    misspelt: f64,
    #[param = 3.0]
    given: f64,
    #[input(like = 3.0)]
    torque: f64,
    #[body(mass = 1.0, free)]
    bead: Particle,
}

/// What `new` would refuse.
#[derive(Mechanism)]
struct Refused {
    #[param(like = -2.0)]
    mass: f64,
    #[param(like = 0.0)]
    zero: f64,
    #[body(mass = mass, free)]
    negative: Particle,
    #[body(mass = 1.0, inertia = [zero, 1.0, 1.0], free)]
    flat: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 2.5 - zero], free)]
    impossible: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = [zero, 0.0, 0.0, 0.0], free)]
    askew: Body,
    #[body(mass = 1.0, position = [1.0 / zero, 0.0, 0.0], free)]
    far: Particle,
    #[joint(between = [ground, askew], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 2.0 * zero])]
    hinge: Revolute,
}

/// Not all that the constraints depend on.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Partly {
    #[param(like = 1.0)]
    known: f64,
    #[param]
    unknown: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [known, 0.0, 0.0])]
    door: Body,
    #[joint(between = [ground, door], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, door], point = [0.0, 0.0, unknown], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
}

/// Redundant where they are what they are like, and nothing was said of it.
#[derive(Mechanism)]
struct Unsaid {
    #[param(like = 1.0)]
    height: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    door: Body,
    #[joint(between = [ground, door], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, door], point = [0.0, 0.0, height], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
}

/// Out of reach where they are what they are like.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Apart {
    #[param(like = 3.0)]
    base: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], point = local([base, 0.0, 0.0], [0.5, 0.0, 0.0]))]
    end: Spherical,
}

fn main() {
    let _ = LENGTH;
}
