//! A loop at a fixed rate, as on a controller: single precision, no heap, a fixed cost per step.
//! `guide::embedded` has the same as firmware, from `cargo new` to a number in QEMU.
//!
//! ```text
//! cargo run -p holonom --example embedded
//! ```

use holonom::prelude::*;

/// A cart of 1 kg on a rail, and a rod of 0.6 m that is hinged to it.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct CartPole {
    #[input]
    push: f64,
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01])]
    cart: Body,
    #[body(mass = 0.2, inertia = [0.006, 0.0001, 0.006], position = [0.0, 0.0, 0.3])]
    rod: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    rail: Prismatic,
    #[joint(between = [cart, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pin: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [0.0, push, 0.0])]
    motor: PointForce,
}

/// The period of the loop (s).
const PERIOD: f32 = 1e-3;

fn main() -> Result<(), Fault> {
    let (cart_pole, handles) = (CartPole::default(), CartPole::HANDLES);
    let mut tilted = cart_pole.described_state::<f32>()?;
    cart_pole.set_angle(&mut tilted, handles.pin, 0.2)?;
    // All that a loop needs: two values, of sizes that are known when the program is compiled.
    let mut stepper = Stepper::<Problem<_, _, f32>, _>::new(&cart_pole, StandardLagrange, Rk4)?;
    let mut state = stepper.state_of(&tilted)?;
    let sizes = [size_of_val(&stepper), size_of_val(&state)];
    println!("{sizes:?} bytes");
    for period in 0..8000 {
        let bodies = stepper.bodies(&state);
        let view = stepper.view(&bodies);
        let y = view.displacement(handles.rail);
        let speed = view.displacement_rate(handles.rail);
        let (angle, rate) = (view.angle(handles.pin), view.angle_rate(handles.pin));
        let push = 1.0 * y + 2.5 * speed - 35.0 * angle - 7.0 * rate;
        if period % 500 == 0 {
            println!("{:.1} s: {y:7.3} m, {angle:7.4} rad", stepper.time());
        }
        stepper.step_with(&mut state, &InputsOf::<CartPole, f32> { push }, PERIOD)?;
    }
    let bodies = stepper.bodies(&state);
    assert!(stepper.view(&bodies).angle(handles.pin).abs() < 1e-2);
    Ok(())
}
