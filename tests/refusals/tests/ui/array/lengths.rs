//! How many elements an array has.

use holonom::joints::Spherical;
use holonom::prelude::*;

const N: usize = 4;

#[derive(Mechanism)]
struct Named {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, k, 0.0])]
    links: [Body; N],
    // Which of these elements are there is not known: nothing is said of them.
    #[joint(between = [links[0], links[k + 1]], point = [0.0, k, 0.0])]
    pins: [Spherical; 3],
    #[joint(between = [ground, links[0]], point = [0.0, 0.0, 0.0], pitch = 2.0)]
    base: Spherical,
}

#[derive(Mechanism)]
struct Odd {
    #[body(mass = 1.0, free)]
    none: [Particle; 0],
    #[body(mass = 1.0, free)]
    many: [Particle; 1001],
    #[body(mass = 1.0, free)]
    table: [[Particle; 2]; 3],
    #[param]
    values: [f64; 2 * 3],
}

fn main() {
    let _ = Named::HANDLES.links[3];
    let _ = Odd::HANDLES.table;
    let _ = Odd::new([0.0; 6]);
}
