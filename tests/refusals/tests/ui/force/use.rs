//! Forces in a mechanism.

use holonom::forces::{Actuator, ConstantMoment, FollowerForce, FollowerMoment, PointForce, SpringDamper};
use holonom::joints::{Fixed, Revolute};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Exchanged {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[force(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stiffness = 3.0, free_length = 1.0)]
    spring: SpringDamper,
    #[force(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    number: u32,
    #[force(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    weight: Body,
}

#[derive(Mechanism)]
struct Bodies {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    rod: Body,
    #[force(between = [ground], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stiffness = 3.0, free_length = 1.0)]
    one: SpringDamper,
    #[force(between = [rod, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stiffness = 3.0, free_length = 1.0)]
    itself: SpringDamper,
    #[force(between = [ground], point = [0.0, 0.0, 0.0], force = [1.0, 0.0, 0.0])]
    nothing: FollowerForce,
    #[force(between = [ground, rood], point = [0.0, 0.0, 0.0], force = [1.0, 0.0, 0.0])]
    misspelt: PointForce,
    #[force(point = [0.0, 0.0, 0.0], force = [1.0, 0.0, 0.0])]
    none: PointForce,
    #[force]
    bare: FollowerMoment,
    #[force = 3]
    value: FollowerMoment,
}

#[derive(Mechanism)]
struct Parameters {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    rod: Body,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stifness = 3.0, free_length = 1.0)]
    misspelt: SpringDamper,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0])]
    missing: SpringDamper,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], stiffness = 1.0, dampng = 1.0)]
    default: SpringDamper,
    #[force(between = [ground, rod], point = [0.0, 0.0, 0.0], force = 3.0)]
    scalar: PointForce,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = [0.0, 0.0, 1.0])]
    vector: Actuator,
}

#[derive(Mechanism)]
struct Particles {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    bead: Particle,
    #[joint(between = [ground, bead], point = [1.0, 0.0, 0.0])]
    glued: Fixed,
    #[force(between = [ground, bead], moment = [1.0, 0.0, 0.0])]
    turned: ConstantMoment,
    #[force(between = [bead], moment = [1.0, 0.0, 0.0])]
    follower: FollowerMoment,
    #[force(between = [bead], point = [1.0, 0.0, 0.0], force = [1.0, 0.0, 0.0])]
    pushed: FollowerForce,
    #[force(between = [ground, bead], point = [0.0, 0.0, 0.0], force = [1.0, 0.0, 0.0])]
    off: PointForce,
    #[force(between = [ground, bead], head = [0.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], stiffness = 3.0, free_length = 1.0)]
    held: SpringDamper,
}

fn main() {}
