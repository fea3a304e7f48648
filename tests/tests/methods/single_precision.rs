//! The same runs in single precision.

use holonom::prelude::*;
use holonom_models::RodPendulum;

use crate::pendulum::{SWINGS, angle};

/// The angle at 1 s: round-off of 6e-8 a step over 200 steps, which the motion magnifies a few
/// times.
const ROUND_OFF: f64 = 2e-4;

fn swings<F: Formulation<f32>>(method: F) {
    let rod = RodPendulum::default();
    let mut reached = f64::NAN;
    let report = Simulation::new(&rod, method, Rk4::every(0.005_f32))
        .run(0.0..=1.0, every(0.1), |sample| {
            reached = angle(sample, RodPendulum::HANDLES.pivot);
            ControlFlow::Continue(())
        })
        .expect("solvable");
    let error = reached - SWINGS[0].angle;
    println!(
        "{method:?}: {error:e} rad, violation {:e}",
        report.worst_violation
    );
    assert!(error.abs() <= ROUND_OFF);
    assert!(report.worst_violation <= 1e-8);
}

#[test]
fn the_pendulum_swings_in_single_precision() {
    swings(StandardLagrange);
    swings(Baumgarte::default());
    swings(AugmentedLagrangian::default());
    swings(Penalty::default());
}

#[test]
fn the_step_control_works_in_single_precision() {
    let rod = RodPendulum::default();
    let ode45 = DormandPrince::new(Tolerance {
        relative: 1e-4_f32,
        absolute: 1e-6,
    });
    let report = Simulation::new(&rod, Baumgarte::default(), ode45)
        .run(0.0..=2.0, every(0.05), |_| ControlFlow::Continue(()))
        .expect("solvable");
    assert_eq!(report.time, 2.0);
    assert!(report.accepted > 20 && report.accepted < 2000, "{report:?}");
}
