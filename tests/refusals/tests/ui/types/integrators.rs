//! A run takes a method with its steps, a stepper one without; joints are asked for.

use holonom::integrate::DormandPrince5;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Stone {
    #[body(free, mass = 1.0)]
    stone: Particle,
}

fn main() {
    let model = Stone::default();
    let _ = Simulation::new(&model, StandardLagrange, Rk4);
    let _ = Simulation::new(&model, StandardLagrange, DormandPrince5);
    let _ = Stepper::new(&model, StandardLagrange, Rk4::every(0.01));
    let _ = Stepper::new(&model, StandardLagrange, DormandPrince::new(Tolerance { relative: 1e-6, absolute: 1e-9 }));
    let _ = Simulation::new(&model, StandardLagrange, Rk4::every(0.01)).joint_coordinates();
}
