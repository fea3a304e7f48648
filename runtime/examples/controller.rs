//! A controller with an input: called once a period, its torque is held until the next call.
//!
//! ```text
//! cargo run -p holonom --example controller
//! ```

use holonom::prelude::*;

/// An arm of 1 m with a motor in its hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Arm {
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.083, 0.001, 0.083], position = [0.0, 0.5, 0.0])]
    link: Body,
    #[joint(between = [ground, link], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, link], axis = [1.0, 0.0, 0.0], moment = torque)]
    motor: TorsionalActuator,
}

/// The field of the inputs is that of the struct.
type Inputs = InputsOf<Arm>;

/// The period of the controller (s).
const PERIOD: f64 = 1e-3;

/// The angle that is wanted (rad).
const WANTED: f64 = 0.5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (arm, handles) = (Arm::default(), Arm::HANDLES);
    let mut stepper = Stepper::new(&arm, StandardLagrange, Rk4)?;
    let mut state = arm.described_state()?;
    let mut integral = 0.0; // the memory of the controller
    for period in 0..5000 {
        let view = stepper.view(&state);
        let (angle, rate) = (view.angle(handles.hinge), view.angle_rate(handles.hinge));
        integral += (WANTED - angle) * PERIOD;
        let torque = 30.0 * (WANTED - angle) + 40.0 * integral - 6.0 * rate;
        if period % 500 == 0 {
            println!("{:.1} s: {angle:.4} rad, {torque:.3} N m", stepper.time());
        }
        stepper.step_with(&mut state, &Inputs { torque }, PERIOD)?;
    }
    assert!((stepper.view(&state).angle(handles.hinge) - WANTED).abs() < 1e-2);
    Ok(())
}
