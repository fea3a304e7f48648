//! Steps of a loop that somebody else owns.

use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Block, GRAVITY, Rod};

#[test]
fn steps_swing_between_lines_of_friction() {
    // As the run of the same block: half swings, each 0.03 m shorter, then rest at -0.01 m.
    let (stiffness, capacity, mass) = (200.0, 3.0, 2.0_f64);
    let (block, h) = (Block::new(stiffness, 0.0).expect("a block"), Block::HANDLES);
    let mut start = block.described_state().expect("it is described");
    block
        .set_displacement(&mut start, h.slide, 0.1)
        .expect("it is free");
    let frictions = [Interaction::friction(h.slide.displacement(), capacity)];
    let [friction] = Interaction::handles(&frictions);
    let mut stepper = block
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .interactions(frictions);
    let mut state = stepper.state_of(&start).expect("a state");
    let half = core::f64::consts::PI / (stiffness / mass).sqrt();
    for step in 1..=1000 {
        stepper.step(&mut state, 2e-3).expect("it steps");
        let time = 2e-3 * f64::from(step);
        assert!((stepper.time() - time).abs() < 1e-12);
        let swing = (time / half).floor();
        let wanted = if swing >= 3.0 {
            -0.01
        } else {
            let sign = if swing == 1.0 { -1.0 } else { 1.0 };
            let phase = core::f64::consts::PI * (time / half - swing);
            sign * (0.015 + (0.085 - 0.03 * swing) * phase.cos())
        };
        let bodies = stepper.bodies(&state);
        let x = stepper.view(&bodies).displacement(h.slide);
        assert!((x - wanted).abs() < 1e-9, "{time} {x} {wanted}");
    }
    assert_eq!(stepper.mode(friction), Ok(InteractionMode::Sticking));
    let effort = stepper.effort(friction, &state).expect("one interaction");
    assert!((effort + stiffness * 0.01).abs() < 1e-7, "{effort}");
}

#[test]
fn a_brake_holds_between_steps_and_lets_go() {
    let (rod, h) = (Rod::default(), Rod::HANDLES);
    let interactions = [
        Interaction::brake(h.hinge.angle(), 12.0),
        Interaction::limits(h.hinge.angle(), [-1.0, 1.0]).restitution(0.3),
    ];
    let [brake, stop] = Interaction::handles(&interactions);
    let mut stepper = rod
        .stepper(StandardLagrange, Rk4)
        .expect("it is prepared")
        .interactions(interactions);
    let mut state = stepper.initial_state().expect("a state");
    let angle = |bodies: &StateOf<Rod>| {
        let view = rod.view(0.0, bodies).expect("a view");
        view.angle(h.hinge)
    };
    // The weight has 2 g 0.5 N m at the horizontal.
    for _ in 0..1000 {
        stepper.step(&mut state, 1e-2).expect("it steps");
    }
    assert!(angle(&stepper.bodies(&state)).abs() < 1e-30);
    let effort = stepper.effort(brake, &state).expect("two interactions");
    assert!((effort - GRAVITY).abs() < 1e-12, "{effort}");
    stepper.release(brake).expect("two interactions");
    for _ in 0..400 {
        stepper.step(&mut state, 1e-2).expect("it steps");
        assert!(angle(&stepper.bodies(&state)) > -1.0 - 1e-9);
    }
    assert_eq!(stepper.mode(stop), Ok(InteractionMode::AtLower));
    assert!((angle(&stepper.bodies(&state)) + 1.0).abs() < 1e-12);
    let impact = stepper
        .impact(stop)
        .expect("two interactions")
        .expect("it met it");
    let [before, after] = impact.rates;
    assert!(before < 0.0 && after.abs() < before.abs());
    // A step that is refused changes nothing.
    let (was, time) = (state, stepper.time());
    stepper.step(&mut state, f64::NAN).expect_err("no step");
    assert_eq!((state, stepper.time()), (was, time));
}
