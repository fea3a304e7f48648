//! Numbers that depend on the number of the element.

use holonom::joints::Spherical;
use holonom::forces::Actuator;
use holonom::prelude::*;

const MASSES: [f64; 2] = [1.0, 2.0];
const MASS: f64 = -1.0;

#[derive(Mechanism)]
struct Numbers {
    #[body(mass = 2.0 - k, free)]
    light: [Particle; 16],
    #[body(mass = 0.5 * k as f64, free)]
    cast: [Particle; 2],
    #[body(mass = if k { 1.0 } else { 2.0 }, free)]
    condition: [Particle; 2],
    #[body(mass = if k == 0 { 1.0 }, free)]
    otherwise: [Particle; 2],
    #[body(mass = if k == 0 { let m = 1.0; m } else { 2.0 }, free)]
    statements: [Particle; 2],
    #[body(mass = if 0.5 * k < 1.0 { 1.0 } else { 2.0 }, free)]
    half: [Particle; 2],
    #[body(mass = 1.0 + 0.5 % 2.0, free)]
    remainder: [Particle; 2],
    #[body(mass = k, free)]
    single: Particle,
    #[body(mass = if 1 == 1 { 1.0 } else { 2.0 }, free)]
    constant: Particle,
    #[body(mass = 1.0, pos = [0.0, k, 0.0], free)]
    misspelt: [Particle; 16],
}

#[derive(Mechanism)]
struct Values {
    #[param]
    lengths: [f64; 3],
    #[param]
    mass: f64,
    #[param]
    short: [f32; 3],
    #[body(mass = lengths, free)]
    whole: [Particle; 2],
    #[body(mass = lengths[k], free)]
    long: [Particle; 4],
    #[body(mass = mass[k], free)]
    single: [Particle; 4],
    #[body(mass = length[k], free)]
    unknown: [Particle; 4],
    #[body(mass = MASSES[k - 1], free)]
    table: [Particle; 2],
}

#[derive(Mechanism)]
struct Index {
    #[param]
    k: f64,
    #[body(mass = k + 1, inertia = [1.0, 1.0, 1.0])]
    links: [Body; 2],
    #[joint(between = [ground, links[k]], point = [0.0, 0.0, 0.0])]
    pins: [Spherical; 2],
}

holonom::force! {
    /// A spring whose law has an argument of a name that means something else.
    pub force Spring(i, j; head: Point, tail: Point, force: Law(k)) {
        force(length(j.tail - i.head)) along length(j.tail - i.head);
    }
}

#[derive(Mechanism)]
struct Argument {
    #[body(mass = 1.0)]
    beads: [Particle; 2],
    #[force(between = [ground, beads[k]], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = -10.0 * k)]
    springs: [Spring; 2],
    #[force(between = [ground, beads[0]], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = -10.0 * k)]
    spring: Spring,
    #[force(between = [ground, beads[k]], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = rte * k)]
    actuators: [Actuator; 2],
}

/// What the compiler finds: an entry that is not there, and a mass that no element may have.
#[derive(Mechanism)]
struct Compiled {
    #[body(mass = MASSES[k], free)]
    table: [Particle; 3],
    #[body(mass = MASS, free)]
    beads: [Particle; 3],
}

fn main() {}
