//! The kinematic analysis of mechanisms with redundant equations: enough of them by count says
//! little.

use holonom::error::{AnalysisFault, StepFault};
use holonom::joints::Revolute;
use holonom::prelude::*;

/// A number that the macro cannot see: it does not decide on the rank.
const WIDTH: f64 = 1.0;

/// Four parallel axes: 18 velocities, 20 equations, and yet a motion.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Undriven {
    #[body(mass = 1.0, inertia = [0.02, 0.01, 0.02], position = [0.0, 0.0, 0.2])]
    crank: Body,
    #[body(mass = 2.0, inertia = [0.01, 0.2, 0.2], position = [0.0, 0.5, 0.4])]
    coupler: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.01, 0.02], position = [0.0, 1.0, 0.2])]
    rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    a: Revolute,
    #[joint(between = [crank, coupler], point = [0.0, 0.0, 0.4], axis = [1.0, 0.0, 0.0])]
    b: Revolute,
    #[joint(between = [coupler, rocker], point = [0.0, 1.0, 0.4], axis = [1.0, 0.0, 0.0])]
    c: Revolute,
    #[joint(between = [rocker, ground], point = [0.0, WIDTH, 0.0], axis = [1.0, 0.0, 0.0])]
    d: Revolute,
}

/// A block on two hinges with crossed axes: 10 equations of rank 6 hold it.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "keep")]
struct Held {
    #[body(mass = 3.0, inertia = [0.2, 0.3, 0.4], position = [0.5, 0.0, 0.0])]
    block: Body,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    x: Revolute,
    #[joint(between = [ground, block], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    y: Revolute,
}

#[test]
fn a_motion_that_redundant_equations_leave_free_is_found_out() {
    let undriven = Undriven::default();
    assert_eq!(Undriven::REPORT.degrees_of_freedom, -2);
    let error = KinematicAnalysis::new(&undriven, Penalty::default())
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("there is no driver");
    let Fault::Analysis(AnalysisFault::MotionLeftFree { share }) = error.fault else {
        panic!("{}", error.fault);
    };
    assert!(share > 1e-3 && share < 0.5, "{share}");
    assert_eq!(error.time, 0.0);
}

#[test]
fn redundant_equations_hold_a_block_with_a_formulation_that_shares_the_forces() {
    let held = Held::default();
    let (block, x, y) = (Held::HANDLES.block, Held::HANDLES.x, Held::HANDLES.y);
    let mut seen = 0;
    let report = KinematicAnalysis::new(&held, AugmentedLagrangian::default())
        .run(0.0_f64..=1.0, every(0.5), |sample| {
            seen += 1;
            let first = sample.reaction(x, block).expect("solvable");
            let second = sample.reaction(y, block).expect("solvable");
            let force = first.force + second.force;
            assert!((force - nalgebra::Vector3::new(0.0, 0.0, 3.0 * 9.81)).norm() < 1e-5);
            let moment = first.moment + second.moment;
            let weight = nalgebra::Vector3::new(0.0, 0.5 * 3.0 * 9.81, 0.0);
            assert!((moment + weight).norm() < 1e-5, "{moment}");
            ControlFlow::Continue(())
        })
        .expect("held");
    assert_eq!((seen, report.poses), (3, 3));
    assert!(report.worst_violation < 1e-24);

    let error = KinematicAnalysis::new(&held, StandardLagrange)
        .run(0.0..=1.0, every(0.5), |_| ControlFlow::Continue(()))
        .expect_err("the equations depend on each other");
    assert!(matches!(
        error.fault,
        Fault::Step(StepFault::Singular { .. })
    ));
}
