//! States of the user's own, and what their rates may read.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Motor {
    #[param]
    resistance: f64,
    #[input]
    voltage: f64,
    #[state(rate = voltage - resistence * current)]
    current: f64,
    #[state]
    bare: f64,
    #[state(start = 1.0)]
    without: f64,
    #[state(rat = 1.0)]
    misspelt: f64,
    #[state(rate = 1.0, start = resistance)]
    unseen: f64,
    #[state(rate = 1.0, start = [1.0, 2.0])]
    several: f64,
    #[state(rate = 1.0, start = "1.0")]
    text: f64,
    #[state(rate = 1.0, start = 1.0 / 0.0)]
    infinite: f64,
    #[state(rate = [1.0, 0.0, 0.0])]
    vector: f64,
    #[state(rate = 1.0)]
    wide: [bool; 2],
    #[state(rate = 1.0)]
    single: f32,
    #[state(rate = shaft.angle)]
    body: f64,
    #[state(rate = bering.rate)]
    near: f64,
    #[state(rate = bearing.acceleration)]
    acceleration: f64,
    #[state(rate = bearing.reaction)]
    reaction: f64,
    #[state(rate = bearing.displacement)]
    displacement: f64,
    #[state(rate = sleeve.rate)]
    which: f64,
    #[state(rate = tan(current) + current % 2.0)]
    functions: f64,
    #[state(rate = bearings[2].rate)]
    beyond: f64,
    #[state(rate = if current { 1.0 } else { 0.0 })]
    branch: f64,
    #[state(rate = 1.0)]
    time: f64,
    #[body(mass = current, inertia = [1.0, 1.0, 1.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearings: [Revolute; 2],
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    sleeve: Cylindrical,
    #[joint(between = [ground, shaft], point = [current, 0.0, 0.0])]
    socket: Spherical,
    #[joint(between = [ground, shaft], axis = [0.0, 0.0, 1.0], motion = current * time)]
    driver: AngleDriver,
    #[force(between = [ground, shaft], axis = [0.0, 0.0, 1.0], stiffness = current)]
    spring: TorsionalSpringDamper,
    #[force(between = [ground, shaft], head = [0.0, 0.0, 1.0], tail = [0.0, 1.0, 0.0], force = curent)]
    pull: Actuator,
}

/// A state bears the name of an argument of a law.
#[derive(Mechanism)]
struct Named {
    #[state(rate = 1.0)]
    rate: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[force(between = [ground, shaft], axis = [0.0, 0.0, 1.0], moment = -rate)]
    drag: TorsionalActuator,
}

fn main() {
    let motor = Motor::new(1.0).unwrap();
    // Handles are there beside the refusals.
    let _ = motor.described_state::<f64>().map(|state| Motor::state_value(&state, Motor::HANDLES.current));
}
