//! `derivatives(..)` takes parameters by name, each once.

use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [derivatives(lenght, push, length, length, warm, track)])]
struct Rod {
    #[param]
    length: f64,
    #[input]
    push: f64,
    #[param]
    track: holonom::spline::Spline<4>,
    #[state(rate = -warm)]
    warm: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, length, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = push + warm + track(time))]
    motor: TorsionalActuator,
}

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [derivatives(), mass(length)])]
struct Bar {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {}
