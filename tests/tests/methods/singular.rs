//! Where equations depend on each other only in one configuration.

use holonom::error::StepFault;
use holonom::joints::{DisplacementDriver, Distance, PointOnLine, PointOnPlane};
use holonom::prelude::*;

/// An arm of two links of 0.5 m whose hand is driven along x at 0.2 m/s, from 0.6 m on: beyond its
/// reach after 2 s.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0])]
pub(crate) struct Arm {
    #[body(mass = 1.0, position = [0.3, 0.4, 0.0])]
    elbow: Particle,
    #[body(mass = 1.0, position = [0.6, 0.0, 0.0], velocity = [0.2, 0.0, 0.0])]
    hand: Particle,
    #[joint(between = [ground, elbow], head = [0.0, 0.0, 0.0], tail = [0.3, 0.4, 0.0])]
    upper: Distance,
    #[joint(between = [elbow, hand], head = [0.3, 0.4, 0.0], tail = [0.6, 0.0, 0.0])]
    lower: Distance,
    #[joint(between = [ground, elbow], point = [0.3, 0.4, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: PointOnPlane,
    #[joint(between = [ground, hand], point = [0.6, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    line: PointOnLine,
    #[joint(
        between = [ground, hand],
        point = [0.6, 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        motion = 0.2 * time
    )]
    pull: DisplacementDriver,
}

/// The stretched arm is singular, and what its links lack in length is a self-stress, which a
/// correction excuses on the way through: but not for long.
#[test]
fn an_arm_pulled_beyond_its_reach_stops() {
    let arm = Arm::default();
    let error = Simulation::new(&arm, Penalty::default(), Rk4::every(1e-4))
        .assembled()
        .projection(Projection::default())
        .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("out of reach");
    println!("{error}");
    assert!((1.99..2.001).contains(&error.time), "{}", error.time);
    let Fault::Step(StepFault::NotConverged { joint, .. }) = error.fault else {
        panic!("{error}");
    };
    assert!(matches!(joint, Some("upper" | "lower" | "pull")), "{error}");
    // Whoever looks for the configuration itself is told at once.
    let mut state = error.state;
    let fault = arm.assemble(2.0 + 1e-6, &mut state);
    assert!(
        matches!(fault, Err(Fault::Step(StepFault::NotConverged { .. }))),
        "{fault:?}"
    );
}

/// With rigid constraints nothing yields: the accelerations grow without bound, and the step
/// control gives up.
#[test]
fn a_step_control_that_gives_up_names_the_joint() {
    let arm = Arm::default();
    let error = Simulation::new(&arm, StandardLagrange, DormandPrince::default())
        .assembled()
        .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("out of reach");
    println!("{error}");
    assert!((1.99..2.001).contains(&error.time), "{}", error.time);
    let Fault::Step(StepFault::SizeUnderflow {
        joint: Some(joint), ..
    }) = error.fault
    else {
        panic!("{error}");
    };
    assert!(["upper", "lower", "pull"].contains(&joint), "{error}");
}

/// The same arm in a kinematic analysis: steps come up to the stretched arm, where the equations
/// depend on each other.
#[test]
fn an_analysis_beyond_reach_names_a_joint() {
    let arm = Arm::default();
    let error = KinematicAnalysis::new(&arm, StandardLagrange)
        .run(0.0..=3.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("out of reach");
    println!("{error}");
    assert!((1.99999..2.001).contains(&error.time), "{}", error.time);
    let Fault::Step(StepFault::Singular { name, .. }) = error.fault else {
        panic!("{error}");
    };
    assert!(["upper", "lower", "pull"].contains(&name), "{error}");
}
