//! Limits that are asked for, of a mechanism that has none.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Loose {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {
    let [_] = Loose::default().limits::<f64>();
}
