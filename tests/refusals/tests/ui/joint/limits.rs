//! Limits of joints that cannot have them, and limits that are none.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Stops {
    #[param(like = 2.0)]
    width: f64,
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], limits = [-1.0, 1.0])]
    ball: Spherical,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    sleeve: Body,
    #[joint(between = [ground, sleeve], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limits = [-1.0, 1.0])]
    bearing: Cylindrical,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], limits = [0.0, 1.0], restitution = 0.5)]
    weld: Fixed,
    #[joint(
        between = [ground, rod, sleeve], axis_i = [1.0, 0.0, 0.0], axis_j = [1.0, 0.0, 0.0], ratio = 2.0,
        limits = [-1.0, 1.0]
    )]
    gear: Gear,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    a: Body,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limits = [1.0, -1.0])]
    turned: Revolute,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    b: Body,
    #[joint(between = [ground, b], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limits = [width, 1.0])]
    wide: Prismatic,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    c: Body,
    #[joint(
        between = [ground, c], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0],
        limits = [-f64::INFINITY, 1.0], restitution = 1.5
    )]
    endless: Revolute,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    d: Body,
    #[joint(between = [ground, d], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limits = 1.0)]
    single: Prismatic,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    e: Body,
    #[joint(between = [ground, e], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limits = [-1.0, push])]
    pushed: Revolute,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    f: Body,
    #[joint(between = [ground, f], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], restitution = 0.5)]
    lively: Revolute,
    #[force(between = [ground, f], axis = [1.0, 0.0, 0.0], moment = 1.0, limits = [-1.0, 1.0])]
    motor: TorsionalActuator,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    g: Body,
    #[joint(between = [ground, g], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], limit = [-1.0, 1.0])]
    misspelt: Prismatic,
}

fn main() {}
