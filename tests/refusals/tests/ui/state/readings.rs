//! What can be read of a joint or a force.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Readings {
    #[state(rate = socket.angle)]
    ball: f64,
    #[state(rate = spring.rate)]
    stretch: f64,
    #[state(rate = pull.lenght)]
    way: f64,
    #[state(rate = pull.0)]
    number: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0])]
    socket: Spherical,
    #[force(between = [ground, shaft], axis = [0.0, 0.0, 1.0], stiffness = 1.0)]
    spring: TorsionalSpringDamper,
    #[force(between = [ground, shaft], head = [0.0, 0.0, 1.0], tail = [0.0, 1.0, 0.0], force = -ball)]
    pull: Actuator,
}

fn main() {}
