//! Joints that are not there: forgotten, renamed by an alias, misspelt.

use core::ops::ControlFlow;

use holonom::joints::Revolute;
use holonom::{Body, Mechanism, Rk4, Simulation, StandardLagrange, every};

/// No `use`.
#[derive(Mechanism)]
struct Forgotten {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0])]
    ball: Spherical,
}

/// A type by itself: the definition is not behind it.
type Hinge = Revolute;

#[derive(Mechanism)]
struct Alias {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Hinge,
}

#[derive(Mechanism)]
struct Misspelt {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolut,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for time in [0.0, 1.0] {
        let forgotten = Forgotten::default();
        let handles = Forgotten::HANDLES;
        Simulation::new(&forgotten, StandardLagrange, Rk4::every(1e-3))
            .run(time..=1.0, every(0.1), |sample| {
                let _ = sample.pose(handles.rod);
                ControlFlow::Continue(())
            })?;
    }
    let _ = (Alias::default(), Alias::HANDLES.hinge, Misspelt::default());
    Ok(())
}
