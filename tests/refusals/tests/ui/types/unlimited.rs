//! A run that is told to heed limits, of a mechanism that has none.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Loose {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {
    let _ = Loose::default().simulation(StandardLagrange, DormandPrince::default()).limits();
}
