//! What a joint wants to know.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

holonom::joint! {
    joint Rod(i, j; head: Point, tail: Point, length: Length) {
        squared(j.tail - i.head) - length * length;
    }
}

#[derive(Mechanism)]
struct Parameters {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    missing: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 0.0])]
    zero: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axes = [0.0, 0.0, 1.0])]
    misspelt: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    excess: Spherical,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], point = [0.0, 0.0, 1.0])]
    twice: Spherical,
    #[joint(between = [ground, rod], point = 0.0, axis = x)]
    scalars: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0])]
    short: Spherical,
    #[joint(between = [ground, rod], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = [1.0, 0.0, 0.0])]
    vector: Rod,
    #[joint(between = [ground, rod], point = local([0.0, 0.0, 0.0]), axis = local([1.0, 0.0, 0.0], [0.0, 0.0, 0.0]))]
    local: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 1.0 / 0.0], stiffness = 3.0)]
    several: Spherical,
    #[joint]
    bare: Spherical,
}

fn main() {}
