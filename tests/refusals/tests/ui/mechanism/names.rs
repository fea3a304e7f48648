//! Names that mean something else already, and operators that are none.

use holonom::forces::{Actuator, TorsionalActuator};
use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Grounded {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    ground: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

#[derive(Mechanism)]
struct Shadowed {
    #[param]
    length: f64,
    #[input]
    rate: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, length * length])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[force(between = [ground, rod], head = [0.0, 0.0, 1.0], tail = [0.0, 0.5, 0.0], force = -10.0 * (length - 0.5) - rate)]
    cylinder: Actuator,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = -length * angle)]
    motor: TorsionalActuator,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = -angle^2)]
    power: TorsionalActuator,
}

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -3^2])]
struct Twice {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() {}
