//! Missing, repeated, unknown and misplaced attributes of a body.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Missing {
    #[body]
    nothing: Body,
    #[body(mass = 1.0, free)]
    half: Body,
    #[body(free)]
    point: Particle,
}

#[derive(Mechanism)]
struct Unknown {
    #[body(mass = 1.0, mass = 2.0, inertia = [1.0, 1.0, 1.0], free, free)]
    twice: Body,
    #[body(mas = 1.0, inertia = [1.0, 1.0, 1.0], positon = [0.0, 0.0, 0.0], colour = 3, free)]
    misspelt: Body,
    #[body(mass, inertia = [1.0, 1.0, 1.0], free = true)]
    valueless: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    #[body(mass = 1.0)]
    repeated: Body,
}

#[derive(Mechanism)]
struct Undescribed {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    spare: Body,
    counter: u32,
    #[joint(between = [rod, spare], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() {}
