//! Laws: what is no expression of time and arguments.

use holonom::forces::Actuator;
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

#[derive(Mechanism)]
struct Laws {
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 2.0 * time + sin(time).powi(2))]
    power: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = if time > 1.0 { 1.0 } else { 0.0 })]
    cases: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = tan(time) + smoothstep(time))]
    functions: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = torque)]
    input: AngleDriver,
    #[force(between = [ground, rod], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = -3.0 * rate.abs())]
    method: Actuator,
    #[force(between = [ground, rod], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 1.0], force = exp(length, rate))]
    two: Actuator,
}

fn main() {}
