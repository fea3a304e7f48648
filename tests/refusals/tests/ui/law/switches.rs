//! Laws that switch, where they cannot.

use holonom::prelude::*;

holonom::force! {
    /// A law in an energy, along what it makes, by its rate, and by a function of the definition.
    pub force Strange(i, j; head: Point, tail: Point, energy: Law(length), way: Law(length), quick: Law(length)) {
        let d = length(j.tail - i.head);
        potential energy(d);
        1.0 along way(d);
        rate(quick(d)) along d;
    }
}

holonom::force! {
    /// Functions of laws.
    pub force Sized(i, j; head: Point, tail: Point) {
        let d = length(j.tail - i.head);
        -abs(d - 1.0) along d;
    }
}

holonom::joint! {
    /// The same of a joint.
    pub joint Above(i, j; point: Point) {
        max(dot(i.point - j.point, i.point), 0.0);
    }
}

#[derive(Mechanism)]
struct Laws {
    #[param]
    play: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0, free, position = [0.0, 0.0, 1.0])]
    bead: Particle,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = abs(time - 1.0))]
    driver: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = if time > 1.0 { 1.0 } else { 0.0 })]
    jump: AngleDriver,
    #[force(
        between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0],
        energy = max(0.0, length - 1.0), way = sign(length) * length, quick = abs(length)
    )]
    strange: Strange,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = max(length))]
    count: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = if length < 1.0 { 1.0 })]
    alone: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = if length == 1.0 { 1.0 } else { 0.0 })]
    equal: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = if length { 1.0 } else { 0.0 })]
    number: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = if length < 1.0 { let f = 1.0; f } else { 0.0 })]
    several: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = clamp(length))]
    unknown: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = if lenght < 1.0 { 1.0 } else { 0.0 })]
    misspelt: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = abs(play))]
    right: Actuator,
}

fn main() {}
