//! Redundant equations of many loops, and of one.

use holonom::joints::{Planar, Revolute};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Loops {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [3.0 * k, 0.0, 0.5])]
    left: [Body; 3],
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [3.0 * k + 0.5, 0.0, 1.0])]
    top: [Body; 3],
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [3.0 * k + 1.0, 0.0, 0.5])]
    right: [Body; 3],
    #[joint(between = [ground, left[k]], point = [3.0 * k, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    a: [Revolute; 3],
    #[joint(between = [left[k], top[k]], point = [3.0 * k, 0.0, 1.0], axis = [0.0, 1.0, 0.0])]
    b: [Revolute; 3],
    #[joint(between = [top[k], right[k]], point = [3.0 * k + 1.0, 0.0, 1.0], axis = [0.0, 1.0, 0.0])]
    c: [Revolute; 3],
    #[joint(between = [right[k], ground], point = [3.0 * k + 1.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    d: [Revolute; 3],
}

#[derive(Mechanism)]
struct Last {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5 + k, 0.0])]
    links: [Body; 4],
    #[joint(between = [if k == 0 { ground } else { links[k - 1] }, links[k]], point = [0.0, k, 0.0],
        axis = if k < 2 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] })]
    pins: [Revolute; 4],
    #[joint(between = [links[k], links[3]], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    tables: [Planar; 3],
}

fn main() {}
