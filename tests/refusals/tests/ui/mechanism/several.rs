//! Faults of every kind at once, in the order of the source.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81], wind = 3.0)]
struct FourBar {
    #[body(mass = 0.0, inertia = [0.1, 0.2, 0.4])]
    crank: Body,
    #[joint(between = [ground, crnk], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 0.0])]
    first: Revolute,
    coupler: Body,
    #[body(inertia = [0.1, 0.1, 0.1], mass = 1.0, mass = 2.0)]
    rocker: Body,
    #[joint(between = [crank, coupler, rocker], point = [1.0, 0.0, 0.0])]
    second: Spherical,
    #[joint(between = [rocker, rocker], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    third: Spherical,
}

fn main() {}
