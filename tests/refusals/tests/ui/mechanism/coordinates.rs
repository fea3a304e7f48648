//! By what a mechanism is described.

use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(coordinates = "joint")]
struct Misspelt {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

fn main() {}
