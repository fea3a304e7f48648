//! A joint that is to stay equations, where that says nothing.

use holonom::forces::SpringDamper;
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Bodies {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.0])]
    rod: Body,
    #[joint(cut, between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Driven {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 1.0, 0.0])]
    rod: Body,
    #[joint(cut = true, between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(cut, between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = time)]
    motor: AngleDriver,
    #[force(cut, between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 1.0, 0.0], stiffness = 1.0, free_length = 1.0)]
    spring: SpringDamper,
}

fn main() {}
