//! A mechanism beside the joint that it uses.

use kinematics::{Body, Mechanism};

kinematics::joint! {
    /// A body that slides along an axis and does not turn.
    joint Prismatic(i, j; point: Point, axis: Axis, across: Vector, along: Vector) {
        dot(i.axis.normals(), j.point - i.point);
        dot(i.axis.normals(), j.axis);
        dot(i.across, j.along);
    }
}

/// A block on a rail that rises along (0, 0.6, 0.8).
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub struct Slider {
    #[body(mass = 2.0, inertia = [0.1, 0.2, 0.15], position = [0.1, 0.6, 0.8])]
    block: Body,
    #[joint(
        between = [ground, block],
        point = [0.0, 0.3, 0.4],
        axis = [0.0, 0.6, 0.8],
        across = [1.0, 0.0, 0.0],
        along = [0.0, -0.8, 0.6]
    )]
    rail: Prismatic,
}
