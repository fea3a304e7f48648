//! A02 with five windows: ten times through a singular configuration with six ways to go on, in
//! both descriptions.

use holonom::error::StepFault;
use holonom::prelude::*;
use holonom_models::QuintupleFourBar;
use holonom_models::problems::QuintupleParallelogram;
use holonom_study::trade::Problem;
use holonom_tests::RunsBoth;
use holonom_tests::is_exhaustive;
use nalgebra::Vector3;

use super::{change_of_energy, tight};

/// The error that is asked of the state (m and m/s, of 2 m and 4 m/s).
const ASKED: f64 = 1e-4;
/// Two rods (m) that part by more are none of a parallelogram: a projection leaves round-off, on
/// another way they part by up to 2 m.
const PARALLEL: f64 = 1e-10;

/// The largest error of place (m) and velocity (m/s) of the top left pin, together, in ten seconds
/// against the closed form, every 0.1 s.
///
/// With a projection after every step: without one a violation decides which way the mechanism goes
/// on, and standard multipliers, penalty and augmented Lagrangian of most settings leave the way of
/// the parallelograms or are refused (the run has a warning, or ends with a fault).
fn error<F: Formulation<f64>, I: RunsBoth<QuintupleFourBar, F>>(
    by_joints: bool,
    method: F,
    integrator: I,
) -> Result<f64, Fault> {
    let problem = QuintupleParallelogram::default();
    let rods = QuintupleFourBar::HANDLES.rods;
    let [mut worst, mut apart] = [0.0_f64; 2];
    let mut compared = 0;
    let look = |sample: &Sample<'_, f64, QuintupleFourBar>| {
        let reference = problem.reference(sample.time()).expect("a closed form");
        let read = problem.read(sample);
        let squares = read.iter().zip(&reference).map(|(a, b)| (a - b).powi(2));
        worst = worst.max(squares.sum::<f64>().sqrt());
        let top = Vector3::from(QuintupleFourBar::TOP);
        let along = rods.map(|rod| sample.point(rod, top) - sample.point(rod, -top));
        for other in along {
            apart = apart.max((other - along[0]).norm());
        }
        compared += 1;
        ControlFlow::Continue(())
    };
    let simulation = Simulation::new(problem.mechanism(), method, integrator);
    let simulation = simulation.projection(Projection::default());
    let run = if by_joints {
        let simulation = simulation.joint_coordinates();
        simulation.run(0.0..=10.0, every(0.1), look)
    } else {
        simulation.run(0.0..=10.0, every(0.1), look)
    };
    let report = run.map_err(|error| error.fault)?;
    let description = if by_joints { "joints" } else { "bodies" };
    println!(
        "{description}, {method:?}, {integrator:?}: {worst:e}, rods part by {apart:e} m, {} evaluations",
        report.evaluations
    );
    assert_eq!(compared, 101);
    assert!(apart <= PARALLEL, "another way: {apart:e}");
    Ok(worst)
}

/// The first of these, or all.
fn tried<T>(all: &[T]) -> &[T] {
    &all[..if is_exhaustive() { all.len() } else { 1 }]
}

/// By bodies and by joints.
fn errors<F: Formulation<f64>>(method: F, step: f64) -> [f64; 2] {
    [false, true].map(|by_joints| {
        error(by_joints, method, Rk4::every(step)).expect("solvable at every stage")
    })
}

/// Fixed steps of which no stage falls upon a line, where multipliers are not determined: step
/// control from 1e-8 down comes as near as that, and is refused.
#[test]
fn standard_multipliers_pass() {
    for &step in tried(&[5.5e-3, 4e-3, 2e-3]) {
        let found = errors(StandardLagrange, step);
        assert!(found.iter().all(|&error| error <= ASKED), "{found:?}");
    }
    for &step in tried(&[1.1e-3, 7e-4, 3.3e-4]) {
        let found = errors(StandardLagrange, step);
        assert!(found.iter().all(|&error| error <= 1e-8), "{found:?}");
    }
}

/// A penalty has an error of its own on the lines, which falls with the step: 2.4e-4 of 2 ms by
/// bodies are too much.
#[test]
fn penalties_pass_by_short_steps() {
    for &step in tried(&[1.1e-3, 7e-4]) {
        let found = errors(Penalty::default(), step);
        assert!(found.iter().all(|&error| error <= ASKED), "{found:?}");
    }
}

/// By bodies the default `alpha` of 1e7 kg, which does for two windows, does not converge in 20
/// iterations near the lines of five: ten times as much does, or 100 iterations.
#[test]
fn an_augmented_lagrangian_passes_with_a_larger_alpha() {
    let default = AugmentedLagrangian::default();
    let larger = AugmentedLagrangian {
        alpha: 1e8,
        ..default
    };
    let longer = AugmentedLagrangian {
        max_iterations: 100,
        ..default
    };
    for &method in tried(&[larger, longer]) {
        if is_exhaustive() {
            let found = error(false, method, tight()).expect("converges");
            assert!(found <= 1e-7, "{found:e}");
        }
        let found = error(false, method, Rk4::every(1.1e-3)).expect("converges");
        assert!(found <= ASKED, "{found:e}");
    }
    // What does not converge is refused and not wrong.
    for result in [
        error(false, default, tight()),
        error(false, default, Rk4::every(4e-3)),
        error(true, default, tight()),
        error(true, default, Rk4::every(4e-3)),
    ] {
        match result {
            Ok(found) => assert!(found <= ASKED, "{found:e}"),
            Err(fault) => assert!(
                matches!(fault, Fault::Step(StepFault::NotConverged { .. })),
                "{fault}"
            ),
        }
    }
}

#[test]
fn the_energy_stays_up_to_the_first_line() {
    /// s; the line comes after 0.71869 s.
    const BEFORE_THE_LINE: f64 = 0.6;
    let row = QuintupleFourBar::default();
    // Of 82 J that go to and fro.
    let change = change_of_energy(&row, StandardLagrange, BEFORE_THE_LINE, 81.98);
    assert!(change <= 1e-8, "{change:e}");
}

#[test]
fn every_window_says_three_things_twice() {
    let report = QuintupleFourBar::REPORT;
    let dropped = report.redundant.iter().filter(|row| row.dropped).count();
    assert_eq!((report.equations, dropped), (65, 15));
}
