//! Numbers that the macro cannot see and the compiler does not know either.

use holonom::prelude::*;

const COUNT: usize = 3;

#[derive(Mechanism)]
struct Unknown {
    #[body(mass = WEIGHT, position = [COUNT, 0.0, 0.0], free)]
    rod: Particle,
}

fn main() {}
