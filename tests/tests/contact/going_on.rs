//! Runs that go on from checkpoints, steps in a loop of one's own, and single precision.

use holonom::prelude::*;
use holonom::run::{Checkpoint, InteractionMode};

use super::balls::{Bowling, floor, start};
use super::tight;

type Report = RunReport<f64, Bowling>;

/// A ball that falls with spin, bounces, slips and rolls; from a checkpoint on, where there is one.
fn bounces(from: Option<&Checkpoint<Bowling>>) -> (Report, Vec<Checkpoint<Bowling>>) {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let contact = Interaction::contact(h.ball, floor())
        .radius(0.1)
        .restitution(0.5)
        .with_friction(0.2);
    let mut kept = Vec::new();
    let mut simulation = bowling
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(start([0.0, 0.0, 0.2], [3.0, 1.0, 0.0], [5.0, -8.0, 20.0]))
        .interactions(contact)
        .checkpoints(7, |checkpoint| kept.push(checkpoint.clone()));
    let report = match from {
        Some(checkpoint) => simulation.resume(checkpoint, |_| ()),
        None => simulation.run(0.0..=2.0, every(0.1), |_| ()),
    };
    (report.expect("it goes on"), kept)
}

#[test]
fn a_ball_that_slips_goes_on_to_the_last_bit() {
    let (whole, kept) = bounces(None);
    assert!(kept.len() > 20, "{}", kept.len());
    for checkpoint in kept.iter().step_by(kept.len() / 6) {
        let (resumed, _) = bounces(Some(checkpoint));
        assert_eq!(resumed, whole);
    }
}

#[test]
fn a_stepper_finds_the_modes_of_a_run() {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let contact = Interaction::contact(h.ball, floor())
        .radius(0.1)
        .with_friction(0.2);
    let [_, along, _] = Interaction::handles(&contact);
    let mut stepper = bowling
        .stepper(StandardLagrange, Rk4)
        .expect("it has no parameters")
        .interactions(contact);
    let thrown = start([0.0, 0.0, 0.1], [8.0, 0.0, 0.0], [0.0; 3]);
    let mut state = stepper.state_of(&thrown).expect("a state");
    let rolls = 2.0 * 8.0 / (7.0 * 0.2 * 9.81);
    while stepper.time() < 2.0 {
        stepper.step(&mut state, 0.01).expect("it moves");
        let sticks = stepper.mode(along) == Ok(InteractionMode::Sticking);
        assert_eq!(sticks, stepper.time() > rolls, "{}", stepper.time());
    }
    let bodies = stepper.bodies(&state);
    let speed = stepper.view(&bodies).velocity(h.ball).x;
    assert!((speed - 40.0 / 7.0).abs() < 1e-9, "{speed}");
}

#[test]
fn single_precision_rolls_too() {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let contact = Interaction::contact(
        h.ball,
        holonom::run::Plane::on_ground([0.0_f32; 3], [0.0, 0.0, 1.0]),
    )
    .radius(0.1)
    .with_friction(0.2);
    let [_, along, _] = Interaction::handles(&contact);
    let mut state: StateOf<Bowling, f32> = bowling.described_state().expect("it is described");
    Bowling::set_velocity(&mut state, h.ball, [8.0, 0.0, 0.0].into());
    let mut modes = Vec::new();
    let report = Simulation::new(&bowling, StandardLagrange, Rk4::every(0.01))
        .initial_state(state)
        .interactions(contact)
        .run(0.0_f32..=2.0, every(0.1), |sample| {
            modes.push(sample.mode(along))
        })
        .expect("it rolls");
    assert_eq!(modes.first(), Some(&Ok(InteractionMode::Slipping)));
    assert_eq!(modes.last(), Some(&Ok(InteractionMode::Sticking)));
    let view = bowling.view(2.0, &report.state).expect("a view");
    assert!((view.velocity(h.ball).x - 40.0 / 7.0).abs() < 1e-4);
}

/// A wet floor: the coefficient of a contact is a function of the motion.
#[test]
fn a_factor_of_friction_is_that_of_both_directions() {
    let (bowling, h) = (Bowling::default(), Bowling::HANDLES);
    let contact = Interaction::contact(h.ball, floor())
        .radius(0.1)
        .with_friction(0.4);
    let [_, along, across] = Interaction::handles(&contact);
    let thrown = start([0.0, 0.0, 0.1], [4.0, 3.0, 0.0], [0.0; 3]);
    let simulation = bowling
        .simulation(StandardLagrange, DormandPrince::new(tight()))
        .initial_state(thrown)
        .interactions(contact);
    let rolls = 2.0 * 5.0 / (7.0 * 0.1 * 9.81);
    simulation
        .clone()
        .capacity_factor(along, |_, _| 0.25)
        .run(0.0..=2.0, every(0.1), |sample| {
            let sticks = sample.mode(along) == Ok(InteractionMode::Sticking);
            let after = sample.time() - rolls;
            assert!(after.abs() < 1e-9 || sticks == (after > 0.0), "{after}");
        })
        .expect("it rolls");
    simulation
        .capacity_factor(across, |_, _| 0.25)
        .run(0.0..=2.0, every(0.1), |_| ())
        .expect_err("the first direction has it");
}
