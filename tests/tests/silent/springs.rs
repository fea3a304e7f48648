//! A spring whose points meet, and steps that are too long for a damper or a spin.

use holonom::error::{NotFinite, StepFault};
use holonom::forces::{SpringDamper, TorsionalActuator};
use holonom::joints::{PointOnLine, Revolute};
use holonom::prelude::*;

const ACCURATE: Tolerance<f64> = Tolerance {
    relative: 1e-9,
    absolute: 1e-9,
};

/// A mass on a spring of free length zero, from the anchor, pushed aside.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Zero {
    #[body(mass = 1.0, velocity = [0.3, 0.0, 0.0])]
    mass: Particle,
    #[force(
        between = [ground, mass], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        stiffness = 100.0, free_length = 0.0
    )]
    spring: SpringDamper,
}

/// The same on a line through the anchor, with a free length.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct WithLength {
    #[body(mass = 1.0)]
    mass: Particle,
    #[joint(between = [ground, mass], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    line: PointOnLine,
    #[force(
        between = [ground, mass], head = [0.0, 0.0, 0.0], tail = [0.0, 0.0, 0.0],
        stiffness = 100.0, free_length = 0.2
    )]
    spring: SpringDamper,
}

/// `m r'' = -k r + m g`, through the anchor once and again: `x = 0.03 sin 10 t`,
/// `z = -0.0981 (1 - cos 10 t)`.
#[test]
fn a_spring_of_free_length_zero_passes_its_anchor() {
    let zero = Zero::default();
    let mass = Zero::HANDLES.mass;
    let see = |sample: &Sample<'_, f64, Zero>| {
        let (position, t) = (sample.pose(mass).position, sample.time());
        assert!(
            (position.x - 0.03 * (10.0 * t).sin()).abs() < 1e-7,
            "{position}"
        );
        let z = -0.0981 * (1.0 - (10.0 * t).cos());
        assert!((position.z - z).abs() < 1e-7, "{position}");
        let (pull, energy) = (sample.load(Zero::HANDLES.spring, mass), sample.energy());
        assert!((pull.expect("it is between").force.z + 100.0 * position.z).abs() < 1e-12);
        assert!((energy - 0.045).abs() < 1e-7, "{energy}");
        ControlFlow::Continue(())
    };
    let dynamics = Simulation::new(&zero, StandardLagrange, DormandPrince::new(ACCURATE));
    let dynamics = dynamics.absolute_coordinates();
    let report = dynamics.run(0.0..=2.0, every(0.01), see).expect("it runs");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
    Simulation::new(&zero, StandardLagrange, Rk4::every(5e-4))
        .joint_coordinates()
        .run(0.0..=2.0, every(0.01), see)
        .expect("it runs");
}

#[test]
fn a_spring_without_direction_is_named() {
    let origin = NotFinite::Force("spring");
    let mechanism = WithLength::default();
    let run = |joints: bool| {
        let simulation = Simulation::new(&mechanism, StandardLagrange, Rk4::every(1e-3));
        let nothing = |_: &Sample<'_, f64, WithLength>| ControlFlow::Continue(());
        if joints {
            simulation
                .joint_coordinates()
                .run(0.0..=1.0, every(1.0), nothing)
        } else {
            simulation
                .absolute_coordinates()
                .run(0.0..=1.0, every(1.0), nothing)
        }
    };
    for joints in [false, true] {
        let error = run(joints).expect_err("it has no direction");
        assert_eq!(
            error.fault,
            Fault::Step(StepFault::RatesNotFinite { origin })
        );
    }
}

/// A shaft whose damper takes 1000 of its rate a second.
#[derive(Mechanism)]
#[mechanism(coordinates = "joints")]
struct Shaft {
    #[body(mass = 1.0, inertia = [0.01, 0.01, 0.01], angular_velocity = [1.0, 0.0, 0.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    bearing: Revolute,
    #[force(between = [ground, shaft], axis = [1.0, 0.0, 0.0], moment = -10.0 * rate)]
    damper: TorsionalActuator,
}

#[test]
fn a_step_that_is_too_long_is_named() {
    let shaft = Shaft::default();
    let simulation = || Simulation::new(&shaft, StandardLagrange, Rk4::every(0.01));
    let nothing = |_: &Sample<'_, f64, Shaft>| ControlFlow::Continue(());
    let bodies = simulation().absolute_coordinates();
    let bodies = bodies.run(0.0..=10.0, every(10.0), nothing);
    let joints = simulation().joint_coordinates();
    let joints = joints.run(0.0..=10.0, every(10.0), nothing);
    for run in [bodies, joints] {
        let error = run.expect_err("it grows");
        assert_eq!(error.fault, Fault::Step(StepFault::Unstable { step: 0.01 }));
        assert!(error.to_string().contains("a step of 0.01 s is too long"));
    }
}
