//! The first hour: no default, an observer that may fail, a handle of another kind.

use holonom::prelude::*;

#[derive(Mechanism)]
struct Pendulum {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5 * length, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[param]
    length: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let _ = Pendulum::default();
    let pendulum = Pendulum::new(1.0)?;
    let handles = Pendulum::HANDLES;
    let simulation = pendulum.simulation(StandardLagrange, DormandPrince::default());
    simulation.clone().run(0.0..=1.0, every(0.1), |sample| {
        let _ = sample.reaction(handles.pivot, handles.rod)?;
    })?;
    simulation.run(0.0..=1.0, every(0.1), |sample| {
        let _ = sample.angle(handles.rod);
        let _ = sample.position(handles.pivot);
    })?;
    Ok(())
}
