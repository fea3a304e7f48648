//! Masses, moments of inertia and states that no body has.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Masses {
    #[body(mass = 0.0, free)]
    weightless: Particle,
    #[body(mass = 2.0 - 3.5, free)]
    negative: Particle,
    #[body(mass = 1.0 / 0.0, free)]
    infinite: Particle,
    #[body(mass = sqrt(-1.0), free)]
    imaginary: Particle,
    #[body(mass = 1e300, position = [1e-300, 0.0, 0.0], free)]
    beyond: Particle,
}

#[derive(Mechanism)]
struct Moments {
    #[body(mass = 1.0, inertia = [0.0, 0.1, 0.1], free)]
    thin: Body,
    #[body(mass = 1.0, inertia = [1.0, -2.0, 1.0], free)]
    negative: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.2, 0.4], free)]
    impossible: Body,
    #[body(mass = 1.0, inertia = [[1.0, 0.9, 0.0], [0.9, 1.0, 0.0], [0.0, 0.0, 1.0]], free)]
    hidden: Body,
    #[body(mass = 1.0, inertia = [[1.0, 0.2, 0.0], [0.1, 1.0, 0.0], [0.0, 0.0, 1.0]], free)]
    lopsided: Body,
    #[body(mass = 1.0, inertia = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], free)]
    short: Body,
    #[body(mass = 1.0, inertia = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 1.0], free)]
    mixed: Body,
    #[body(mass = 1.0, inertia = [[crate::J, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], free)]
    late: Body,
    #[body(mass = 1.0, inertia = 0.5, free)]
    scalar: Body,
    #[body(mass = 1.0, inertia = [0.5, 0.5], free)]
    two: Body,
}

#[derive(Mechanism)]
struct Starts {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = [0.0, 0.0, 0.0, 0.0], free)]
    nowhere: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = [1.0, 0.0, 0.0], free)]
    three: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = 90.0, free)]
    angle: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rotation([0.0, 0.0, 0.0], 1.0), free)]
    axis: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], orientation = rotate([0.0, 0.0, 1.0], 1.0), free)]
    function: Body,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], velocity = [1.0, 0.0], angular_velocity = 3.0, free)]
    rates: Body,
}

#[derive(Mechanism)]
struct Numbers {
    #[body(mass = sqr(2.0), position = [sin(1.0, 2.0), "a", 2.0.sqrt()], velocity = [1.0 % 2.0, true, {1.0}], free)]
    bead: Particle,
}

/// A unit behind a number would count for nothing.
#[derive(Mechanism)]
struct Units {
    #[body(mass = 2000g, inertia = [0.1f64, 0.1f32, 1_kg], position = [0.0, 500mm, 0.0], orientation = rotation([1.0, 0.0, 0.0], 30deg), free)]
    rod: Body,
}

const J: f64 = 1.0;

fn main() {}
