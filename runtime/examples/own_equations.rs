//! Equations of one's own under the integrators of the library: an electric motor that drives a
//! flywheel, with its current as a state.
//!
//! ```text
//! cargo run -p holonom --example own_equations
//! ```

use holonom::integrate::{Advance, Integration, Integrator, OneStep, System, TimeSpan};
use holonom::prelude::*;

/// `L i' = u - R i - K w` and `J w' = K i - d w`.
struct Motor;

const VOLTAGE: f64 = 12.0; // V
const RESISTANCE: f64 = 0.5; // ohm
const INDUCTANCE: f64 = 1e-3; // H
const CONSTANT: f64 = 0.05; // torque by current (N m/A), which is voltage by speed (V s/rad)
const INERTIA: f64 = 2e-4; // kg m^2
const DAMPING: f64 = 1e-5; // N m s/rad

/// The state: current (A) and speed (rad/s).
impl System<f64> for Motor {
    type State = [f64; 2];

    fn rates(&mut self, _time: f64, &[current, speed]: &[f64; 2]) -> Result<[f64; 2], Fault> {
        Ok([
            (VOLTAGE - RESISTANCE * current - CONSTANT * speed) / INDUCTANCE,
            (CONSTANT * current - DAMPING * speed) / INERTIA,
        ])
    }
}

fn main() -> Result<(), Fault> {
    let mut motor = Motor;
    // Single steps of one size.
    let mut fixed = [0.0; 2];
    for step in 0..5000 {
        Rk4.step(&mut motor, 1e-4 * f64::from(step), &mut fixed, 1e-4)?;
    }
    // An adaptive method, up to the same time.
    let span = TimeSpan {
        start: 0.0,
        end: 0.5,
        first_output: 0.5,
    };
    let mut integration = DormandPrince::default().start(&mut motor, span, [0.0; 2])?;
    while integration.time() < span.end {
        integration.advance(&mut motor)?;
    }
    let adaptive = *integration.state();
    println!("{fixed:?} and {adaptive:?} (A, rad/s)");
    assert!((fixed[1] - adaptive[1]).abs() < 1e-2);
    // The speed at which the voltage is used up, but for what damping takes.
    assert!(fixed[1] > 200.0 && fixed[1] < VOLTAGE / CONSTANT);
    Ok(())
}
