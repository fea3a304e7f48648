//! Arrays of what is none, and arrays that nothing is said of.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Roles {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    rods: [Body; 3],
    #[body(mass = 1.0)]
    numbers: [f64; 3],
    #[joint(between = [ground, rods[k]], point = [0.0, 0.0, 0.0])]
    counters: [u32; 3],
    #[body(mass = 1.0)]
    pivots: [Revolute; 3],
    nothing: [Body; 3],
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], free)]
    ground: [Body; 2],
}

fn main() {
    let _ = Roles::HANDLES.counters[2];
}
