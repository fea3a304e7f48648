//! A kinematic analysis stays on its branch however far apart its reports are.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, FRAC_PI_8, PI, TAU};

use holonom::Warning;
use holonom::error::StepFault;
use holonom::joints::{
    AngleDriver, Cylindrical, DisplacementDriver, Prismatic, Revolute, Spherical,
};
use holonom::prelude::*;

use super::linkages::{CRANK_ROCKER, DrivenFourBar, Lengths, Random};

/// The analysis over 36 rad of the crank; steps, and reports that are off.
fn analysed<F: Formulation<f64>>(
    lengths: Lengths,
    formulation: F,
    every_so: f64,
) -> (usize, usize) {
    let mechanism = lengths.driven();
    let handles = DrivenFourBar::HANDLES;
    let mut wrong = 0;
    let report = KinematicAnalysis::new(&mechanism, formulation)
        .run(0.0..=36.0, every(every_so), |sample| {
            let off = lengths.error(sample.time(), sample.angle(handles.d));
            wrong += usize::from(off > 1e-8);
            ControlFlow::Continue(())
        })
        .unwrap_or_else(|error| panic!("{lengths:?}: {error}"));
    assert!(
        report.warnings().is_empty(),
        "{lengths:?}: {}",
        report.warnings()
    );
    (report.steps, wrong)
}

#[test]
fn reports_of_a_crank_rocker_are_right_however_far_apart_they_are() {
    for every_so in [0.5, 2.0, 5.0, 6.0, 6.3, 7.0, 12.0] {
        let (steps, wrong) = analysed(CRANK_ROCKER, StandardLagrange, every_so);
        assert_eq!(wrong, 0, "every {every_so} rad");
        // Steps of up to 0.2 rad, of the coupler or the rocker too.
        assert!((180..500).contains(&steps), "{steps}");
    }
    let (_, wrong) = analysed(CRANK_ROCKER, AugmentedLagrangian::default(), 7.0);
    assert_eq!(wrong, 0);
}

#[test]
fn random_crank_rockers_stay_on_their_branch() {
    let mut random = Random(2);
    for _ in 0..25 {
        let (_, wrong) = analysed(random.crank_rocker(), StandardLagrange, 12.0);
        assert_eq!(wrong, 0);
    }
}

/// A parallelogram from its quarter turn on: at every half turn it is flat.
#[derive(Mechanism)]
struct Parallelogram {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.0, 0.2, 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5, 0.4, 0.0])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [1.0, 0.2, 0.0])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.4, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [1.0, 0.4, 0.0])]
    c: Spherical,
    #[joint(between = [ground, rocker], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    d: Cylindrical,
    #[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = time)]
    motor: AngleDriver,
}

#[test]
fn a_branch_point_is_passed_straight_on_and_said() {
    let mechanism = Parallelogram::default();
    let handles = Parallelogram::HANDLES;
    for (end, is_passed) in [(1.3, false), (12.0, true)] {
        let report = KinematicAnalysis::new(&mechanism, StandardLagrange)
            .run(0.0_f64..=end, every(5.0), |sample| {
                let coupler = sample.pose(handles.coupler).position;
                let (sine, cosine) = sample.time().sin_cos();
                assert!((coupler.x - (0.5 - 0.4 * sine)).abs() < 1e-8, "{coupler}");
                assert!((coupler.y - 0.4 * cosine).abs() < 1e-8, "{coupler}");
                ControlFlow::Continue(())
            })
            .expect("a way");
        let mut told = report.warnings().into_iter();
        let is_told = told.any(|warning| matches!(warning, Warning::BranchPoint { .. }));
        assert_eq!(is_told, is_passed, "{}", report.warnings());
        assert_eq!(report.warnings().is_empty(), !is_passed);
    }
}

/// Reports that fall on the flat configurations, or next to them, change nothing: positions and
/// rates are right there too, and only what the motion takes is refused.
#[test]
fn reports_on_a_branch_point_are_right() {
    let mechanism = Parallelogram::default();
    let handles = Parallelogram::HANDLES;
    for every_so in [
        0.01,
        0.3,
        FRAC_PI_2,
        FRAC_PI_4 * (1.0 + 1e-9),
        FRAC_PI_8 * (1.0 + 1e-5),
    ] {
        let report = KinematicAnalysis::new(&mechanism, StandardLagrange)
            .run(0.0_f64..=5.0, every(every_so), |sample| {
                let time = sample.time();
                let off = (sample.angle(handles.d) - time) / TAU;
                assert!((off - off.round()).abs() < 1e-10, "{time}: {off:e}");
                let rate = sample.angle_rate(handles.d);
                assert!((rate - 1.0).abs() < 1e-7, "{time}: {rate}");
                let beside = ((time - FRAC_PI_2) / PI).fract().abs() * PI;
                let beside = beside.min(PI - beside);
                match sample.driving_effort(handles.motor) {
                    Ok(_) => assert!(beside > 1e-5, "{time}"),
                    Err(Fault::Step(StepFault::Singular { .. })) => {
                        assert!(beside < 3e-3, "{time}")
                    }
                    Err(fault) => panic!("{fault}"),
                }
                ControlFlow::Continue(())
            })
            .unwrap_or_else(|error| panic!("every {every_so}: {error}"));
        let mut told = report.warnings().into_iter();
        assert!(told.any(|warning| matches!(warning, Warning::BranchPoint { .. })));
    }
}

/// A slider that a smooth law drives through the dead points of its crank, which turns at 1 rad/s.
#[derive(Mechanism)]
struct Piston {
    #[body(mass = 0.5, inertia = [0.001, 0.001, 0.002], position = [0.0, 0.15, 0.0])]
    crank: Body,
    #[body(mass = 0.4, inertia = [0.001, 0.003, 0.003], position = [0.3, 0.15, 0.0])]
    rod: Body,
    #[body(mass = 0.8, inertia = [0.001, 0.001, 0.001], position = [sqrt(0.4), 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [crank, rod], point = [0.0, 0.3, 0.0])]
    b: Spherical,
    #[joint(between = [rod, slider], point = [sqrt(0.4), 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    c: Cylindrical,
    #[joint(between = [ground, slider], point = [sqrt(0.4), 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Prismatic,
    #[joint(
        between = [ground, slider],
        point = [sqrt(0.4), 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        motion = sqrt(0.49 - 0.09 * cos(time) * cos(time)) - 0.3 * sin(time) - sqrt(0.4)
    )]
    motor: DisplacementDriver,
}

/// The pivot that vanishes is the least one only near the dead point, so that steps may pass over
/// that.
#[test]
fn a_dead_point_is_passed_whatever_is_reported() {
    let mechanism = Piston::default();
    let handles = Piston::HANDLES;
    for every_so in [0.005, 0.01, 0.02, 0.05, 0.1, 0.3, 0.7, 1.0, FRAC_PI_2] {
        let report = KinematicAnalysis::new(&mechanism, StandardLagrange)
            .run(0.0_f64..=4.0, every(every_so), |sample| {
                let off = (sample.angle(handles.a) - sample.time()) / TAU;
                assert!((off - off.round()).abs() < 1e-10, "{off:e}");
                let rate = sample.angle_rate(handles.a);
                assert!((rate - 1.0).abs() < 1e-7, "{rate}");
                ControlFlow::Continue(())
            })
            .unwrap_or_else(|error| panic!("every {every_so}: {error}"));
        let mut told = report.warnings().into_iter();
        let is_told = told.any(|warning| matches!(warning, Warning::BranchPoint { .. }));
        assert!(is_told, "every {every_so}");
    }
}

/// A crank that is turned by a whole turn between two reports, from rest to rest.
#[derive(Mechanism)]
struct Pulse {
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.02], position = [0.2, 0.0, 0.0])]
    crank: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    a: Revolute,
    #[joint(between = [ground, crank], axis = [0.0, 0.0, 1.0], motion = TAU * smooth_step(time - 1.0))]
    motor: AngleDriver,
}

#[test]
fn a_turn_between_two_reports_is_followed() {
    let mechanism = Pulse::default();
    let handles = Pulse::HANDLES;
    let report = KinematicAnalysis::new(&mechanism, StandardLagrange)
        .run(0.0..=3.0, every(3.0), |sample| {
            let turned = if sample.time() > 2.0 { TAU } else { 0.0 };
            assert!((sample.angle(handles.motor) - turned).abs() < 1e-9);
            ControlFlow::Continue(())
        })
        .expect("a way");
    assert!(report.steps > 30 && report.shortened > 0, "{report:?}");
}
