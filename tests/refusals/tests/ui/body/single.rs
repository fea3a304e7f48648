//! Constants of another type are refused once, where they stand.

use holonom::joints::Revolute;
use holonom::prelude::*;

const MASS: f32 = 1.0;
const MOMENT: f32 = 0.1;
const LENGTH: f32 = 0.5;
const COUNT: usize = 2;

#[derive(Mechanism)]
struct Pendulum {
    #[body(mass = MASS, inertia = [2.0 * MOMENT, 0.1, 0.1], position = [0.0, LENGTH, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [COUNT, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {}
