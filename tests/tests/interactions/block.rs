//! A block with dry friction.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Block, tight};

const MASS: f64 = 2.0;

/// A block that is pushed (N).
fn pushed(push: f64) -> Block {
    let mut block = Block::new(0.0).expect("a block");
    block.push = push;
    block
}

fn moving(block: &Block, speed: f64) -> StateOf<Block> {
    let mut state = block.described_state().expect("it is described");
    block
        .set_displacement_rate(&mut state, Block::HANDLES.slide, speed)
        .expect("it is free");
    state
}

fn stops<C: Coordinates<Block>>() {
    let (block, h) = (pushed(0.0), Block::HANDLES);
    let (speed, capacity) = (3.1, 5.0);
    let mut stopped = None;
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(moving(&block, speed))
        .interactions([Interaction::friction(h.slide.displacement(), capacity)])
        .run(0.0_f64..=3.0, every(0.1), |sample| {
            if sample.mode(0) == Ok(InteractionMode::Sticking) && stopped.is_none() {
                stopped = Some((sample.time(), sample.displacement(h.slide)));
            }
            let effort = sample.effort(0).expect("one interaction");
            let wanted = if sample.time() < 1.2401 { -capacity } else { 0.0 };
            assert!(
                (effort - wanted).abs() < 1e-10,
                "{effort} {}",
                sample.time()
            );
        })
        .expect("it stops");
    let deceleration = capacity / MASS;
    let (time, place) = (speed / deceleration, 0.5 * speed * speed / deceleration);
    let (at, x) = stopped.expect("it sticks");
    assert!((at - time).abs() < 0.1 + 1e-9 && at >= time - 1e-9);
    assert!((x / place - 1.0).abs() < 1e-12, "{x} {place}");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let end = Block::HANDLES.slide;
    let view = block.view(report.time, &report.state).expect("a view");
    assert_eq!(view.displacement_rate(end), 0.0);
}

#[test]
fn a_block_stops_where_its_energy_is_gone() {
    stops::<Relative>();
    stops::<Absolute>();
}

#[test]
fn the_time_of_a_stop_is_exact() {
    let (block, h) = (pushed(0.0), Block::HANDLES);
    let mut stopped = 0.0;
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .initial_state(moving(&block, 3.1))
        .interactions([Interaction::friction(h.slide.displacement(), 5.0)])
        .run(0.0_f64..=3.0, every(0.7), |sample| {
            // The state that was found is shown before its mode changes.
            if sample.mode(0) == Ok(InteractionMode::SlidingUp) {
                stopped = sample.time();
            }
        })
        .expect("it stops");
    assert!((stopped / 1.24 - 1.0).abs() < 1e-12, "{stopped}");
    assert!(report.accepted > 2);
}

fn stays<C: Coordinates<Block>>() {
    let (block, h) = (pushed(0.9 * 5.0), Block::HANDLES);
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::default())
        .coordinates::<C>()
        .interactions([Interaction::friction(h.slide.displacement(), 5.0)])
        .run(0.0_f64..=1e4, every(100.0), |sample| {
            assert_eq!(sample.mode(0), Ok(InteractionMode::Sticking));
            assert!(sample.displacement(h.slide).abs() < 1e-10);
            let effort = sample.effort(0).expect("one interaction");
            assert!((effort + 4.5).abs() < 1e-12);
        })
        .expect("it stays");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn below_its_capacity_friction_does_not_creep() {
    stays::<Relative>();
    stays::<Absolute>();
}
