//! A joint with the name of one of the library, beside the prelude.

use mech::prelude::*;

use self::mine::Gear;

/// Where it is defined.
mod mine {
    mech::joint! {
        /// Two points that coincide: nothing to do with teeth.
        pub joint Gear(i, j; point: Point) {
            j.point - i.point;
        }
    }
}

/// A rod on it, and on a joint and a spring that the prelude has.
#[derive(Clone, Copy, Debug, Mechanism)]
pub struct Swing {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    pivot: Gear,
    #[joint(between = [ground, rod], point = [0.0, 1.0, 0.0], normal = [0.0, 0.0, 1.0])]
    table: PointOnPlane,
    #[force(
        between = [ground, rod], head = [0.0, 2.0, 0.0], tail = [0.0, 1.0, 0.0],
        stiffness = 10.0, free_length = 1.0
    )]
    spring: SpringDamper,
}
