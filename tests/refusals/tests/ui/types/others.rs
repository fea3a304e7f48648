//! Types that are neither bodies nor joints where the run-time crate is known.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Others {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0)]
    number: f64,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    counter: u32,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    optional: Option<Spherical>,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    pair: (Spherical, Spherical),
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    several: &'static [Spherical],
}

#[derive(Mechanism)]
struct Exchanged {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0)]
    pivot: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    weight: Body,
    #[joint(between = [rod, weight], point = [0.0, 0.0, 0.0])]
    held: Spherical,
}

#[derive(Mechanism)]
struct Unrelated {
    #[body(mass = 1.0)]
    rod: u32,
    #[joint(between = [ground, rod])]
    pivot: f64,
}

fn main() {}
