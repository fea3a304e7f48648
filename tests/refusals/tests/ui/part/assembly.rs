//! What is wrong with an assembly is said where it is described, and once.
use holonom::prelude::*;

#[derive(Assembly)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Leg {
    #[port]
    hull: Body,
    #[port]
    mirror: Body,
    #[port(free)]
    pelvis: Body,
    #[body(mass = -1.0, inertia = [0.1, 0.1, 0.1])]
    shank: Body,
    #[joint(between = [hull, shin], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hip: Revolute,
    // The fields of the mechanism are not seen here.
    #[force(between = [hull, shank], axis = [1.0, 0.0, 0.0], stiffness = outer)]
    spring: TorsionalSpringDamper,
}

#[derive(Mechanism)]
struct Robot {
    #[param]
    outer: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], free)]
    hull: Body,
    #[part(hull = hull, pelvis = hull)]
    left: Leg,
    #[part(hull = hull, pelvis = hull)]
    right: Leg,
    #[port]
    wall: Body,
}

/// A mechanism does not see the fields of its parts by themselves, and parts of parts neither.
#[derive(Assembly)]
struct Arm {
    #[port]
    base: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    link: Body,
    #[joint(between = [base, link], point = local([0.0, 0.0, 0.0], [0.0, 0.0, 0.1]), axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
}

#[derive(Mechanism)]
struct Pair {
    #[part(base = ground)]
    arm: Arm,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0])]
    pin: Spherical,
}

/// No generic parameters.
#[derive(Assembly)]
struct Generic<T> {
    #[body(mass = 1.0, free)]
    bob: Particle,
    #[joint(between = [ground, bob], point = [0.0, 0.0, 0.0])]
    pin: T,
}

/// What is wrong with an assembly is no reason to say that it cannot be made.
#[derive(Assembly)]
struct Sprung {
    #[param]
    stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], fre)]
    block: Body,
}

fn main() {
    let _ = Sprung::new(1.0);
    let _ = Robot::HANDLES.left.hip;
    let _ = Pair::HANDLES.arm.shoulder;
}
