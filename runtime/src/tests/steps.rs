//! Steps of a loop that the caller owns.

use super::crank::crank;
use super::rod::{PIVOT, ROD, Rod, rod};
use crate::error::{NotFinite, StartFault, StepFault};
use crate::integrate::DormandPrince5;
use crate::state::State;
use crate::*;

#[test]
fn steps_agree_with_a_run_at_the_same_step() {
    let rod = rod();
    let mut stepper = Stepper::new(&rod, Baumgarte::default(), Rk4).unwrap();
    let mut state = rod.described_state().unwrap();
    for _ in 0..100 {
        stepper.step(&mut state, 0.01).unwrap();
    }
    let report = Simulation::new(&rod, Baumgarte::default(), Rk4::every(0.01))
        .run(0.0..=1.0, every(1.0), |_| {
            core::ops::ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(report.evaluations, 400);
    let pairs = state.coordinates().iter().zip(report.state.coordinates());
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-13));
    assert!((stepper.time() - 1.0).abs() < 1e-14);
    assert!(stepper.view(&state).angle(PIVOT) < -2.0);
}

#[test]
fn an_input_may_change_between_steps() {
    let mut rod = rod();
    let mut stepper = Stepper::new(&rod, StandardLagrange, DormandPrince5).unwrap();
    let mut state: State<f64, 7, 6> = rod.described_state().unwrap();
    stepper.step(&mut state, 0.01).unwrap();
    let heavy = stepper.view(&state).kinetic_energy();
    rod.mass *= 2.0;
    stepper.update(&rod).unwrap();
    assert!(stepper.view(&state).kinetic_energy() > 1.5 * heavy);
    rod.mass = f64::NAN;
    assert!(matches!(stepper.update(&rod), Err(Fault::Parameter(_))));
    assert!(stepper.view(&state).kinetic_energy() > 1.5 * heavy);
}

#[test]
fn a_step_that_fails_leaves_state_and_time() {
    let rod = rod();
    let mut stepper = Stepper::new(&rod, StandardLagrange, Rk4)
        .unwrap()
        .starting_at(1.0)
        .forces(|_, _, loads| loads.force(ROD, [f64::NAN, 0.0, 0.0]));
    let mut state = rod.described_state().unwrap();
    let before: State<f64, 7, 6> = state;
    let origin = NotFinite::Closure("rod");
    assert_eq!(
        stepper.step(&mut state, 0.1),
        Err(Fault::Step(StepFault::RatesNotFinite { origin }))
    );
    for step in [0.0, -0.1, f64::INFINITY] {
        let refused = Fault::Start(StartFault::Setting {
            name: "step",
            value: step,
        });
        assert_eq!(stepper.step(&mut state, step), Err(refused));
    }
    assert_eq!((state, stepper.time()), (before, 1.0));
    Rod::set_velocity(&mut state, ROD, nalgebra::Vector3::new(f64::NAN, 0.0, 0.0));
    assert_eq!(
        stepper.step(&mut state, 0.1),
        Err(Fault::Step(StepFault::StateNotFinite))
    );
}

#[test]
fn laws_of_time_want_steps_that_the_time_can_tell() {
    let crank = crank(-10.0);
    let mut stepper = Stepper::new(&crank, StandardLagrange, Rk4)
        .unwrap()
        .starting_at(1.0);
    let mut state: State<f64, 8, 6> = crank.described_state().unwrap();
    let before = state;
    let short = Fault::Step(StepFault::TooShort {
        step: 1e-17,
        time: 1.0,
    });
    assert_eq!(stepper.step(&mut state, 1e-17), Err(short));
    assert_eq!((state, stepper.time()), (before, 1.0));
}

#[test]
fn a_projecting_stepper_stays_on_the_constraints() {
    let rod = rod();
    let mut stepper = Stepper::new(&rod, StandardLagrange, Rk4)
        .unwrap()
        .projection(Projection::default());
    let mut state: State<f64, 7, 6> = rod.described_state().unwrap();
    for _ in 0..200 {
        stepper.step(&mut state, 0.02).unwrap();
    }
    assert!(stepper.view(&state).violation() < 1e-29);
    assert!(stepper.view(&state).energy().abs() < 1e-2);
}
