//! What is wrong with the attribute of a part.
use holonom::prelude::*;

#[derive(Assembly)]
struct Leg {
    #[port]
    hull: Body,
    #[param]
    length: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    shank: Body,
    #[joint(between = [hull, shank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hip: Revolute,
}

#[derive(Assembly)]
struct Jack {
    #[port]
    base: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    nut: Body,
    #[joint(between = [base, nut], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], pitch = 0.01)]
    thread: Screw,
}

#[derive(Mechanism)]
struct Robot {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], free)]
    hull: Body,
    #[param]
    angle: f64,
    // The port is missing.
    #[part(at = [0.0, 0.5, 0.0])]
    first: Leg,
    // No such body, and no such key.
    #[part(hull = hul, place = [0.0, 0.5, 0.0])]
    second: Leg,
    // A mirror is an axis.
    #[part(hull = hull, mirror = left)]
    third: Leg,
    // An axis that the macro cannot see, and a point of two numbers.
    #[part(hull = hull, rotation = rotation([1.0, 0.0, angle], 0.5), at = [0.0, 0.5])]
    fourth: Leg,
    // The mirror image of a screw has another hand.
    #[part(base = hull, mirror = y)]
    jack: Jack,
    // A joint is no part, and a part no joint.
    #[part(hull = hull)]
    hinge: Revolute,
    #[joint(between = [hull, first.shank])]
    leg: Leg,
    #[body(mass = 1.0)]
    other: Leg,
    // A body that a part does not have, and one of a part that is none.
    #[joint(between = [first.shank, first.foot], point = [0.0, 0.0, 0.0])]
    ankle: Spherical,
    #[joint(between = [hull, fifth.shank], point = [0.0, 0.0, 0.0])]
    knee: Spherical,
}

fn main() {
    let _ = Robot::HANDLES.first.hip;
    let _ = Robot::HANDLES.jack.thread;
    let _ = Robot::new(0.0, Leg::new(1.0), Leg::new(1.0), Leg::new(1.0), Leg::new(1.0));
}
