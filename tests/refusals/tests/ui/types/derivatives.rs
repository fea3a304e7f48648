//! Derivatives go through explicit methods.

use holonom::joints::Revolute;
use holonom::prelude::*;
use holonom::{ImplicitMidpoint, RadauIIA};

#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Rod {
    #[param]
    mass: f64,
    #[body(mass = mass, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
}

fn main() {
    let (rod, h) = (Rod::new(1.0).unwrap(), Rod::HANDLES);
    let along = rod.sensitivities([h.mass]).unwrap();
    let _ = along.simulation(StandardLagrange, RadauIIA::new(Tolerance::default()));
    let _ = along.simulation(StandardLagrange, ImplicitMidpoint::every(0.01));
    let _ = rod.sensitivities([h.rod]);
}
