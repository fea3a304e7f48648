//! Mechanisms of parameters whose motions have closed forms.

use holonom::forces::{ConstantMoment, SpringDamper};
use holonom::joints::{Fixed, PointOnLine, Prismatic, Revolute, Spherical};
use holonom::prelude::*;

/// A rod of 1 m and 1 kg at the origin, and a bob of `ratio` kg fixed to its end.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub struct Bob {
    /// kg, and so the ratio of the masses.
    #[param]
    pub ratio: f64,
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 1e-3, 1.0 / 12.0], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[body(mass = ratio, inertia = [0.01 * ratio, 0.01 * ratio, 0.01 * ratio], position = [0.0, 1.0, 0.0])]
    bob: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [rod, bob], point = [0.0, 1.0, 0.0])]
    weld: Fixed,
}

/// A symmetric top on a ball at its centre of mass, without gravity: its axis goes round its
/// angular momentum.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
pub struct Top {
    /// rad/s, about the axis z; across it a hundredth.
    #[param]
    pub spin: f64,
    #[body(
        mass = 1.0,
        inertia = [Top::ACROSS, Top::ACROSS, Top::ALONG],
        position = [0.0, 0.0, 0.0],
        angular_velocity = [0.01 * spin, 0.0, spin]
    )]
    top: Body,
    #[joint(between = [ground, top], point = [0.0, 0.0, 0.0])]
    ball: Spherical,
}

impl Top {
    /// kg m^2.
    pub const ACROSS: f64 = 0.01;
    /// kg m^2.
    pub const ALONG: f64 = 0.016;
}

/// A block of 1 kg on a guide along x between a spring and a wall, pulled 0.1 m and let go.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
pub struct Block {
    /// N/m.
    #[param]
    pub stiffness: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.1, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.1, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[force(
        between = [ground, block],
        head = [-1.0, 0.0, 0.0],
        tail = [0.1, 0.0, 0.0],
        stiffness = stiffness,
        free_length = 1.0
    )]
    spring: SpringDamper,
}

/// A rod of 1 m and 1 kg on a hinge that is made of a ball in the origin and a point on the line of
/// the axis, `apart` (m) from it: the nearer, the more nearly dependent are their equations.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub struct TwoPoints {
    /// m.
    #[param]
    pub apart: f64,
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 1e-3, 1.0 / 12.0], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    ball: Spherical,
    #[joint(between = [ground, rod], point = [apart, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
}

/// A rod of 1 m and 1 kg on a hinge, without gravity, turned by a moment.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both")]
pub struct Turned {
    /// N m.
    #[input]
    pub moment: f64,
    #[body(mass = 1.0, inertia = [1.0 / 12.0, 1e-3, 1.0 / 12.0], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[force(between = [ground, rod], moment = [moment, 0.0, 0.0])]
    motor: ConstantMoment,
}
