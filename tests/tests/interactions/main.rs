//! Limits, dry friction, brakes and clutches, against closed forms.

#![forbid(unsafe_code)]

mod block;
mod bounces;
mod contacts;
mod currents;
mod described;
mod descriptions;
mod factors;
mod faults;
mod freewheels;
mod loops;
mod ropes;
mod shafts;
mod steps;
mod switched;
mod told;
mod turns;
mod verified;

use holonom::prelude::*;
use holonom_fixtures::{Ball, Rod};

const GRAVITY: f64 = 9.81;

/// A block of 2 kg on a slide along x, pushed by an input.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Block {
    #[input]
    push: f64,
    #[param]
    stiffness: f64,
    #[param]
    ramp: f64,
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    slide: Prismatic,
    #[force(between = [ground, block], head = [-9.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], force = push + ramp * time)]
    motor: Actuator,
    #[force(between = [ground, block], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], stiffness = stiffness, free_length = 5.0)]
    spring: SpringDamper,
}

/// Two links in a plane without gravity.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Arm {
    #[body(mass = 3.0, inertia = [0.25, 0.01, 0.25], position = [0.0, 0.5, 0.0])]
    upper: Body,
    #[body(mass = 2.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 1.4, 0.0])]
    lower: Body,
    #[joint(between = [ground, upper], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    shoulder: Revolute,
    #[joint(between = [upper, lower], point = [0.0, 1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    elbow: Revolute,
}

/// Three balls of 1 kg on a rail along x, the second and the third 0.5 m apart.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Row {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    a: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.0, 0.0, 0.0])]
    b: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [1.5, 0.0, 0.0])]
    c: Body,
    #[joint(between = [ground, a], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    first: Prismatic,
    #[joint(between = [ground, b], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    second: Prismatic,
    #[joint(between = [ground, c], point = [1.5, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    third: Prismatic,
}

/// A free rod of 1 m along y, 2 kg, whose end falls on a plane.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Falling {
    #[body(free, mass = 2.0, inertia = [1.0 / 6.0, 0.01, 1.0 / 6.0], position = [0.0, 0.0, 1.0])]
    rod: Body,
    #[point(on = rod, at = [0.0, 0.5, 1.0])]
    end: Point,
    #[point(on = rod, at = [0.0, -0.5, 1.0])]
    other: Point,
    #[point(on = rod, at = [0.0, 0.2, 1.0])]
    foot: Point,
    #[point(on = rod, at = [0.0, -0.2, 1.0])]
    other_foot: Point,
    #[point(on = ground, at = [0.0, 0.5, 2.0])]
    nail: Point,
}

/// A motor, and an output with two gears.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Gearbox {
    #[input]
    torque: f64,
    #[input]
    load: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.0, 0.0, 0.0])]
    motor: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, 0.0])]
    output: Body,
    #[joint(between = [ground, motor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    input_shaft: Revolute,
    #[joint(between = [ground, output], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    output_shaft: Revolute,
    #[force(between = [ground, motor], axis = [0.0, 0.0, 1.0], moment = torque)]
    drive: TorsionalActuator,
    #[force(between = [ground, output], axis = [0.0, 0.0, 1.0], moment = -load)]
    resistance: TorsionalActuator,
}

/// A crank of 0.3 m about x, and a slider along y on a rod of 1 m: one loop.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Crank {
    #[body(mass = 2.0, inertia = [0.05, 0.01, 0.05], position = [0.0, 0.0, 0.15])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01], position = [0.0, 1.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, slider], point = [0.0, 1.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [crank, slider], head = [0.0, 0.0, 0.3], tail = [0.0, 1.0, 0.0])]
    rod: Distance,
}

/// A belt that a driver moves at 1 m/s, and a block of 1 kg on it, held by a spring.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Belt {
    #[body(mass = 5.0, inertia = [0.1, 0.1, 0.1], velocity = [1.0, 0.0, 0.0])]
    belt: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], velocity = [1.0, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, belt], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    rollers: Prismatic,
    #[joint(between = [belt, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    top: Prismatic,
    #[joint(between = [ground, belt], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0], motion = time)]
    motor: DisplacementDriver,
    #[force(between = [ground, block], head = [-5.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0], stiffness = 100.0, free_length = 5.0)]
    spring: SpringDamper,
}

fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    }
}
