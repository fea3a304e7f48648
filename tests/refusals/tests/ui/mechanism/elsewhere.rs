//! Words of other tools.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Pendulum {
    #[body(shape = cuboid(size = [0.1, 0.1, 1.0]), density = 7800.0)]
    rod: Body,
    #[body(shape = cylinder(diameter = 0.1, from = [0.0, 0.0, 0.0], to = [0.0, 1.0, 0.0]), density = 7800 kg/m^3)]
    bob: Body,
    #[joint(between = [world, rod], anchor = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(parent = rod, child = bob, point = [0.0, 1.0, 0.0])]
    held: Spherical,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], torque = 1.0)]
    motor: TorsionalActuator,
}

fn main() {
    let _ = Pendulum::default();
}
