//! A user's struct is no joint.

use holonom::prelude::*;

struct Glue;

#[derive(Mechanism)]
struct Glued {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod])]
    glue: Glue,
}

fn main() {
    let glued = Glued::default();
    let _ = glued.described_state::<f64>();
}
