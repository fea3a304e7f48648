//! Loops, driven bodies, angles that pass half a turn, and single precision.

use core::f64::consts::PI;

use holonom::error::ModeFault;
use holonom::mechanism::{Absolute, Coordinates, Relative};
use holonom::prelude::*;
use holonom::run::InteractionMode;

use super::{Ball, Belt, Crank, Rod, tight};

fn crank<C: Coordinates<Crank>>(projected: bool) -> Vec<[f64; 2]> {
    let (crank, h) = (Crank::default(), Crank::HANDLES);
    let mut start = crank.described_state().expect("it is described");
    crank
        .set_angle_rate(&mut start, h.hinge, 1.5)
        .expect("it is free");
    crank.assemble(0.0, &mut start).expect("it closes");
    let mut simulation = Simulation::new(&crank, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .initial_state(start);
    if projected {
        simulation = simulation.projection(Projection::default());
    }
    let mut course = Vec::new();
    let report = simulation
        .interactions([
            Interaction::limits(h.hinge.angle(), [-1.0, 0.8]).restitution(0.6),
            Interaction::friction(h.rail.displacement(), 1.0).stiction(1.5),
        ])
        .run(0.0..=6.0, every(0.05), |sample| {
            course.push([sample.angle(h.hinge), sample.displacement(h.rail)]);
            assert!(sample.angle(h.hinge).abs() < 1.0 + 1e-9);
        })
        .expect("it moves");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    course
}

#[test]
fn a_loop_goes_through_the_same_motion_in_both_coordinates() {
    let joints = crank::<Relative>(false);
    let [angle, ..] = joints.last().copied().expect("it has states");
    // It has come to rest on a limit.
    assert!(
        (angle + 1.0).abs() < 1e-9 || (angle - 0.8).abs() < 1e-9,
        "{angle}"
    );
    assert!(joints.iter().any(|[angle, ..]| *angle < 0.5), "{joints:?}");
    for bodies in [crank::<Absolute>(false), crank::<Absolute>(true)] {
        for (a, b) in joints.iter().zip(&bodies) {
            for (a, b) in a.iter().zip(b) {
                assert!((a - b).abs() < 1e-8, "{a} {b}");
            }
        }
    }
}

fn belt<C: Coordinates<Belt>>() {
    let (belt, h) = (Belt::default(), Belt::HANDLES);
    // Sticks from 0 to 0.08 m, where the spring has 8 N; slides back to 0 m in 2 (pi - atan 0.4)
    // over 10 rad/s.
    let slide = 0.2 * (PI - 0.4_f64.atan());
    let period = 0.08 + slide;
    let exact = |time: f64| {
        let time = time % period;
        if time < 0.08 {
            return (time, InteractionMode::Sticking);
        }
        let angle = 10.0 * (time - 0.08);
        let place = 0.04 + 0.04 * angle.cos() + 0.1 * angle.sin();
        (place, InteractionMode::SlidingDown)
    };
    let frictions = [Interaction::friction(h.top.displacement(), 4.0).stiction(8.0)];
    let [friction] = Interaction::handles(&frictions);
    let report = Simulation::new(&belt, StandardLagrange, DormandPrince::new(tight()))
        .coordinates::<C>()
        .interactions(frictions)
        .run(0.0_f64..=5.0, every(0.0137), |sample| {
            let (place, mode) = exact(sample.time());
            let found = sample.position(h.block).x;
            assert!(
                (found - place).abs() < 1e-9,
                "{} {found} {place}",
                sample.time()
            );
            // At the instant of an end both modes are right.
            let ends = [0.0, 0.08, period].map(|end| (sample.time() % period - end).abs());
            if ends.iter().all(|away| *away > 1e-9) {
                assert_eq!(sample.mode(friction), Ok(mode), "{}", sample.time());
            }
        })
        .expect("it sticks and slips");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn a_block_on_a_belt_sticks_and_slips() {
    belt::<Relative>();
    belt::<Absolute>();
}

#[test]
fn an_angle_past_half_a_turn_is_not_the_other_side() {
    let (rod, hinge) = (Rod::default(), Rod::HANDLES.hinge);
    let mut start = rod.described_state().expect("it is described");
    rod.set_angle_rate(&mut start, hinge, 12.0)
        .expect("it is free");
    // Its limits are near the angle where the reading jumps.
    let mut impacts = 0;
    Simulation::new(&rod, StandardLagrange, DormandPrince::default())
        .initial_state(start)
        .interactions([Interaction::limits(hinge.angle(), [-2.0, 3.1]).restitution(0.9)])
        .run(0.0_f64..=2.0, every(0.01), |sample| {
            let angle = sample.angle(hinge);
            assert!(angle > -2.0 - 1e-9 && angle < 3.1 + 1e-9, "{angle}");
            let impact = sample
                .impact(hinge.angle().limits())
                .expect("one interaction");
            impacts += usize::from(impact.is_some_and(|impact| impact.time == sample.time()));
        })
        .expect("it swings");
    assert!(impacts > 2, "{impacts}");
}

#[test]
fn single_precision_comes_to_rest_as_well() {
    let (ball, rail) = (Ball::default(), Ball::HANDLES.rail);
    let stop = rail.displacement().limits();
    let integrator = DormandPrince::<f32>::default();
    let report = Simulation::<Problem<_, _, f32>, _>::new(&ball, StandardLagrange, integrator)
        .interactions([Interaction::limits(rail.displacement(), [-1.0, 1.0]).restitution(0.5)])
        .run(0.0..=4.0, every(0.1), |sample| {
            assert!(sample.displacement(rail) > -1.0 - 1e-5);
            if sample.time() > 2.0 {
                assert_eq!(sample.mode(stop), Ok(InteractionMode::AtLower));
                let effort = sample.effort(stop).expect("one interaction");
                assert!((effort - 9.81).abs() < 1e-4, "{effort}");
            }
        })
        .expect("it rests");
    assert!(report.accepted > 10);
}

/// A driver does not give way to a stop: refused by name, and not as a start beyond it.
#[test]
fn a_driver_that_pushes_against_a_stop_is_refused() {
    fn pushes<C: Coordinates<Belt>>(restitution: f64) {
        let (belt, h) = (Belt::default(), Belt::HANDLES);
        let stop = Interaction::limits(h.rollers.displacement(), [-9.0, 0.5]);
        let error = belt
            .simulation(StandardLagrange, DormandPrince::new(tight()))
            .coordinates::<C>()
            .interactions([stop.restitution(restitution)])
            .run(0.0..=1.0, every(0.1), |_| ())
            .expect_err("nothing stops the belt");
        let Fault::Mode(ModeFault::DrivenAgainst {
            joint,
            driver,
            is_upper,
            time,
        }) = error.fault
        else {
            panic!("{error}");
        };
        assert_eq!((joint, driver, is_upper), ("rollers", "motor", true));
        assert!((time - 0.5).abs() < 1e-9, "{error}");
    }
    for restitution in [0.0, 0.5] {
        pushes::<Relative>(restitution);
        pushes::<Absolute>(restitution);
    }
}
