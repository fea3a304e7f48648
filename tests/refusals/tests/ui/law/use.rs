//! Laws that a mechanism writes.

use holonom::forces::Actuator;
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Laws {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[body(mass = 1.0)]
    bead: Particle,
    #[input]
    torque: f64,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0])]
    missing: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motin = 3.0 * time)]
    misspelt: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 3.0 * tan(time))]
    function: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 3.0 * sine(time))]
    near: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = smooth_step(time, 2.0) + sin())]
    arguments: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = time % 2.0)]
    operator: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = [time, 0.0, 0.0])]
    vector: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = if time > 1.0 { 1.0 } else { 0.0 })]
    branch: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = |time| time)]
    closure: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = tiem * 2.0)]
    word: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = torque * time)]
    input: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = time.sin())]
    method: AngleDriver,
    #[force(between = [ground, bead], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = -3.0 * (lenght - 1.0) - rate)]
    argument: Actuator,
    #[force(between = [ground, bead], head = [0.0, 0.0, 1.0], tail = [0.0, 0.0, 0.0], force = 1.0 / 0.0)]
    infinite: Actuator,
}

fn main() {}
