//! A block with dry friction.

use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::{InteractionHandle, InteractionMode};

use super::{Block, tight};

const MASS: f64 = 2.0;

/// A block that is pushed (N).
fn pushed(push: f64) -> Block {
    let mut block = Block::new(0.0, 0.0).expect("a block");
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

/// Friction on the slide, and its handle.
fn rubs(capacity: f64) -> ([Interaction<f64, Block>; 1], [InteractionHandle<Block>; 1]) {
    let slide = Block::HANDLES.slide.displacement();
    let frictions = [Interaction::friction(slide, capacity)];
    (frictions, Interaction::handles(&frictions))
}

fn stops<C: Coordinates<Block>>() {
    let (block, h) = (pushed(0.0), Block::HANDLES);
    let (speed, capacity) = (3.1, 5.0);
    let (frictions, [friction]) = rubs(capacity);
    let mut stopped = None;
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(moving(&block, speed))
        .interactions(frictions)
        .run(0.0_f64..=3.0, every(0.1), |sample| {
            if sample.mode(friction) == Ok(InteractionMode::Sticking) && stopped.is_none() {
                stopped = Some((sample.time(), sample.displacement(h.slide)));
            }
            let effort = sample.effort(friction).expect("one interaction");
            // At the stop there is a report before, and one after.
            let slides = sample.mode(friction) == Ok(InteractionMode::SlidingUp);
            if (sample.time() - 1.24).abs() > 1e-9 {
                assert_eq!(slides, sample.time() < 1.24);
            }
            let wanted = if slides { -capacity } else { 0.0 };
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
    assert!(view.displacement_rate(end).abs() < 1e-15);
}

#[test]
fn a_block_stops_where_its_energy_is_gone() {
    stops::<Relative>();
    stops::<Absolute>();
}

#[test]
fn the_time_of_a_stop_is_exact() {
    let block = pushed(0.0);
    let (frictions, [friction]) = rubs(5.0);
    let mut stopped = 0.0;
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .initial_state(moving(&block, 3.1))
        .interactions(frictions)
        .run(0.0_f64..=3.0, every(0.7), |sample| {
            // The state that was found is shown before its mode changes.
            if sample.mode(friction) == Ok(InteractionMode::SlidingUp) {
                stopped = sample.time();
            }
        })
        .expect("it stops");
    assert!((stopped / 1.24 - 1.0).abs() < 1e-12, "{stopped}");
    assert!(report.accepted > 2);
}

fn stays<C: Coordinates<Block>>() {
    let (block, h) = (pushed(0.9 * 5.0), Block::HANDLES);
    let (frictions, [friction]) = rubs(5.0);
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::default())
        .coordinates::<C>()
        .interactions(frictions)
        .run(0.0_f64..=1e4, every(100.0), |sample| {
            assert_eq!(sample.mode(friction), Ok(InteractionMode::Sticking));
            assert!(sample.displacement(h.slide).abs() < 1e-10);
            let effort = sample.effort(friction).expect("one interaction");
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

fn swings<C: Coordinates<Block>>() {
    let (stiffness, capacity) = (200.0, 3.0);
    let (block, h) = (Block::new(stiffness, 0.0).expect("a block"), Block::HANDLES);
    let mut start = block.described_state().expect("it is described");
    block
        .set_displacement(&mut start, h.slide, 0.1)
        .expect("it is free");
    // Half swings about `+-capacity / stiffness`, each 0.03 m shorter; the last ends at -0.01 m,
    // where friction holds.
    let half = core::f64::consts::PI / (stiffness / MASS).sqrt();
    let exact = |time: f64| {
        let swing = (time / half).floor();
        if swing >= 3.0 {
            return -0.01;
        }
        let sign = if swing == 1.0 { -1.0 } else { 1.0 };
        let amplitude = 0.1 - 0.03 * swing - 0.015;
        let phase = core::f64::consts::PI * (time / half - swing);
        sign * (0.015 + amplitude * phase.cos())
    };
    let (frictions, [friction]) = rubs(capacity);
    let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start)
        .interactions(frictions)
        .run(0.0_f64..=2.0, every(0.01), |sample| {
            let (x, wanted) = (sample.displacement(h.slide), exact(sample.time()));
            assert!((x - wanted).abs() < 1e-11, "{} {x} {wanted}", sample.time());
            let sticks = sample.mode(friction) == Ok(InteractionMode::Sticking);
            // At the end of the last swing there is a report before, and one after.
            if (sample.time() - 3.0 * half).abs() > 1e-9 {
                assert_eq!(sticks, sample.time() > 3.0 * half);
            }
        })
        .expect("it comes to rest");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_spring_swings_between_lines_of_friction_and_sticks_off_its_middle() {
    swings::<Relative>();
    swings::<Absolute>();
}

#[test]
fn what_sticks_slips_beyond_its_stiction() {
    let (block, h) = (Block::new(0.0, 2.0).expect("a block"), Block::HANDLES);
    let run = |friction: Interaction<f64, Block>, end: f64| {
        let report = Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
            .interactions([friction])
            .run(0.0_f64..=end, every(end), |_| ())
            .expect("it slips");
        let view = block.view(end, &report.state).expect("a view");
        [view.displacement(h.slide), view.displacement_rate(h.slide)]
    };
    // 2 N/s on 2 kg: sticks up to 6 N, at 3 s, then slides against 4 N.
    let plain = Interaction::friction(h.slide.displacement(), 4.0).stiction(6.0);
    let [x, v] = run(plain, 5.0);
    let rate = |t: f64| 0.5 * t * t - 2.0 * t + 1.5;
    let way = |t: f64| t * t * t / 6.0 - t * t + 1.5 * t;
    assert!((v - rate(5.0)).abs() < 1e-10, "{v}");
    assert!((x - (way(5.0) - way(3.0))).abs() < 1e-10, "{x}");
    // A curve from one to the other delays it.
    let curve = plain.stribeck(0.5);
    let [slower, _] = run(curve, 5.0);
    assert!(slower < x && slower > 0.0, "{slower}");
    // Solved once by `scipy.integrate.solve_ivp` (DOP853, 1e-13) from 3 s on.
    assert!((slower - STRIBECK).abs() < 1e-9, "{slower:.12}");
}

/// See the last test.
const STRIBECK: f64 = 2.0686151042034;

/// A capacity that a handler or a table has set to zero: nothing acts, or it moves freely.
#[test]
fn friction_without_a_capacity_does_not_change_its_mode_without_end() {
    for (push, speed) in [(0.0, 0.0), (0.0, 0.5), (1e-3, 0.0), (-2.0, 0.5)] {
        let block = pushed(push);
        let (frictions, _) = rubs(0.0);
        block
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .initial_state(moving(&block, speed))
            .interactions(frictions)
            .run(0.0..=1.0, every(0.25), |sample| {
                let time = sample.time();
                let wanted = time * (speed + 0.5 * push / MASS * time);
                let place = sample.displacement(Block::HANDLES.slide);
                assert!(
                    (place - wanted).abs() < 1e-10,
                    "{push} {speed}: {place} {wanted}"
                );
            })
            .unwrap_or_else(|error| panic!("{push} {speed}: {error}"));
    }
}

/// Two frictions of one slide under a push, whose capacities fade by `1 - t / 10`.
fn fades<C: Coordinates<Block>>(capacities: [f64; 2], stiction: f64) {
    let push = 3.0;
    let block = pushed(push);
    let slide = Block::HANDLES.slide;
    let make = |capacity: f64| Interaction::friction(slide.displacement(), capacity);
    let frictions = capacities.map(|capacity| make(capacity).stiction(stiction * capacity));
    let [first, second] = Interaction::handles(&frictions);
    let fade = |view: &View<'_, f64, Block>, _: &_| 1.0 - 0.1 * view.time();
    let sum = capacities[0] + capacities[1];
    let start = 10.0 * (1.0 - push / (stiction * sum));
    let told = format!("{capacities:?}, {stiction}");
    Simulation::new(&block, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(frictions)
        .capacity_factor(first, fade)
        .capacity_factor(second, fade)
        .run(0.0..=9.0, every(0.1), |sample| -> Result<(), Fault> {
            let time = sample.time();
            let wanted = if time > start {
                let push = (push - sum) * (time - start);
                (push + 0.05 * sum * (time * time - start * start)) / MASS
            } else {
                let efforts = sample.effort(first)? + sample.effort(second)?;
                assert!((efforts + push).abs() < 1e-9, "{told}: {efforts}");
                for friction in [first, second] {
                    let mode = sample.mode(friction)?;
                    let is_near = (time - start).abs() < 1e-9;
                    assert!(
                        is_near || mode == InteractionMode::Sticking,
                        "{told}: {mode:?}"
                    );
                }
                0.0
            };
            let rate = sample.displacement_rate(slide);
            assert!(
                (rate - wanted).abs() < 1e-8,
                "{told} at {time}: {rate} for {wanted}"
            );
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{told}: {error}"));
}

#[test]
fn two_frictions_of_one_slide_break_away_together() {
    let both = [
        [3.0, 3.0],
        [4.0, 2.0],
        [1.0, 5.0],
        [6.0, 0.0],
        [3.0, 3.0001],
    ];
    for capacities in both {
        for stiction in [1.0, 1.2] {
            fades::<Relative>(capacities, stiction);
            fades::<Absolute>(capacities, stiction);
        }
    }
}
