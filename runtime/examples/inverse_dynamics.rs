//! A driver and inverse dynamics: what a motor must give for a prescribed motion.
//!
//! ```text
//! cargo run -p holonom --example inverse_dynamics
//! ```

use holonom::prelude::*;

/// An arm of 1 m that a motor turns from the horizontal upwards, by 90 degrees in 2 s.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Driven {
    #[body(mass = 3.0, inertia = [0.25, 0.001, 0.25], position = [0.0, 0.5, 0.0])]
    arm: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(
        between = [ground, arm], axis = [1.0, 0.0, 0.0],
        motion = deg(90.0) * smooth_step(time / 2.0)
    )]
    motor: AngleDriver,
}

/// The law leaves no motion free, so nothing has to be integrated.
const _: () = assert!(Driven::REPORT.degrees_of_freedom == 0);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (driven, handles) = (Driven::default(), Driven::HANDLES);
    driven.kinematic_analysis(StandardLagrange).run(
        0.0..=2.0,
        every(0.1),
        |sample| -> Result<(), Fault> {
            let angle = sample.angle(handles.hinge);
            let acceleration = sample.angle_acceleration(handles.hinge)?;
            let torque = sample.driving_effort(handles.motor)?;
            println!("{:.1} s: {angle:.4} rad, {torque:8.3} N m", sample.time());
            // The moment of inertia about the hinge times the acceleration, and the weight.
            let expected = (0.25 + 3.0 * 0.25) * acceleration + 3.0 * 9.81 * 0.5 * angle.cos();
            assert!((torque - expected).abs() < 1e-9);
            Ok(())
        },
    )?;
    Ok(())
}
