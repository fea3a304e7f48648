//! Kinematics and inverse dynamics of a driven crank.

use core::f64::consts::TAU;
use core::ops::ControlFlow;

use super::crank::{CRANK, Crank, MOTOR, crank};
use super::rod::{GRAVITY, Rod, rod};
use crate::error::{AnalysisFault, StepFault};
use crate::state::State;
use crate::*;

/// About the hinge: of the rod about its centre of mass, and `m s^2`.
const INERTIA: f64 = 0.5855265 + 7.02 * 0.25;

fn proceed<S: Real, M: Mechanism>(_: &Sample<'_, S, M>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn accelerating() -> Crank {
    Crank {
        start: 0.4,
        speed: -2.0,
        acceleration: 7.0,
    }
}

/// `J angle'' = effort - m g s cos(angle)`.
fn the_crank_follows_its_law<F: Formulation<f64>>(formulation: F, tolerance: f64) {
    let crank = accelerating();
    let mut times = 0_u32;
    let report = KinematicAnalysis::new(&crank, formulation)
        .run(0.0..=3.0, every(0.05), |sample| {
            let t = sample.time();
            assert!((t - 0.05 * f64::from(times)).abs() < 1e-14);
            times += 1;
            let angle = 0.4 - 2.0 * t + 3.5 * t * t;
            assert!((sample.angle(MOTOR) - angle).abs() < 1e-12);
            assert!((sample.angle_rate(MOTOR) - (7.0 * t - 2.0)).abs() < 1e-12);
            let turning = sample.accelerations().unwrap()[3];
            assert!((turning - 7.0).abs() < tolerance, "{turning}");
            let effort = sample.driving_effort(MOTOR).unwrap();
            let weight = 7.02 * GRAVITY * 0.5 * angle.cos();
            let expected = INERTIA * 7.0 + weight;
            assert!(
                (effort - expected).abs() < tolerance,
                "{effort} for {expected}"
            );
            assert!(sample.acceleration_violation().unwrap() < tolerance);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!((times, report.poses, report.time), (61, 61, 3.0));
    assert!(report.worst_violation < 1e-24 && !report.stopped);
    assert!(report.iterations < 4 * report.steps);
    assert!(report.warnings().is_empty());
    // More than four turns.
    assert!(report.state.coordinates()[7] > 4.0 * TAU);
}

#[test]
fn a_crank_follows_its_law_and_shows_what_that_takes() {
    the_crank_follows_its_law(StandardLagrange, 1e-9);
    the_crank_follows_its_law(AugmentedLagrangian::default(), 1e-4);
}

#[test]
fn steps_of_several_turns_are_followed_where_the_prediction_is_exact() {
    let crank = crank(9.0);
    let report = KinematicAnalysis::new(&crank, StandardLagrange)
        .run(0.0..=10.0, every(2.0), |sample| {
            assert!((sample.angle(MOTOR) - 9.0 * sample.time()).abs() < 1e-9);
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(report.poses, 6);
}

#[test]
fn applied_forces_change_the_effort_and_not_the_motion() {
    let crank = crank(2.0);
    KinematicAnalysis::new(&crank, StandardLagrange)
        .forces(|_, _, loads| loads.moment(CRANK, [-30.0, 0.0, 0.0]))
        .run(0.0..=1.0, every(0.1), |sample| {
            let angle = 2.0 * sample.time();
            let expected = 30.0 + 7.02 * GRAVITY * 0.5 * angle.cos();
            assert!((sample.driving_effort(MOTOR).unwrap() - expected).abs() < 1e-9);
            // The hinge carries the weight, and turns the centre of mass on its circle.
            let wrench = sample.reaction(MOTOR, CRANK).unwrap();
            let inwards = 7.02 * 0.5 * 4.0;
            assert!((wrench.force.y + inwards * angle.cos()).abs() < 1e-9);
            assert!((wrench.force.z - (7.02 * GRAVITY - inwards * angle.sin())).abs() < 1e-9);
            assert!((wrench.moment.x - expected).abs() < 1e-9);
            ControlFlow::Continue(())
        })
        .unwrap();
}

#[test]
fn an_observer_may_stop_the_analysis() {
    let crank = crank(1.0);
    let analysis = KinematicAnalysis::new(&crank, StandardLagrange);
    let report = analysis
        .run(0.0..=1.0, every(0.1), |sample| {
            if sample.time() < 0.35 {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        })
        .unwrap();
    assert!(report.stopped && (report.time - 0.4).abs() < 1e-15);
    let mut times = 0;
    let report = analysis
        .run(0.0..=0.5, every_step(), |_| {
            times += 1;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!((times, report.poses), (2, 2));
}

#[test]
fn a_mechanism_that_is_not_driven_is_refused() {
    let rod = rod();
    let error = KinematicAnalysis::new(&rod, StandardLagrange)
        .run(0.0..=1.0, every(0.1), proceed)
        .unwrap_err();
    let degrees_of_freedom = 1;
    assert_eq!(
        error.fault,
        Fault::Analysis(AnalysisFault::NotDriven { degrees_of_freedom })
    );
    assert_eq!(error.state, rod.described_state::<f64>().unwrap());
    let bad = Rod { mass: 0.0 };
    let error = KinematicAnalysis::new(&bad, StandardLagrange)
        .run(0.0..=1.0, every(0.1), proceed::<f64, Rod>)
        .unwrap_err();
    assert!(matches!(error.fault, Fault::Parameter(_)));
}

#[test]
fn a_law_beyond_the_numbers_ends_the_analysis_at_the_last_good_pose() {
    let crank = Crank {
        start: 0.0,
        speed: 1.0,
        acceleration: f64::MAX,
    };
    let error = KinematicAnalysis::new(&crank, StandardLagrange)
        .run(0.0..=10.0, every(5.0), proceed)
        .unwrap_err();
    assert!(error.state.coordinates().iter().all(|q| q.is_finite()));
    let nan = State::from_parts([f64::NAN; 8], [0.0; 6]);
    let error = KinematicAnalysis::new(&crank, StandardLagrange)
        .initial_state(nan)
        .run(0.0..=10.0, every(5.0), proceed)
        .unwrap_err();
    assert_eq!(error.fault, Fault::Step(StepFault::StateNotFinite));
}

#[test]
fn single_precision_follows_as_well() {
    let crank = accelerating();
    KinematicAnalysis::new(&crank, StandardLagrange)
        .run(0.0_f32..=2.0, every(0.05), |sample| {
            let t = sample.time();
            let angle = 0.4 - 2.0 * t + 3.5 * t * t;
            assert!((sample.angle(MOTOR) - angle).abs() < 1e-4);
            ControlFlow::Continue(())
        })
        .unwrap();
}
