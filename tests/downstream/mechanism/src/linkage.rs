//! Joints by every kind of path.

use downstream_joints::Revolute as Bush;
use downstream_reexport::{Link, means};
use mech::Mechanism;
use mech::joints::{Revolute, Spherical};
use mech::{Body as Rigid, Particle as Mass};

/// Half the distance between the bearings (m).
pub const HALF: f64 = 0.5;

/// Two bars and a load between them.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Linkage {
    /// Turns in a built-in hinge.
    #[body(mass = 1.0, inertia = [0.1, 0.02, 0.1], position = [-HALF, 0.5, 0.0])]
    left: Rigid,
    #[body(mass = 1.5 * crate::linkage::HALF, inertia = [0.1, 0.02, 0.1], position = [crate::linkage::HALF, 0.5, 0.0])]
    right: mech::Body,
    #[body(mass = 3.0, position = [0.0, 0.5, 0.0])]
    load: Mass,
    #[cfg(any())]
    #[body(mass = "left out before the derive sees it")]
    missing: Nothing,
    #[joint(between = [ground, left], point = [-HALF, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, right], pin = [HALF, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bush: Bush,
    #[joint(
        between = [left, right, load],
        left = [-HALF, 0.5, 0.0],
        right = [HALF, 0.5, 0.0],
        middle = [0.0, 0.5, 0.0]
    )]
    middle: means::Midpoint,
    #[joint(between = [left, right], head = [-HALF, 1.0, 0.0], tail = [HALF, 1.0, 0.0], length = 2.0 * HALF)]
    link: Link,
    #[joint(between = [left, right], head = [-HALF, 0.2, 0.0], tail = [HALF, 0.4, 0.0], length = 1.0)]
    rod: ::downstream_joints::Rod,
    #[joint(between = [right], radius = 0.7)]
    sphere: downstream_reexport::swapped::Rod,
    #[joint(between = [ground, right], point = [HALF, 0.0, 0.0])]
    ball: Spherical,
    #[joint(between = [left, right], point = [0.0, 0.5, 0.0], seat = [0.0, 1.0, 0.0], play = 0.1)]
    seat: downstream_reexport::all::Spherical,
}
