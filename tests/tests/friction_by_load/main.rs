//! Friction by the load of a joint, against closed forms and against reductions to minimal
//! coordinates of their own: `reference.py`.

#![forbid(unsafe_code)]

mod crank;
mod incline;
mod painleve;
mod pendulum;
mod reference;
mod refused;
mod screws;
mod slides;
mod spatial;

use holonom::prelude::*;

const GRAVITY: f64 = 9.81;

/// A block of 2 kg on a plane that falls by 3 in 4 along x.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
struct Incline {
    #[body(mass = 2.0, inertia = [0.1, 0.1, 0.1])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.8, 0.0, -0.6])]
    slide: Prismatic,
}

fn tight() -> Tolerance<f64> {
    Tolerance {
        relative: 1e-12,
        absolute: 1e-12,
    }
}
