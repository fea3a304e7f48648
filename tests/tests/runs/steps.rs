//! Single steps, for a loop of one's own, do what a run with a fixed step does.

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom::run::Steps;
use holonom::{Fault, Runs, integrate::DormandPrince5};
use holonom_models::{DrivenSliderCrank, RodPendulum};

use crate::flat::flat;

/// Adds up without rounding.
const STEP: f64 = 1.0 / 128.0;

fn by_steps<F, K>(method: F, scheme: K) -> Vec<f64>
where
    F: Formulation<f64>,
    K: Steps<Problem<RodPendulum, F>>,
{
    let rod = RodPendulum::default();
    let mut stepper = Stepper::new(&rod, method, scheme).expect("acceptable");
    let mut state = rod.described_state().expect("described");
    for _ in 0..128 {
        stepper.step(&mut state, STEP).expect("solvable");
    }
    assert_eq!(stepper.time(), 1.0);
    flat::<f64, RodPendulum>(&state)
}

fn by_a_run<F, I>(method: F, integrator: I) -> Vec<f64>
where
    F: Formulation<f64>,
    I: Runs<Problem<RodPendulum, F>>,
{
    let rod = RodPendulum::default();
    let report = Simulation::new(&rod, method, integrator)
        .run(0.0..=1.0, every(1.0), |_| ControlFlow::Continue(()))
        .expect("solvable");
    assert_eq!((report.accepted, report.rejected), (128, 0));
    flat::<f64, RodPendulum>(&report.state)
}

#[test]
fn single_steps_equal_a_run() {
    assert_eq!(
        by_steps(StandardLagrange, Rk4),
        by_a_run(StandardLagrange, Rk4::every(STEP))
    );
    assert_eq!(
        by_steps(Baumgarte::default(), Rk4),
        by_a_run(Baumgarte::default(), Rk4::every(STEP))
    );
    assert_eq!(
        by_steps(Penalty::default(), DormandPrince5),
        by_a_run(Penalty::default(), DormandPrince::every(STEP))
    );
    assert_eq!(
        by_steps(AugmentedLagrangian::default(), DormandPrince5),
        by_a_run(AugmentedLagrangian::default(), DormandPrince::every(STEP))
    );
}

#[test]
fn a_run_with_another_start_and_a_stepper_there_agree() {
    let rod = RodPendulum::default();
    let handles = RodPendulum::HANDLES;
    let mut state = rod.described_state().expect("described");
    RodPendulum::set_angular_velocity(
        &mut state,
        handles.rod,
        nalgebra::Vector3::new(-2.0, 0.0, 0.0),
    );
    rod.assemble(5.0, &mut state).expect("assembles");
    let report = Simulation::new(&rod, StandardLagrange, Rk4::every(STEP))
        .initial_state(state)
        .run(5.0..=5.25, every_step(), |_| ControlFlow::Continue(()))
        .expect("solvable");
    let mut stepper = Stepper::new(&rod, StandardLagrange, Rk4)
        .expect("acceptable")
        .starting_at(5.0);
    for _ in 0..32 {
        stepper.step(&mut state, STEP).expect("solvable");
    }
    assert_eq!(stepper.time(), 5.25);
    assert_eq!(report.state, state);
}

#[test]
fn a_step_that_fails_leaves_state_and_time() {
    let rod = RodPendulum::default();
    let mut stepper = Stepper::new(&rod, StandardLagrange, Rk4).expect("acceptable");
    let mut state = rod.described_state().expect("described");
    stepper.step(&mut state, 0.125).expect("solvable");
    let before = state;
    for (dt, number) in [
        (0.0, "0"),
        (-0.1, "-0.1"),
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
    ] {
        let fault = stepper.step(&mut state, dt).expect_err("no step");
        assert_eq!(
            fault.to_string(),
            format!("`step` must be finite and positive, not {number}")
        );
        assert_eq!((stepper.time(), state), (0.125, before));
    }
    // So long that the numbers overflow.
    let fault = stepper.step(&mut state, 1e200).expect_err("overflow");
    assert!(
        matches!(
            fault,
            Fault::Step(StepFault::RatesNotFinite { .. } | StepFault::StateNotFinite)
        ),
        "{fault}"
    );
    assert_eq!((stepper.time(), state), (0.125, before));
    stepper.step(&mut state, 0.125).expect("it still works");
}

/// Where the time does not matter, a step may be as short as it likes; a law of time could not tell
/// it.
#[test]
fn a_law_of_time_refuses_a_step_that_the_time_cannot_tell() {
    let crank = DrivenSliderCrank::default();
    let mut stepper = Stepper::new(&crank, StandardLagrange, Rk4)
        .expect("acceptable")
        .starting_at(0.125);
    let mut state = crank.described_state::<f64>().expect("described");
    let fault = stepper.step(&mut state, 1e-20).expect_err("no step");
    assert_eq!(
        fault.to_string(),
        "a step of 1e-20 s is below the resolution of the time 0.125 s"
    );
    assert_eq!(stepper.time(), 0.125);
}

#[test]
fn corrected_steps_stay_on_the_constraints() {
    let rod = RodPendulum::default();
    let mut stepper = Stepper::new(&rod, StandardLagrange, Rk4)
        .expect("acceptable")
        .projection(Projection::default());
    let mut state = rod.described_state().expect("described");
    for _ in 0..200 {
        stepper.step(&mut state, 0.02).expect("solvable");
        let view = stepper.view(&state);
        // Round-off of 1 m and 5 m/s, squared.
        assert!(view.violation() <= 1e-29 && view.velocity_violation() <= 1e-27);
    }
}
