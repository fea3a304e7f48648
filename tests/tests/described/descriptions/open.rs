//! Joint coordinates describe no joint that is open.

use super::*;
use holonom::error::StartFault;

fn refused<M: JointCoordinates>(
    mechanism: &M,
    start: M::State<f64>,
) -> SimulationError<M::State<f64>> {
    Simulation::new(mechanism, StandardLagrange, tight())
        .initial_state(start)
        .joint_coordinates()
        .inconsistent_start()
        .run(0.0..=0.1, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("inconsistent")
}

/// Whatever is asked for: a joint of the tree cannot be open, and of one that closes a loop nobody
/// would know.
#[test]
fn open_joints_are_refused() {
    let crane = Crane::driven().expect("acceptable");
    let dynamics = Dynamics::<Problem<_, _>>::new(&crane, StandardLagrange)
        .expect("acceptable")
        .joint_coordinates();
    let handles = Crane::HANDLES;
    let mut open = crane.start::<f64>();
    let mut pose = Crane::pose(&open, handles.load);
    pose.position.z -= 0.01;
    Crane::set_pose(&mut open, handles.load, pose);
    let fault = dynamics.state_of(&open).expect_err("the hook is open");
    assert_eq!(refused(&crane, open).fault, fault);
    let Fault::Start(StartFault::Inconsistent {
        joint,
        quantity,
        violation,
        is_final: true,
    }) = fault
    else {
        panic!("{fault}");
    };
    assert_eq!((joint, quantity), ("hook", Quantity::Length));
    assert!((violation - 0.01).abs() < 1e-9);

    let mut moving = crane.start::<f64>();
    let spin = Crane::angular_velocity_global(&moving, handles.boom) + Vector3::new(0.0, 0.5, 0.0);
    Crane::set_angular_velocity_global(&mut moving, handles.boom, spin);
    let fault = dynamics
        .state_of(&moving)
        .expect_err("the boom turns out of its plane");
    assert_eq!(refused(&crane, moving).fault, fault);
    assert!(
        matches!(
            fault,
            Fault::Start(StartFault::Inconsistent {
                joint: "elbow",
                quantity: Quantity::AngularVelocity,
                ..
            })
        ),
        "{fault}"
    );

    // Corrected, it runs.
    for start in [open, moving] {
        let report = Simulation::new(&crane, StandardLagrange, tight())
            .initial_state(start)
            .assembled()
            .joint_coordinates()
            .run(0.0..=0.1, every(0.1), |_| ControlFlow::Continue(()))
            .expect("corrected");
        assert!(
            report.worst_violation < 1e-24,
            "{:e}",
            report.worst_violation
        );
    }

    // A joint that closes a loop as well.
    let bars = FourBar::default();
    let mut open = bars.described_state::<f64>().expect("described");
    let handles = FourBar::HANDLES;
    let mut pose = FourBar::pose(&open, handles.rocker);
    pose.position.y += 0.02;
    FourBar::set_pose(&mut open, handles.rocker, pose);
    let fault = refused(&bars, open).fault;
    assert!(
        matches!(
            fault,
            Fault::Start(StartFault::Inconsistent {
                quantity: Quantity::Length,
                ..
            })
        ),
        "{fault}"
    );
}
