//! The bodies of a joint.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Between {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rocker: Body,
    #[joint(between = [crank, roker], point = [0.0, 0.0, 0.0])]
    misspelt: Spherical,
    #[joint(between = [crank, wheel], point = [0.0, 0.0, 0.0])]
    unknown: Spherical,
    #[joint(between = [crank, crank], point = [0.0, 0.0, 0.0])]
    itself: Spherical,
    #[joint(between = [ground, ground], point = [0.0, 0.0, 0.0])]
    nothing: Spherical,
    #[joint(between = [ground, crank, rocker], point = [0.0, 0.0, 0.0])]
    three: Spherical,
    #[joint(between = [crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    one: Revolute,
    #[joint(between = crank, point = [0.0, 0.0, 0.0])]
    bare: Spherical,
    #[joint(between = [ground, "crank"], point = [0.0, 0.0, 0.0])]
    text: Spherical,
    #[joint(between = [self.crank, ground], point = [0.0, 0.0, 0.0])]
    field: Spherical,
    #[joint(point = [0.0, 0.0, 0.0])]
    none: Spherical,
    #[joint(between = [crank, three], point = [0.0, 0.0, 0.0])]
    joint: Spherical,
}

holonom::joint! {
    joint Pinned(i) {
        i.origin;
    }
}

#[derive(Mechanism)]
struct Grounded {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    crank: Body,
    #[joint(between = [ground])]
    pin: Pinned,
}

fn main() {}
