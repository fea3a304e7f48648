//! A method moves what has what it needs: rigid constraints, or velocities beside coordinates.

use holonom::GeneralizedAlpha;
use holonom::SemiImplicitEuler;
use holonom::integrate::{Integrator, OneStep, TimeSpan, System};
use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Rod {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.0, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
}

struct Decay;

impl System<f64> for Decay {
    type State = [f64; 1];

    fn rates(&mut self, _time: f64, state: &[f64; 1]) -> Result<[f64; 1], Fault> {
        Ok([-state[0]])
    }
}

fn main() {
    let rod = Rod::default();
    let alpha = GeneralizedAlpha::every(0.01);
    let on = |_: &Sample<'_, f64, Rod>| ControlFlow::Continue(());
    let _ = Simulation::new(&rod, StandardLagrange, alpha).joint_coordinates().run(0.0..=1.0, every(0.1), on);
    let _ = Simulation::new(&rod, Penalty::default(), alpha).run(0.0..=1.0, every(0.1), on);
    let span = TimeSpan { start: 0.0, end: 1.0, first_output: 1.0 };
    let _ = alpha.start(&mut Decay, span, [1.0]);
    let _ = SemiImplicitEuler.step(&mut Decay, 0.0, &mut [1.0], 0.1);
}
