//! A run begins on its constraints, or is told to begin elsewhere.

use holonom::error::{Quantity, StartFault};
use holonom::joints::{AngleDriver, Distance, Revolute};
use holonom::prelude::*;
use nalgebra::Vector3;

/// A rod of 1 m on a hinge.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
pub(crate) struct Rod {
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

/// The same with a motor that turns at 3 rad/s from the first instant on, while the rod is
/// described at rest.
#[derive(Mechanism)]
struct Driven {
    #[body(mass = 2.0, inertia = [0.2, 0.01, 0.2], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, rod], axis = [1.0, 0.0, 0.0], motion = 3.0 * time)]
    motor: AngleDriver,
}

/// A particle on a string whose length is a number of five digits.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Rounded {
    #[body(mass = 1.0, position = [0.1, 0.2, 0.3])]
    bob: Particle,
    #[joint(between = [ground, bob], head = [0.0, 0.0, 0.0], tail = [0.1, 0.2, 0.3], length = 0.37417)]
    string: Distance,
}

fn go(_: &Sample<'_, f64, Rod>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn a_rod_that_flies_off_its_hinge_is_refused() {
    let rod = Rod::default();
    let mut state = rod.described_state().expect("described");
    Rod::set_velocity(&mut state, Rod::HANDLES.rod, Vector3::new(0.0, 5.0, 0.0));
    let simulation =
        || Simulation::new(&rod, StandardLagrange, DormandPrince::default()).initial_state(state);
    let error = simulation()
        .run(0.0..=1.0, every(0.1), go)
        .expect_err("refused");
    println!("{error}");
    let Fault::Start(StartFault::Inconsistent {
        joint: "hinge",
        quantity: Quantity::Speed,
        violation,
        is_final: false,
    }) = error.fault
    else {
        panic!("{error}");
    };
    assert!((violation - 5.0).abs() < 1e-12);
    assert_eq!(
        error.fault.to_string(),
        "the bodies of joint `hinge` move against it at 5 m/s at the start: `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
    );
    let report = simulation()
        .assembled()
        .run(0.0..=1.0, every(0.1), go)
        .expect("corrected");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    let report = simulation()
        .inconsistent_start()
        .run(0.0..=1.0, every(0.1), go)
        .expect("on purpose");
    let told: Vec<String> = report
        .warnings()
        .into_iter()
        .map(|warning| warning.to_string())
        .collect();
    println!("{told:?}");
    assert!(
        told.iter()
            .any(|warning| warning.starts_with("joint `hinge` was open by "))
    );
}

#[test]
fn a_rod_beside_its_hinge_is_refused() {
    let rod = Rod::default();
    let mut state = rod.described_state().expect("described");
    let mut pose = Rod::pose(&state, Rod::HANDLES.rod);
    pose.position.z = 1e-3;
    Rod::set_pose(&mut state, Rod::HANDLES.rod, pose);
    let error = Simulation::new(&rod, Baumgarte::default(), DormandPrince::default())
        .initial_state(state)
        .run(0.0..=1.0, every(0.1), go)
        .expect_err("refused");
    assert_eq!(
        error.to_string(),
        "at 0 s: joint `hinge` is open by 0.001 m at the start: `.assembled()` corrects the start, `.inconsistent_start()` accepts it"
    );
}

#[test]
fn a_motor_that_turns_already_wants_a_rod_that_does() {
    let driven = Driven::default();
    let error = Simulation::new(&driven, StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("refused");
    println!("{error}");
    assert!(matches!(
        error.fault,
        Fault::Start(StartFault::Inconsistent {
            joint: "motor",
            quantity: Quantity::AngularVelocity,
            ..
        })
    ));
}

#[test]
fn numbers_of_five_digits_are_a_start() {
    let rounded = Rounded::default();
    let report = Simulation::new(&rounded, StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect("as good as the numbers are");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}
