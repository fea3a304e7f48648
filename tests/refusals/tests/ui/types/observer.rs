//! An observer returns nothing, or whether the run goes on.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Rod {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() {
    let rod = Rod::default();
    let _ = Simulation::new(&rod, StandardLagrange, Rk4::every(0.01)).run(0.0..=1.0, every(0.1), |sample| sample.time());
}
