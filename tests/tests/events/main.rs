//! Events located within steps, and controllers at their period, against closed forms.

#![forbid(unsafe_code)]

mod bounces;
mod controllers;
mod faults;
mod handlers;
mod led;
mod order;
mod relays;
mod rough;
mod single_steps;
mod switches;
mod times;

use holonom::prelude::*;
use holonom_fixtures as _;

/// A ball of 1 kg on a vertical rail, at the height 1 m.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Ball {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    ball: Body,
    #[joint(between = [ground, ball], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0])]
    rail: Prismatic,
}

/// Two balls on vertical rails, at the heights 1 m and 2 m.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Two {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 1.0])]
    low: Body,
    #[joint(between = [ground, low], point = [0.0, 0.0, 1.0], axis = [0.0, 0.0, 1.0])]
    a: Prismatic,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 2.0])]
    high: Body,
    #[joint(between = [ground, high], point = [1.0, 0.0, 2.0], axis = [0.0, 0.0, 1.0])]
    b: Prismatic,
}

/// A mass of 1 kg on a rail along x, driven by an input, with a damper.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Slider {
    #[input]
    push: f64,
    #[param]
    damping: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, slider], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rail: Prismatic,
    #[force(between = [ground, slider], head = [-9.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], force = push - damping * rate)]
    motor: Actuator,
}

const GRAVITY: f64 = 9.81;

fn height(sample: &Sample<'_, f64, Ball>) -> f64 {
    sample.pose(Ball::HANDLES.ball).position.z
}

fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    }
}
