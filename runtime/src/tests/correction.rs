//! The correction of a state onto the constraints.

use super::rod::{ROD, Rod, rod};
use crate::error::StepFault;
use crate::state::State;
use crate::*;

#[test]
fn a_displaced_rod_is_put_back_on_its_hinge() {
    let mut state = State::from_parts(
        [0.05, 0.4, -0.2, 1.1, 0.3, 0.1, -0.2],
        [1.0, -2.0, 0.5, 0.3, 0.2, -0.1],
    );
    let report = rod().assemble(0.0, &mut state).unwrap();
    assert!(report.violation_before > 1e-3 && report.velocity_violation_before > 1e-3);
    assert!(report.violation_after < 1e-30 && report.velocity_violation_after < 1e-28);
    assert!(report.iterations < 10, "{}", report.iterations);
    let [_, _, _, p @ ..] = *state.coordinates();
    assert!((p.iter().map(|e| e * e).sum::<f64>() - 1.0).abs() < 1e-15);
}

#[test]
fn a_state_on_the_constraints_stays() {
    let mut state: State<f64, 7, 6> = rod().described_state().unwrap();
    let before = state;
    let report = rod().assemble(0.0, &mut state).unwrap();
    assert_eq!((report.iterations, state), (0, before));
}

#[test]
fn the_correction_is_the_least_movement_in_the_metric_of_the_mass() {
    let described: State<f64, 7, 6> = rod().described_state().unwrap();
    let constants = Rod::prepare(&[7.02]);
    let mut state = described;
    Rod::set_velocity(&mut state, ROD, nalgebra::Vector3::new(0.0, 0.0, 1.0));
    let given = *state.velocities();
    rod().assemble(0.0, &mut state).unwrap();
    // M (u - u0) is a combination of the rows of D: the motion left free, a turn about x, does no
    // work on it.
    let free = [0.0, 0.0, 0.5, 1.0, 0.0, 0.0];
    let work: f64 = (0..6)
        .map(|k| constants[k] * (state.velocities()[k] - given[k]) * free[k])
        .sum();
    assert!(work.abs() < 1e-14);
}

#[test]
fn single_precision_is_corrected_to_its_digits() {
    let mut state = State::from_parts(
        [0.05_f32, 0.4, -0.2, 1.1, 0.3, 0.1, -0.2],
        [1.0, -2.0, 0.5, 0.3, 0.2, -0.1],
    );
    let report = rod().assemble(0.0, &mut state).unwrap();
    assert!(report.violation_after < 1e-11 && report.velocity_violation_after < 1e-10);
}

#[test]
fn what_does_not_converge_leaves_the_state() {
    let hasty = Projection {
        tolerance: 1e-12,
        max_iterations: 1,
    };
    let constants = Rod::prepare(&[7.02]);
    let mut state = State::from_parts([0.05, 0.4, -0.2, 1.1, 0.3, 0.1, -0.2], [0.0; 6]);
    let before = state;
    let error = hasty
        .correct::<Rod>(&constants, 0.0, &mut state)
        .unwrap_err();
    assert!(matches!(
        error,
        Fault::Step(StepFault::NotConverged { iterations: 1, .. })
    ));
    assert_eq!(state, before);
}
