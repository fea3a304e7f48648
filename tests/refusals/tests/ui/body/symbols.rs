//! Numbers that the macro cannot see are checked by the compiler.

use holonom::prelude::*;

const WEIGHT: f64 = -7.02;
const MOMENT: f64 = 0.0;

#[derive(Mechanism)]
struct Negative {
    #[body(mass = WEIGHT, inertia = [1.0, MOMENT, 1.0], free)]
    rod: Body,
}

fn main() {}
