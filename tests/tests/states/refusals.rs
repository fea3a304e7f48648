//! What knows the motion of bodies alone, and rates that are no numbers.

use holonom::GeneralizedAlpha;
use holonom::error::{LeavesOut, NotFinite, StartFault, StepFault};
use holonom::prelude::*;

use crate::Fan;

fn left_out(fault: Fault) -> LeavesOut {
    match fault {
        Fault::Start(StartFault::StateLeftOut {
            state: "current",
            by,
        }) => by,
        other => panic!("another fault: {other}"),
    }
}

#[test]
fn generalized_alpha_names_the_state() {
    let fan = Fan::of(0.5);
    let error = fan
        .simulation(StandardLagrange, GeneralizedAlpha::every(1e-3))
        .absolute_coordinates()
        .run(0.0..=0.1, every(0.1), |_| ())
        .expect_err("it moves bodies alone");
    assert_eq!(left_out(error.fault), LeavesOut::StepMethod);
}

/// A shaft that is driven, and the heat in its bearing.
#[derive(Mechanism)]
struct Driven {
    #[state(rate = axle.rate * axle.rate)]
    current: f64,
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    shaft: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    axle: Revolute,
    #[joint(between = [ground, shaft], axis = [0.0, 0.0, 1.0], motion = 3.0 * time)]
    drive: AngleDriver,
}

#[test]
fn a_kinematic_analysis_names_the_state() {
    let driven = Driven::default();
    let error = KinematicAnalysis::new(&driven, StandardLagrange)
        .run(0.0_f64..=1.0, every(0.1), |_| ())
        .expect_err("it integrates nothing");
    assert_eq!(left_out(error.fault), LeavesOut::Kinematics);
    let mut state = driven.described_state().expect("sound");
    Driven::set_angular_velocity(
        &mut state,
        Driven::HANDLES.shaft,
        holonom::nalgebra::Vector3::new(0.0, 0.0, 3.0),
    );
    driven
        .simulation(StandardLagrange, Rk4::every(1e-2))
        .initial_state(state)
        .run(0.0..=1.0, every(1.0), |sample| {
            let heat = sample.state_value(Driven::HANDLES.current);
            assert!((heat - 9.0 * sample.time()).abs() < 1e-9);
        })
        .expect("a run integrates it");
}

/// A motor on a pendulum.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints", kernels = [mass, inverse])]
struct Pendulum {
    #[input]
    voltage: f64,
    #[state(rate = voltage - current - hinge.rate, start = 2.0)]
    current: f64,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.0, -0.5])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[force(between = [ground, rod], axis = [1.0, 0.0, 0.0], moment = current)]
    motor: TorsionalActuator,
}

#[test]
fn chosen_coordinates_hold_the_state_and_linearise_nothing() {
    let (pendulum, h) = (Pendulum::default(), Pendulum::HANDLES);
    let space = pendulum.coordinates([h.hinge]).expect("one coordinate");
    let state = space.state([0.3], [1.0]).expect("it is free");
    // Its moment acts with the value at the start, which no way to the state has changed.
    let [effort]: [f64; 1] = space.inverse(&state, [0.0]).expect("sound").into();
    assert!((effort - (9.81 * 0.5 * f64::sin(0.3) - 2.0)).abs() < 1e-12);
    let bodies = space.bodies(&space.of_bodies(&space.bodies(&state)));
    assert_eq!(Pendulum::state_value(&bodies, h.current), 2.0);
    let faults = [
        space
            .linearise(&state, [h.voltage], |_| [])
            .map(|_| ())
            .expect_err("it has a rate"),
        space
            .equilibrium(&state)
            .map(|_| ())
            .expect_err("it has a rate"),
        space
            .trim(&state, [h.hinge], [h.voltage])
            .map(|_| ())
            .expect_err("it has a rate"),
    ];
    for fault in faults {
        assert_eq!(left_out(fault), LeavesOut::Linearisation);
    }
}

/// A rate that is none at the start.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Empty {
    #[state(rate = 1.0)]
    sound: f64,
    #[state(rate = sqrt(level - 1.0))]
    level: f64,
    #[body(free, mass = 1.0)]
    stone: Particle,
}

#[test]
fn a_rate_that_is_no_number_names_its_state() {
    let empty = Empty::default();
    let run = |by_joints| {
        let run = empty.simulation(StandardLagrange, DormandPrince::default());
        let ended = if by_joints {
            run.joint_coordinates().run(0.0..=1.0, every(1.0), |_| ())
        } else {
            run.absolute_coordinates()
                .run(0.0..=1.0, every(1.0), |_| ())
        };
        ended.expect_err("no root").fault
    };
    for by_joints in [false, true] {
        let fault = run(by_joints);
        let expected = Fault::Step(StepFault::RatesNotFinite {
            origin: NotFinite::Rate("level"),
        });
        assert_eq!(fault, expected);
        let text = fault.to_string();
        assert_eq!(
            text,
            "the rates of the state are not finite: the rate of state `level` is not finite"
        );
    }
}
