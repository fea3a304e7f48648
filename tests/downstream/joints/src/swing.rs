//! An assembly for other crates: private fields, joints of this crate, the library's own under a
//! name of this crate, a part in a part.

use super::Rod;
use kinematics::joints::Revolute as Hinge;
use kinematics::mechanism::Assembly;
use kinematics::{Body, Particle};

/// How long the beam is (m). A mechanism may have a constant of this name.
const ARM: f64 = 1.0;

/// A bob on a rod.
#[derive(Assembly, Clone, Copy, Debug, PartialEq)]
pub struct Bob {
    #[port]
    beam: Body,
    #[param(like = 0.5)]
    length: f64,
    #[body(mass = 0.2, position = [0.0, 0.0, -length])]
    weight: Particle,
    #[joint(between = [beam, weight], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, -length], length = length)]
    rod: Rod,
}

/// A beam on a hinge, with a bob at its end, to the right.
#[derive(Assembly, Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    #[port]
    post: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.2], position = [ARM / 2.0, 0.0, 0.0])]
    beam: Body,
    #[joint(between = [post, beam], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    hinge: Hinge,
    #[part(beam = beam, at = [ARM, 0.0, 0.0])]
    bob: Bob,
}
