//! Settings that do not suit a mechanism are told of, and those that do are not.

use holonom::error::StepFault;
use holonom::joints::PointOnPlane;
use holonom::prelude::*;
use holonom::{Runs, Warning};
use holonom_models::RodPendulum;

/// A particle on two planes through the x axis at a small angle to each other.
#[derive(Mechanism)]
#[mechanism(gravity = [-7.0, 0.0, -7.0])]
struct Wedge {
    #[param]
    angle: f64,
    #[body(mass = 1.0, position = [0.0, 0.0, 0.0])]
    bead: Particle,
    #[joint(between = [ground, bead], point = [0.0, 0.0, 0.0], normal = [0.0, 0.6, 0.8])]
    first: PointOnPlane,
    #[joint(
        between = [ground, bead],
        point = [0.0, 0.0, 0.0],
        normal = [0.0, 0.6 * cos(angle) + 0.8 * sin(angle), 0.8 * cos(angle) - 0.6 * sin(angle)]
    )]
    second: PointOnPlane,
}

/// Whether a run of a tenth of a second or more has such a warning.
fn is_told<M: Mechanism, F: Formulation<f64>, I: Runs<Problem<M, F>>>(
    simulation: &Simulation<'_, Problem<M, F>, I>,
    end: f64,
    is_meant: fn(&Warning) -> bool,
) -> bool {
    let report = simulation.run(0.0..=end, every(end), |_| ControlFlow::Continue(()));
    let warnings = report.expect("solvable").warnings();
    println!("{warnings}");
    warnings.into_iter().any(|warning| is_meant(&warning))
}

#[test]
fn evaluations_that_do_not_converge_are_told() {
    for (angle, expected) in [(1e-2, false), (1e-4, true)] {
        let wedge = Wedge::new(angle).expect("acceptable");
        let method = AugmentedLagrangian::default();
        let simulation = Simulation::new(&wedge, method, Rk4::every(1e-3));
        let is_meant = |warning: &_| matches!(warning, Warning::Unconverged { .. });
        assert_eq!(is_told(&simulation, 0.1, is_meant), expected, "{angle}");
    }
}

#[test]
fn a_penalty_that_is_too_small_for_the_masses_is_told() {
    let rod = RodPendulum::default();
    for (alpha, expected) in [(1e2, true), (Penalty::default().alpha, false)] {
        let method = Penalty {
            alpha,
            ..Penalty::default()
        };
        let simulation = Simulation::new(&rod, method, Rk4::every(1e-3));
        let is_meant = |warning: &_| matches!(warning, Warning::Compliance { .. });
        assert_eq!(is_told(&simulation, 1.0, is_meant), expected, "{alpha}");
    }
}

#[test]
fn a_tolerance_as_large_as_the_mechanism_is_told() {
    let rod = RodPendulum::default();
    for (absolute, expected) in [(1e-2, true), (1e-8, false)] {
        let relative = 1e-6;
        let integrator = DormandPrince::new(Tolerance { relative, absolute });
        let simulation = Simulation::new(&rod, StandardLagrange, integrator);
        let is_meant = |warning: &_| matches!(warning, Warning::CoarseTolerance { .. });
        assert_eq!(is_told(&simulation, 1.0, is_meant), expected, "{absolute}");
    }
}

/// By bodies a correction fails where by joints numbers grow: the cause is the same.
#[test]
fn a_step_that_is_too_long_for_a_correction_is_named() {
    let rod = RodPendulum::default();
    for step in [1.0, 2.0, 5.0, 20.0, 100.0] {
        let simulation = Simulation::new(&rod, StandardLagrange, Rk4::every(step));
        let simulation = simulation.absolute_coordinates();
        let simulation = simulation.projection(Projection::default());
        let end = 1000.0 * step;
        let nothing = |_: &Sample<'_, f64, RodPendulum>| ControlFlow::Continue(());
        let error = simulation.run(0.0..=end, every(end), nothing);
        let error = error.expect_err("nothing of it is right");
        assert_eq!(error.fault, Fault::Step(StepFault::Unstable { step }));
    }
}
