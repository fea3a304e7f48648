//! A fault in a definition is reported there, whatever the joint is called; one in its use,
//! whatever crate defines it.

use holonom::prelude::*;

mod joints {
    use holonom as kinematics;

    kinematics::joint! {
        /// A fault in its second equation.
        pub joint Guide(i, j; point: Point, axis: Axis) {
            dot(i.axis.normals(), j.axis);
            dot(i.axis.normals(), j.point - i.pont);
        }
    }

    kinematics::force! {
        /// A vector where a scalar belongs.
        pub force Buffer(i, j; head: Point, tail: Point, stiffness: Number) {
            potential 0.5 * stiffness * (j.tail - i.head);
        }
    }

    pub mod handed_on {
        pub use super::{Buffer, Guide as Rail};
    }
}

mod robots {
    use super::joints::handed_on::*;
    use holonom::prelude::*;

    #[derive(Mechanism)]
    pub struct Robot {
        #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
        pub rod: Body,
        #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], anything = 3.0)]
        pub rail: Rail,
        #[force(between = [ground, rod])]
        pub buffer: Buffer,
    }
}

#[derive(Mechanism)]
struct Foreign {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0)]
    bead: Particle,
    #[joint(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], lenght = 1.0)]
    link: downstream_reexport::Link,
    #[joint(between = [ground, rod, bead], point = [0.0, 0.0, 0.0], seat = 3.0, play = 0.1)]
    ball: downstream_joints::Spherical,
    #[joint(between = [ground, bead], pin = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 0.0])]
    shaft: downstream_reexport::all::Revolute,
    #[force(between = [bead], radius = 1.0)]
    sphere: downstream_reexport::swapped::Rod,
}

fn main() {
    let _ = robots::Robot::HANDLES.rail;
}
