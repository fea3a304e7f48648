//! A Python module of some mechanisms.

#![deny(unsafe_code)]

use holonom::prelude::*;
use holonom_models::{HeavyTop, Ur5};

/// A uniform rod on a hinge about x, which a motor turns; level at the start.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse, jacobian])]
struct Rod {
    /// The length (m).
    #[param]
    length: f64,
    /// The mass (kg).
    #[param]
    mass: f64,
    /// The moment of the motor (N m).
    #[input]
    torque: f64,
    #[body(
        mass = mass,
        inertia = [mass * length * length / 12.0, 1e-4, mass * length * length / 12.0],
        position = [0.0, 0.5 * length, 0.0]
    )]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
    #[point(on = rod, at = [0.0, length, 0.0])]
    tip: Point,
}

/// A four-bar in the plane z = 0 with a motor and a damper at its crank, described
/// with both upright. The rocker ends at stops.
#[derive(Mechanism)]
#[mechanism(
    gravity = [0.0, -9.81, 0.0],
    redundant = "drop",
    coordinates = "joints",
    kernels = [mass, inverse, jacobian]
)]
struct FourBar {
    /// The length of the crank (m).
    #[param(like = 0.25)]
    crank_length: f64,
    /// The distance of the feet (m).
    #[param(like = 0.9)]
    base: f64,
    /// The moment of the motor at the crank (N m).
    #[input]
    torque: f64,
    #[body(mass = 0.5, inertia = [0.0026, 1e-5, 0.0026], position = [0.0, 0.5 * crank_length, 0.0])]
    crank_link: Body,
    #[body(mass = 1.6, inertia = [1e-5, 0.0853, 0.0853], position = [0.45, crank_length, 0.0])]
    coupler: Body,
    #[body(mass = 1.2, inertia = [0.036, 1e-5, 0.036], position = [base, 0.3, 0.0])]
    rocker_link: Body,
    #[joint(between = [ground, crank_link], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    crank: Revolute,
    #[joint(between = [crank_link, coupler], point = [0.0, crank_length, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    // It closes the loop.
    #[joint(between = [coupler, rocker_link], point = local([0.45, 0.0, 0.0], [0.0, 0.3, 0.0]), axis = [0.0, 0.0, 1.0])]
    knee: Revolute,
    #[joint(
        between = [ground, rocker_link],
        point = [base, 0.0, 0.0],
        axis = [0.0, 0.0, 1.0],
        limits = [-1.2, 0.7],
        restitution = 0.3
    )]
    rocker: Revolute,
    #[force(between = [ground, crank_link], axis = [0.0, 0.0, 1.0], moment = torque - 0.1 * rate)]
    motor: TorsionalActuator,
}

/// A rotor that a current drives, which a voltage drives.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass, inverse, jacobian])]
struct Drive {
    /// The voltage (V) on 0.5 ohm and 0.1 H.
    #[input]
    voltage: f64,
    /// The current (A).
    #[state(rate = (voltage - 0.5 * current) / 0.1, start = 0.3)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = 0.8 * current)]
    motor: TorsionalActuator,
}

holonom_python::module! {
    /// Linkages and arms.
    mod linkages;

    Rod {
        height: "height of the tip (m)" = |view| view.position(Rod::HANDLES.tip).z,
    }

    FourBar(crank) {
        coupler_height: "height of the coupler's centre of mass (m)" = |view| view.position(FourBar::HANDLES.coupler).y,
    }

    Drive {
        flow: "current (A)" = |view| view.state_value(Drive::HANDLES.current),
    }

    Ur5;

    runs HeavyTop;
}
