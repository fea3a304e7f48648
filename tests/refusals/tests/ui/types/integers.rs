//! Times and tolerances are numbers with a point.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Bead {
    #[body(mass = 1.0, free)]
    bead: Particle,
}

fn main() {
    let bead = Bead::default();
    let _ = Simulation::new(&bead, StandardLagrange, Rk4::every(1e-3))
        .run(0..=1, every(0.1), |_| ControlFlow::Continue(()));
    let method = DormandPrince::default();
    let _ = Simulation::new(&bead, StandardLagrange, method)
        .run(0..=1, every(1), |_| ControlFlow::Continue(()));
}
