//! The time of a stepper: as right after hours as after a step.

use holonom::error::StepFault;
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

use crate::orientation::Spinning;

/// A wheel that a motor turns at 1 rad/s.
#[derive(Mechanism)]
struct Motor {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.3], angular_velocity = [0.0, 0.0, 1.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[joint(between = [ground, wheel], axis = [0.0, 0.0, 1.0], motion = time)]
    drive: AngleDriver,
}

#[test]
fn many_seconds_at_a_kilohertz_in_single_precision() {
    let motor = Motor::default();
    let mut stepper =
        Stepper::new(&motor, Baumgarte::new(50.0_f32, 50.0), Rk4).expect("acceptable");
    let mut state = motor.described_state().expect("described");
    // A sum of steps would gain 0.7 % from 128 s on, where times are 1.5e-5 s apart.
    for _ in 0..250_000 {
        stepper.step(&mut state, 1e-3).expect("driven");
    }
    let turned = stepper.view(&state).angle(Motor::HANDLES.drive);
    println!("{} s, {turned} rad", stepper.time());
    assert!((stepper.time() - 250.0).abs() < 2.5e-4);
    // Digits of the time and of the angle at 250 rad.
    assert!((turned - 250.0).abs() < 1.25e-3);
}

#[test]
fn after_eight_hours_without_a_law_of_time() {
    let body = Spinning::default();
    let start = 28_800.0_f32;
    let mut stepper = Stepper::new(&body, StandardLagrange, Rk4)
        .expect("acceptable")
        .starting_at(start);
    let mut state = body.described_state().expect("described");
    for _ in 0..100_000 {
        stepper.step(&mut state, 1e-3).expect("nothing stops it");
    }
    let passed = stepper.time() - start;
    assert!((passed - 100.0).abs() < 2e-3, "{passed}");
}

#[test]
fn microseconds_from_a_unix_time_on() {
    let motor = Motor::default();
    let body = Spinning::default();
    let start = 1.7e9;
    let mut stepper = Stepper::new(&body, StandardLagrange, Rk4)
        .expect("acceptable")
        .starting_at(start);
    let mut state = body.described_state::<f64>().expect("described");
    // A sum of these would lose a twentieth: times are 2.4e-7 s apart there.
    for _ in 0..100_000 {
        stepper.step(&mut state, 1e-6).expect("nothing stops it");
    }
    println!("{} s", stepper.time() - start);
    assert!((stepper.time() - start - 0.1).abs() < 1e-6);
    // A law sees the time to the last of its digits: 2.4e-7 s here.
    let mut stepper = Stepper::new(&motor, Baumgarte::default(), Rk4)
        .expect("acceptable")
        .starting_at(start);
    let mut state = motor.described_state::<f64>().expect("described");
    let fault = stepper
        .step(&mut state, 1e-7)
        .expect_err("below the resolution");
    assert!(
        matches!(fault, Fault::Step(StepFault::TooShort { .. })),
        "{fault}"
    );
}
