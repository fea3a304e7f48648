//! Splines, and inputs with their derivatives.

use holonom::forces::TorsionalActuator;
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

const COUNT: usize = 3;

#[derive(Mechanism)]
struct Types {
    #[param]
    points: Spline<COUNT>,
    #[param(like = 2.0)]
    typical: Spline<3>,
    #[input]
    changing: Spline<3>,
    #[input(order = 2)]
    number: f64,
    #[input(order = 1)]
    first: f64,
    #[input]
    plain: Setpoint,
    #[param]
    fixed: Setpoint,
    #[input(ordre = 2)]
    misspelt: f64,
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
struct Calls {
    #[param]
    cam: Spline<3>,
    #[param]
    size: f64,
    #[input(order = 2)]
    target: Setpoint,
    #[input]
    torque: f64,
    #[body(mass = cam, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, target], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = cam)]
    named: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = cam(time, time))]
    two: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = size(time))]
    called: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = cma(time))]
    near: AngleDriver,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = torque)]
    input: AngleDriver,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = cam[2](angle))]
    element: TorsionalActuator,
}

#[derive(Assembly)]
struct Part {
    #[port]
    frame: Body,
    #[param]
    cam: Spline<3>,
    #[input(order = 2)]
    target: Setpoint,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [frame, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() {}
