//! Mechanisms whose masses, lengths, axes and stiffness are random, and one of them declared in
//! three ways.

use holonom::forces::SpringDamper;
use holonom::joints::{Distance, Revolute, Spherical, Universal};
use holonom::prelude::*;

/// An arm, a ball, a hinge and a stay that closes the loop, under gravity and on a spring: four
/// degrees of freedom.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(super) struct Linkage {
    #[param]
    heavy: f64,
    #[param]
    arm: f64,
    #[param]
    lean: f64,
    #[param]
    stiffness: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.05, 0.12], position = [0.1, 0.5 * arm, -0.1])]
    upper: Body,
    #[body(mass = heavy, inertia = [0.08 * heavy, 0.06 * heavy, 0.05 * heavy], position = [0.3, arm, -0.5])]
    lower: Body,
    #[body(mass = 0.8, inertia = [0.03, 0.02, 0.04], position = [0.5, arm + 0.4, -0.8])]
    tip: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, lean, 0.2])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.2, arm, -0.2])]
    elbow: Spherical,
    #[joint(between = [lower, tip], point = [0.4, arm + 0.1, -0.7], axis = [0.1, 1.0, lean])]
    wrist: Revolute,
    #[joint(between = [ground, tip], head = [0.8, 0.2, 0.3], tail = [0.5, arm + 0.5, -0.9])]
    stay: Distance,
    #[force(between = [ground, lower], head = [0.0, 1.0, 0.4], tail = [0.3, arm, -0.4], stiffness = stiffness, free_length = 0.5)]
    coil: SpringDamper,
}

/// The same from the last field to the first; evaluated in parts by its joints.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(super) struct Backwards {
    #[force(between = [ground, lower], head = [0.0, 1.0, 0.4], tail = [0.3, arm, -0.4], stiffness = stiffness, free_length = 0.5)]
    coil: SpringDamper,
    #[joint(between = [ground, tip], head = [0.8, 0.2, 0.3], tail = [0.5, arm + 0.5, -0.9])]
    stay: Distance,
    #[joint(between = [lower, tip], point = [0.4, arm + 0.1, -0.7], axis = [0.1, 1.0, lean])]
    wrist: Revolute,
    #[joint(between = [upper, lower], point = [0.2, arm, -0.2])]
    elbow: Spherical,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, lean, 0.2])]
    shoulder: Revolute,
    #[body(mass = 0.8, inertia = [0.03, 0.02, 0.04], position = [0.5, arm + 0.4, -0.8])]
    tip: Body,
    #[body(mass = heavy, inertia = [0.08 * heavy, 0.06 * heavy, 0.05 * heavy], position = [0.3, arm, -0.5])]
    lower: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.05, 0.12], position = [0.1, 0.5 * arm, -0.1])]
    upper: Body,
    #[param]
    stiffness: f64,
    #[param]
    lean: f64,
    #[param]
    arm: f64,
    #[param]
    heavy: f64,
}

/// The same mixed, with other names, which decide among equals in the order of elimination, and
/// with the bodies of the ball and the stay the other way round, which changes no more than a sign.
/// (Not those of a hinge: its equations stand on other normals then, and runs differ by what they
/// drift.)
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub(super) struct Renamed {
    #[param]
    arm: f64,
    #[joint(between = [a, c], point = [0.2, arm, -0.2])]
    z: Spherical,
    #[body(mass = heavy, inertia = [0.08 * heavy, 0.06 * heavy, 0.05 * heavy], position = [0.3, arm, -0.5])]
    a: Body,
    #[param]
    stiffness: f64,
    #[joint(between = [b, ground], head = [0.5, arm + 0.5, -0.9], tail = [0.8, 0.2, 0.3])]
    v: Distance,
    #[param]
    heavy: f64,
    #[body(mass = 0.8, inertia = [0.03, 0.02, 0.04], position = [0.5, arm + 0.4, -0.8])]
    b: Body,
    #[force(between = [ground, a], head = [0.0, 1.0, 0.4], tail = [0.3, arm, -0.4], stiffness = stiffness, free_length = 0.5)]
    s: SpringDamper,
    #[joint(between = [ground, c], point = [0.0, 0.0, 0.0], axis = [1.0, lean, 0.2])]
    x: Revolute,
    #[body(mass = 2.0, inertia = [0.1, 0.05, 0.12], position = [0.1, 0.5 * arm, -0.1])]
    c: Body,
    #[param]
    lean: f64,
    #[joint(between = [a, b], point = [0.4, arm + 0.1, -0.7], axis = [0.1, 1.0, lean])]
    w: Revolute,
}

/// Nothing holds it and nothing acts from outside: a hub with a wheel, an arm on a ball, and a tail
/// on a cross.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "joints")]
pub(super) struct Floating {
    #[param]
    heavy: f64,
    #[param]
    arm: f64,
    #[param]
    lean: f64,
    #[param]
    stiffness: f64,
    #[body(mass = heavy, inertia = [0.3 * heavy, 0.2 * heavy, 0.25 * heavy], position = [0.0, 0.0, 0.0])]
    hub: Body,
    #[body(mass = 0.6, inertia = [0.02, 0.02, 0.03], position = [0.5, 0.1, 0.0])]
    wheel: Body,
    #[body(mass = 1.2, inertia = [0.1, 0.02, 0.11], position = [0.0, 0.2 + arm, 0.1])]
    limb: Body,
    #[body(mass = 0.5, inertia = [0.01, 0.04, 0.04], position = [0.4, 0.3 + arm, 0.1])]
    tail: Body,
    #[joint(between = [hub, wheel], point = [0.4, 0.0, 0.0], axis = [0.2, lean, 1.0])]
    axle: Revolute,
    #[joint(between = [hub, limb], point = [0.0, 0.2, 0.0])]
    ball: Spherical,
    #[joint(between = [limb, tail], point = [0.1, 0.2 + arm, 0.1], axis_i = [0.0, 0.0, 1.0], axis_j = [0.0, 1.0, 0.0])]
    cross: Universal,
    #[force(between = [wheel, tail], head = [0.5, 0.3, 0.0], tail = [0.4, 0.3 + arm, 0.0], stiffness = stiffness, free_length = 0.4)]
    coil: SpringDamper,
}
