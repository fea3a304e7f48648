//! Parameters and inputs.

use holonom::joints::Distance;
use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -weight])]
struct Types {
    #[param]
    weight: f32,
    #[param(default = 3.0)]
    listed: f64,
    #[param = 3.0]
    given: f64,
    #[param]
    vector: (f64, f64, f64),
    #[input]
    torque: Option<f64>,
    #[param]
    time: f64,
    #[param]
    #[input]
    both: f64,
    #[body(mass = 1.0, free)]
    bead: Particle,
}

#[derive(Mechanism)]
struct Places {
    #[param]
    mass: f64,
    #[input]
    torque: f64,
    #[body(mass = torque, free)]
    heavy: Particle,
    #[body(mass = mass, position = [0.0, torque, 0.0])]
    placed: Particle,
    #[joint(between = [ground, placed], head = [torque, 0.0, 0.0], tail = [0.0, 0.0, 0.0], length = 2.0 * torque)]
    rod: Distance,
    #[body(mass = 1.0, inertia = [[1.0, 0.0, 0.0], [0.0, mass, 0.0], [0.0, 0.0, 1.0]], free)]
    tensor: Body,
    #[body(mass = mass, inertia = mass, free)]
    scalar: Body,
}

#[derive(Mechanism)]
struct Misspelt {
    #[param]
    mass: f64,
    #[body(mass = masss, free)]
    bead: Particle,
    #[body(mass = 2.0 * size, free)]
    other: Particle,
    #[body(mass = sqr(mass), free)]
    function: Particle,
}

fn main() {
    let _ = Types::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
    let _ = Places::new(1.0);
    let misspelt = Misspelt::new(1.0);
    let _ = misspelt.map(|misspelt| misspelt.described_state::<f64>());
}
