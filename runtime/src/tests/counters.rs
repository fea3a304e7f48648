//! Angles that count turns, displacements and drivers, read by handle.

use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow;

use nalgebra::{Quaternion, Vector3};

use super::crank::{CRANK, Crank, MOTOR, crank};
use crate::state::State;
use crate::*;

type CrankState = State<f64, 8, 6>;

fn turned(angle: f64) -> Pose<f64> {
    // The user's axes are turned by 90 degrees about x against the principal ones.
    let half = 0.5 * (angle + 0.5 * PI);
    Pose {
        position: Vector3::new(0.0, 0.5 * angle.cos(), 0.5 * angle.sin()),
        orientation: Quaternion::new(half.cos(), half.sin(), 0.0, 0.0),
    }
}

#[test]
fn a_run_counts_the_turns() {
    let crank = crank(-10.0);
    let mut state: CrankState = crank.described_state().unwrap();
    crank.assemble(0.0, &mut state).unwrap();
    for projection in [false, true] {
        let mut simulation =
            Simulation::new(&crank, Baumgarte::default(), Rk4::every(0.002)).initial_state(state);
        if projection {
            simulation = simulation.projection(Projection::default());
        }
        let mut seen = 0;
        simulation
            .run(0.0..=2.0, every(0.1), |sample| {
                seen += 1;
                let angle = sample.angle(MOTOR);
                assert!((angle + 10.0 * sample.time()).abs() < 1e-5, "{angle}");
                assert!((sample.angle_rate(MOTOR) + 10.0).abs() < 1e-5);
                ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!(seen, 21);
    }
}

#[test]
fn the_counter_follows_a_correction_by_any_number_of_turns() {
    let mut crank = crank(0.0);
    for turns in [-4.0, -0.9, 0.4, 0.6, 1.0, 7.3] {
        crank.start = turns * TAU;
        let mut state: CrankState = crank.described_state().unwrap();
        crank.assemble(0.0, &mut state).unwrap();
        assert!(
            (state.coordinates()[7] - crank.start).abs() < 1e-9,
            "{turns}"
        );
        let constants = crank.constants().unwrap();
        let view = View::<f64, Crank>::new(&constants, 0.0, &state);
        assert!((view.angle(MOTOR) - crank.start).abs() < 1e-9);
    }
}

#[test]
fn a_pose_that_was_set_keeps_the_whole_turns_of_the_counter() {
    let crank = crank(0.0);
    let constants = crank.constants().unwrap();
    let mut state: CrankState = crank.described_state().unwrap();
    state.coordinates_mut()[7] = 3.0 * TAU;
    Crank::set_pose(&mut state, CRANK, turned(2.0));
    assert_eq!(state.coordinates()[7], 3.0 * TAU);
    Crank::rewrap(&constants, &mut state);
    assert!((state.coordinates()[7] - (3.0 * TAU + 2.0)).abs() < 1e-14);
    let before = state;
    Crank::rewrap(&constants, &mut state);
    assert_eq!(state, before);
}

#[test]
fn a_stepper_keeps_the_counter_beside_the_orientation() {
    let crank = crank(3.0);
    let mut stepper = Stepper::new(&crank, Baumgarte::default(), Rk4).unwrap();
    let mut state: CrankState = crank.described_state().unwrap();
    crank.assemble(0.0, &mut state).unwrap();
    for _ in 0..1000 {
        stepper.step(&mut state, 0.01).unwrap();
        assert_eq!(state.coordinates()[7], stepper.view(&state).angle(MOTOR));
    }
    assert!((state.coordinates()[7] - 30.0).abs() < 1e-3);
}

/// At constant speed the motor holds the weight and nothing else: `m g s cos(angle)`, upwards.
#[test]
fn the_effort_of_a_driver_is_what_it_takes() {
    let crank = crank(4.0);
    let mut state: CrankState = crank.described_state().unwrap();
    crank.assemble(0.0, &mut state).unwrap();
    Simulation::new(&crank, StandardLagrange, Rk4::every(0.001))
        .initial_state(state)
        .run(0.0..=1.0, every(0.1), |sample| {
            let angle = 4.0 * sample.time();
            let effort = sample.driving_effort(MOTOR).unwrap();
            assert!(
                (effort - 7.02 * 9.81 * 0.5 * angle.cos()).abs() < 1e-6,
                "{effort}"
            );
            let height = sample.displacement(MOTOR);
            assert!((height - angle.sin()).abs() < 1e-9);
            assert!((sample.displacement_rate(MOTOR) - 4.0 * angle.cos()).abs() < 1e-8);
            assert!(sample.accelerations().unwrap()[3].abs() < 1e-9);
            ControlFlow::Continue(())
        })
        .unwrap();
}
