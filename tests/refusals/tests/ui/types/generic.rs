//! Generic arguments on a joint or a body are refused by the compiler.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Arguments {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body<f64>,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute<f64>,
}

fn main() {
    let _ = Arguments::default();
}
