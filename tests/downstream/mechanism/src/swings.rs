//! Parts that another crate describes, one of them mirrored, and the same by hand.

use downstream_joints::{Rod, Swing};
use mech::prelude::*;

/// The distance (m) of a hinge from the post: not the constant of this name that a swing has.
const ARM: f64 = 0.2;

/// Two swings on one post, which slides along x.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Swings {
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    post: Body,
    #[joint(between = [ground, post], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
    #[part(post = post, mirror = if k == 0 { none } else { x }, at = [ARM * (1 - 2 * k), 0.0, 0.0])]
    pair: [Swing; 2],
}

/// One of them by hand.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct ByHand {
    #[param]
    length: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    post: Body,
    #[joint(between = [ground, post], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.2], position = [(1 - 2 * k) * 0.7, 0.0, 0.0])]
    beams: [Body; 2],
    #[joint(between = [post, beams[k]], point = [0.2 * (1 - 2 * k), 0.0, 0.0], axis = [0.0, 1.0 - 2 * k, 0.0])]
    hinges: [Revolute; 2],
    #[body(mass = 0.2, position = [1.2 * (1 - 2 * k), 0.0, -length])]
    weights: [Particle; 2],
    #[joint(
        between = [beams[k], weights[k]], head = [1.2 * (1 - 2 * k), 0.0, 0.0], tail = [1.2 * (1 - 2 * k), 0.0, -length],
        length = length
    )]
    rods: [Rod; 2],
}
