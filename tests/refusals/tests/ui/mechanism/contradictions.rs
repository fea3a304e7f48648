//! Equations that no motion satisfies together.

use holonom::joints::{AngleDriver, DisplacementDriver, Revolute, Screw};
use holonom::prelude::*;

/// Two motors of two speeds: what is left out would be violated from the first instant on.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Speeds {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = time)]
    slow: AngleDriver,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = 2.0 * time)]
    fast: AngleDriver,
}

/// Apart from the start on, and nothing is asked for.
#[derive(Mechanism)]
struct Places {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = time)]
    first: AngleDriver,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = time + 0.1)]
    second: AngleDriver,
}

/// One goes on after 40 s: a compliance would make a compromise.
#[derive(Mechanism)]
#[mechanism(redundant = "keep")]
struct Late {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = sin(time))]
    first: AngleDriver,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = sin(time) + smooth_step((time - 40.0) / 10.0))]
    second: AngleDriver,
}

/// A feed that is not that of the screw.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Feed {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    nut: Body,
    #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], pitch = 0.01)]
    screw: Screw,
    #[joint(between = [ground, nut], axis = [0.0, 0.0, 1.0], motion = TAU * time)]
    turn: AngleDriver,
    #[joint(between = [ground, nut], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0], motion = 0.011 * time)]
    feed: DisplacementDriver,
}

/// The same law twice is redundant, and may be left out.
#[derive(Mechanism)]
#[mechanism(redundant = "drop")]
struct Twice {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.2])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = 2.0 * time)]
    first: AngleDriver,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = time + time)]
    second: AngleDriver,
}

fn main() {}
