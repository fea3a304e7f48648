//! Elements that are not there, and what is no element.

use holonom::joints::{Revolute, Spherical};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Chain {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.5 + k, 0.0])]
    links: [Body; 16],
    #[body(mass = 1.0)]
    bob: Particle,
    #[joint(between = [links[k - 1], links[k]], point = [0.0, k, 0.0])]
    pins: [Spherical; 16],
    #[joint(between = [links[k], links[k + 1]], point = [0.0, k, 0.0])]
    next: [Spherical; 16],
    #[joint(between = [links[k % 3], links[2 - k]], point = [0.0, k, 0.0])]
    twice: [Spherical; 3],
    #[joint(between = [links, bob[0]], point = [0.0, k, 0.0])]
    whole: [Spherical; 2],
    #[joint(between = [ground, links], point = [0.0, 0.0, 0.0])]
    single: Spherical,
    #[joint(between = [ground[k], link[k]], point = [0.0, 0.0, 0.0])]
    unknown: [Spherical; 2],
    #[joint(between = [pins[0], links[16]], point = [0.0, 0.0, 0.0])]
    last: Spherical,
    #[joint(between = [links[1.5], links[N - 1]], point = [0.0, 0.0, 0.0])]
    half: Spherical,
    #[joint(between = [links[k], links[0..2]], point = [0.0, 0.0, 0.0])]
    range: Spherical,
    #[joint(between = [links[7 / (k - 1)], links[9223372036854775807 + k]], point = [0.0, 0.0, 0.0])]
    far: [Spherical; 3],
}

#[derive(Mechanism)]
struct Loose {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    links: [Body; 4],
    #[joint(between = [ground, links[2 * k]], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pins: [Revolute; 2],
}

fn main() {}
