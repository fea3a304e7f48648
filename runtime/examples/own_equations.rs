//! Equations of one's own under the integrators of the library: an electric motor that drives a
//! flywheel, with its current as a state.
//!
//! ```text
//! cargo run -p holonom --example own_equations
//! ```

use holonom::integrate::{Advance, Integration, Integrator, OneStep, System, TimeSpan};
use holonom::prelude::*;

/// `L i' = u - R i - K w` and `J w' = K i - d w`.
struct Motor {
    /// Voltage (V).
    voltage: f64,
    /// Resistance (ohm) and inductance (H).
    resistance: f64,
    inductance: f64,
    /// Torque by current (N m/A), which is voltage by speed (V s/rad).
    constant: f64,
    /// Moment of inertia (kg m^2) and damping (N m s/rad).
    inertia: f64,
    damping: f64,
}

/// The state: current (A) and speed (rad/s).
impl System<f64> for Motor {
    type State = [f64; 2];

    fn rates(&mut self, _time: f64, &[current, speed]: &[f64; 2]) -> Result<[f64; 2], Fault> {
        Ok([
            (self.voltage - self.resistance * current - self.constant * speed) / self.inductance,
            (self.constant * current - self.damping * speed) / self.inertia,
        ])
    }
}

fn main() -> Result<(), Fault> {
    let mut motor = Motor {
        voltage: 12.0,
        resistance: 0.5,
        inductance: 1e-3,
        constant: 0.05,
        inertia: 2e-4,
        damping: 1e-5,
    };
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
    println!(
        "{fixed:?} and {adaptive:?} (A, rad/s), {:?}",
        integration.counts()
    );
    assert!((fixed[1] - adaptive[1]).abs() < 1e-2);
    // The speed at which the voltage is used up, but for what damping takes.
    assert!(fixed[1] > 200.0 && fixed[1] < 12.0 / 0.05);
    Ok(())
}
