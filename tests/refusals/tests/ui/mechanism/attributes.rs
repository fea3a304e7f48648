//! Attributes in the wrong place, and what `#[mechanism(..)]` knows.

use holonom::joints::Spherical;
use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
#[mechanism(gravty = 9.81)]
#[body(mass = 1.0)]
#[joint(between = [ground, bead])]
struct Misplaced {
    #[mechanism(gravity = [0.0, 0.0, -9.81])]
    #[body(mass = 1.0, free)]
    bead: Particle,
    #[body(mass = 1.0, free)]
    #[joint(between = [ground, bead], point = [0.0, 0.0, 0.0])]
    both: Particle,
}

#[derive(Mechanism)]
#[mechanism(gravity = 9.81)]
struct Scalar {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
#[mechanism]
#[mechanism = 3]
struct Lists {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
struct Bodiless {
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    held: Spherical,
}

fn main() {}
