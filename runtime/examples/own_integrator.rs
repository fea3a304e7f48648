//! An integrator of one's own: the method of Ralston, of order 2 with the least error.
//!
//! ```text
//! cargo run -p holonom --example own_integrator
//! ```

use holonom::integrate::{FixedStep, Look, NoStages, OneStep, Scheme, Slopes, StepStart, System};
use holonom::prelude::*;
use holonom::state::Vector;

/// `y1 = y0 + h (k1 + 3 k2) / 4`, with `k2` at two thirds of the step (Ralston 1962).
#[derive(Clone, Copy, Debug)]
struct Ralston;

impl Scheme<f64> for Ralston {
    type Stages<X: Vector<f64>> = NoStages;

    fn stages<X: Vector<f64>>(&self, _like: &X) -> NoStages {
        NoStages
    }
}

impl<Y: System<f64>> OneStep<f64, Y> for Ralston {
    fn advanced<L: Look<f64, Y::State>>(
        &self,
        system: &mut Slopes<'_, Y, L>,
        StepStart { time, state, slope }: StepStart<'_, f64, Y::State>,
        step: f64,
        _stages: &mut NoStages,
    ) -> Result<Y::State, Fault> {
        let (mut second, part) = (slope.clone(), 2.0 / 3.0 * step);
        system.stage(time + part, &state.plus([(part, slope)]), &mut second)?;
        Ok(state.plus([(0.25 * step, slope), (0.75 * step, &second)]))
    }
}

/// A rod of 1 m on a hinge about x.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Pendulum {
    #[body(mass = 1.0, inertia = [0.0833, 0.001, 0.0833], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (pendulum, scheme) = (Pendulum::default(), Ralston);
    let angle = |step: f64| -> Result<f64, Box<dyn std::error::Error>> {
        let simulation = pendulum.simulation(StandardLagrange, FixedStep { step, scheme });
        let report = simulation.run(0.0..=0.5, every(0.5), |_| ())?;
        let view = pendulum.view(0.5, &report.state)?;
        Ok(view.angle(Pendulum::HANDLES.pivot))
    };
    let reference = angle(1e-4)?;
    let errors = [angle(0.01)?, angle(0.005)?].map(|found| (found - reference).abs());
    println!("off by {errors:?} rad after 0.5 s");
    assert!((errors[0] / errors[1] - 4.0).abs() < 0.4); // half the step, a quarter of the error
    Ok(())
}
