//! What a run reports between the ends of its steps, and by joints, says what it says at the ends,
//! and by bodies.

use std::f64::consts::TAU;

use holonom::joints::{AngleDriver, Revolute, Spherical};
use holonom::prelude::*;
use holonom::{
    Adams, AdamsBashforthMoulton4, DormandPrince853, Heun, Midpoint, RadauIIA, Runs, Sample,
    Warning,
};
use holonom_models::RodPendulum;
use holonom_tests::RunsBoth;

/// An arm that is swung to and fro.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Driven {
    #[body(mass = 5.0, inertia = [0.02, 0.09, 0.1], position = [0.2, 0.0, 0.0])]
    arm: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shoulder: Revolute,
    #[joint(between = [ground, arm], axis = [0.0, 0.0, 1.0], motion = 0.4 * sin(5.0 * time))]
    motor: AngleDriver,
}

/// A ball that turns evenly about its centre.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Turning {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.2], angular_velocity = [0.0, 0.0, 100.0])]
    body: Body,
    #[joint(between = [ground, body], point = [0.0, 0.0, 0.0])]
    ball: Spherical,
}

/// A wheel that turns evenly.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
pub(crate) struct Wheel {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.3], angular_velocity = [0.0, 0.0, 10.0])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
}

#[test]
fn reports_within_steps_do_not_disturb_the_balance_of_energy() {
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: 1e-11,
    };
    fn check<I: RunsBoth<Driven, StandardLagrange>>(integrator: I) {
        let arm = Driven::default();
        let motor = Driven::HANDLES.motor;
        let run = |at_steps: bool, by_joints: bool| {
            let reports = if at_steps { every_step() } else { every(0.013) };
            let simulation = Simulation::new(&arm, StandardLagrange, integrator)
                .assembled()
                .projection(Projection::default());
            let observe = |sample: &Sample<'_, f64, Driven>| {
                let expected = -3.0 * (5.0 * sample.time()).sin();
                let effort = sample.driving_effort(motor).expect("it has multipliers");
                assert!((effort - expected).abs() < 1e-9);
                ControlFlow::Continue(())
            };
            let report = if by_joints {
                let simulation = simulation.joint_coordinates();
                simulation.run(0.0..=2.0, reports, observe)
            } else {
                simulation.run(0.0..=2.0, reports, observe)
            };
            let report = report.expect("nothing stops it");
            assert!(report.warnings().is_empty(), "{}", report.warnings());
            let monitor = report.monitor.expect("it was monitored");
            monitor.energy_drift()
        };
        for by_joints in [false, true] {
            let [at_steps, between] = [true, false].map(|at_steps| run(at_steps, by_joints));
            println!("energy: {at_steps:?}, {between:?}, by joints: {by_joints}");
        }
    }
    check(DormandPrince853::new(tolerance));
    check(RadauIIA::new(tolerance));
    check(DormandPrince::new(tolerance));
    check(Adams::new(tolerance));
    check(Rk4::every(0.01));
}

#[test]
fn orientations_that_lag_are_warned_of_in_both_descriptions() {
    let ball = Turning::default();
    for step in [0.01, 0.02, 0.05, 0.1] {
        let simulation = || Simulation::new(&ball, StandardLagrange, Rk4::every(step));
        let bodies = simulation().run(0.0..=10.0, every(10.0), |_| ControlFlow::Continue(()));
        let joints = simulation().joint_coordinates();
        let joints = joints.run(0.0..=10.0, every(10.0), |_| ControlFlow::Continue(()));
        let drifts: [f64; 2] = [bodies.expect("it runs"), joints.expect("it runs")].map(|report| {
            assert!(!report.warnings().is_empty(), "{step}");
            report
                .monitor
                .expect("it was monitored")
                .orientation_drift()
        });
        assert!(
            drifts[0] > 0.0 && (drifts[0] / drifts[1] - 1.0).abs() < 1e-6,
            "{drifts:?}"
        );
    }
}

#[test]
fn short_steps_that_lag_are_warned_of_by_as_much() {
    fn check<I: Runs<Problem<Wheel, StandardLagrange>>>(integrator: I, until: f64) {
        let wheel = Wheel::default();
        let mut off = 0.0;
        let report = Simulation::new(&wheel, StandardLagrange, integrator)
            .run(0.0..=until, every(until), |sample| {
                let p = sample.pose(Wheel::HANDLES.wheel).orientation;
                let turned = 2.0 * p.k.atan2(p.w) - 10.0 * sample.time();
                off = (turned - TAU * (turned / TAU).round()).abs();
                ControlFlow::Continue(())
            })
            .expect("nothing stops it");
        let shifts = report
            .warnings()
            .into_iter()
            .filter_map(|warning| match warning {
                Warning::Orientation { shift, .. } => Some(shift),
                _ => None,
            });
        let shift: f64 = shifts.sum();
        println!("{until} s: off by {off:e} rad, warned of by {shift:e}");
        assert!(off > 1e-2 && shift > 0.8 * off && shift < 2.0 * off);
    }
    check(Midpoint::every(0.01), 10.0);
    check(Midpoint::every(0.002), 100.0);
    check(Heun::every(0.01), 40.0);
    check(Rk4::every(0.02), 2000.0);
    check(Rk4::every(0.05), 100.0);
    check(AdamsBashforthMoulton4::every(0.02), 1000.0);
}

#[test]
fn euler_parameters_keep_their_sign_from_report_to_report() {
    let wheel = Wheel::default();
    let simulation =
        Simulation::new(&wheel, StandardLagrange, DormandPrince::default()).joint_coordinates();
    for reports in [every(0.1), every_step()] {
        let mut before: Option<[f64; 4]> = None;
        let mut turned = 0;
        simulation
            .run(0.0..=10.0, reports, |sample| {
                let w = sample.pose(Wheel::HANDLES.wheel).orientation;
                let p = [w.w, w.i, w.j, w.k];
                if let Some(before) = before.replace(p) {
                    let cosine: f64 = before.iter().zip(p).map(|(a, b)| a * b).sum();
                    assert!(cosine > 0.0, "at {} s", sample.time());
                    turned += 1;
                }
                ControlFlow::Continue(())
            })
            .expect("nothing stops it");
        assert!(turned > 10);
    }
}

/// A joint that opens at 1 cm/s, and that the formulation closes within some steps, is looked at as
/// often as it may have closed.
#[test]
fn what_opens_and_closes_between_looks_is_seen() {
    let rod = RodPendulum::default();
    let mut start = rod.described_state().expect("described");
    let velocity = nalgebra::Vector3::new(0.01, 0.0, 0.0);
    RodPendulum::set_velocity(&mut start, RodPendulum::HANDLES.rod, velocity);
    let step = 1e-3_f64;
    let mut open = 0.0_f64;
    let rate = 1.0 / (8.0 * step);
    let report = Simulation::new(&rod, Baumgarte::new(rate, rate), Rk4::every(step))
        .initial_state(start)
        .inconsistent_start()
        .run(0.0..=0.1, every_step(), |sample| {
            open = open.max(f64::sqrt(sample.violation()));
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    let seen = report.monitor.expect("monitored");
    let seen = seen.violation(RodPendulum::HANDLES.pivot).length;
    assert!(open > 2e-5 && seen > 0.9 * open, "{seen:e} of {open:e}");
}
