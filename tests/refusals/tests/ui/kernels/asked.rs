//! Kernels that were not asked for.

use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(coordinates = "joints", kernels = [mass])]
struct Asked {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Unasked {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0], position = [0.0, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn main() -> Result<(), Fault> {
    let space = Asked::default().coordinates([Asked::HANDLES.hinge])?;
    let state = space.state([0.0_f64], [0.0])?;
    space.inverse(&state, [0.0])?;
    let rod = Unasked::default();
    rod.coordinates([Unasked::HANDLES.hinge])?;
    Ok(())
}
