//! What is held beside a state of the user's own.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::tight;

/// A motor with its current as a state, at 12 V.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Motor {
    #[state(rate = (12.0 - 2.0 * current - 0.5 * shaft.rate) / 0.01)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    rotor: Body,
    #[joint(between = [ground, rotor], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, rotor], axis = [0.0, 0.0, 1.0], moment = 0.5 * current)]
    motor: TorsionalActuator,
}

/// The current at a time while the rotor stands.
fn standing(time: f64) -> f64 {
    6.0 * (1.0 - (-200.0 * time).exp())
}

fn is_held<C: Coordinates<Motor>>() {
    let (motor, h) = (Motor::default(), Motor::HANDLES);
    let brakes = [Interaction::brake(h.shaft.angle(), 100.0)];
    let [brake] = Interaction::handles(&brakes);
    Simulation::new(&motor, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(brakes)
        .run(0.0..=0.03, every(0.001), |sample| {
            let (found, expected) = (sample.state_value(h.current), standing(sample.time()));
            assert!((found - expected).abs() < 1e-10, "{found} {expected}");
            let effort = sample.effort(brake).expect("one interaction");
            assert!((effort + 0.5 * expected).abs() < 1e-10, "{effort}");
        })
        .expect("it stands");
}

#[test]
fn a_brake_leaves_the_current_of_a_motor_alone() {
    is_held::<Relative>();
    is_held::<Absolute>();
}

/// The brake gives way at 4 A: at `ln(3) / 200` s.
#[test]
fn a_brake_slips_when_the_current_is_there() {
    let (motor, h) = (Motor::default(), Motor::HANDLES);
    let brakes = [Interaction::brake(h.shaft.angle(), 2.0)];
    let [brake] = Interaction::handles(&brakes);
    let mut slipped = None;
    Simulation::new(&motor, StandardLagrange, DormandPrince::new(tight()))
        .interactions(brakes)
        .run(0.0..=0.01, every(0.001), |sample| {
            if sample.mode(brake) == Ok(InteractionMode::SlidingUp) {
                slipped.get_or_insert((sample.time(), sample.state_value(h.current)));
            }
        })
        .expect("it runs");
    let (time, current) = slipped.expect("it gives way");
    assert!((time - 3.0_f64.ln() / 200.0).abs() < 1e-10, "{time}");
    assert!((current - 4.0).abs() < 1e-9, "{current}");
}

#[test]
fn a_brake_in_a_loop_of_ones_own_leaves_it_alone_too() {
    let (motor, h) = (Motor::default(), Motor::HANDLES);
    let mut stepper = motor
        .stepper(StandardLagrange, Rk4)
        .expect("sound parameters")
        .interactions([Interaction::brake(h.shaft.angle(), 100.0)]);
    let mut state = stepper.initial_state().expect("it is described");
    for _ in 0..1000 {
        stepper.step(&mut state, 1e-5).expect("it stands");
    }
    let bodies = stepper.bodies(&state);
    let (found, expected) = (stepper.view(&bodies).state_value(h.current), standing(0.01));
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
}
