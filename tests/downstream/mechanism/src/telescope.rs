//! A joint of another crate with parameters and a driver.

use downstream_joints::Telescope;
use mech::prelude::*;

/// A probe that is screwed out of the ground, upwards.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Probe {
    /// Half the acceleration (m/s^2).
    #[param]
    speed: f64,
    #[param]
    lead: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.05], position = [0.0, 0.0, 1.0])]
    tip: Body,
    #[joint(
        between = [ground, tip],
        point = [0.0, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        reach = speed * time * time,
        lead = lead
    )]
    arm: Telescope,
}

/// A block in two telescopes along one axis, which depend on each other.
#[derive(Clone, Copy, Debug, Mechanism)]
pub struct Crossed {
    #[param]
    x: f64,
    #[param]
    y: f64,
    #[param]
    z: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.05], position = [0.0, 0.0, 1.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [x, y, z], reach = 0.1 * time)]
    arm: Telescope,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [x, y, z], reach = 0.1 * time)]
    spare: Telescope,
}
