//! What steps are held to: budgets, largest steps, breaks; and an observer's word between reports.

use holonom::error::{StartFault, StepFault};
use holonom::forces::Actuator;
use holonom::joints::{Distance, PointOnLine, Revolute};
use holonom::prelude::*;

use crate::start::Rod;

/// A particle on a line, pushed by 100 N for 20 ms after five seconds: 2 m/s less the ramps.
#[derive(Mechanism)]
struct Pushed {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    cart: Particle,
    #[joint(between = [ground, cart], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: PointOnLine,
    #[force(
        between = [ground, cart],
        head = [0.0, 0.0, 0.0],
        tail = [1.0, 0.0, 0.0],
        force = 100.0 * (smooth_step((time - 5.0) / 0.01) - smooth_step((time - 5.02) / 0.01))
    )]
    push: Actuator,
}

/// The same with a law whose instants are known at run time only.
#[derive(Mechanism)]
struct PushedLater {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    cart: Particle,
    #[joint(between = [ground, cart], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: PointOnLine,
    #[force(
        between = [ground, cart],
        head = [0.0, 0.0, 0.0],
        tail = [1.0, 0.0, 0.0],
        force = 100.0 * (smooth_step((time - start) / 0.01) - smooth_step((time - start - 0.02) / 0.01))
    )]
    push: Actuator,
    #[param]
    start: f64,
}

/// 100 N for 20 ms on 1 kg: the ramps up and down are symmetric.
const REACHED: f64 = 2.0;

#[test]
fn a_pulse_of_a_law_is_not_stepped_over() {
    let breaks = Pushed::REPORT.time.breaks;
    let expected = [5.0, 5.01, 5.02, 5.03];
    assert!(
        breaks
            .iter()
            .zip(expected)
            .all(|(a, b)| (a - b).abs() < 1e-12),
        "{breaks:?}"
    );
    let report = Simulation::new(
        &Pushed::default(),
        StandardLagrange,
        DormandPrince::default(),
    )
    .run(0.0..=10.0, every(10.0), |_| ControlFlow::Continue(()))
    .expect("nothing stops it");
    let speed = Pushed::velocity(&report.state, Pushed::HANDLES.cart).x;
    assert!((speed - REACHED).abs() < 1e-6, "{speed}");
    assert!(report.warnings().is_empty(), "{}", report.warnings());
}

#[test]
fn breaks_and_largest_steps_of_a_run() {
    let pushed = PushedLater::new(5.0).expect("acceptable");
    let cart = PushedLater::HANDLES.cart;
    let ode45 = DormandPrince::default();
    let run = |integrator, breaks: &[f64]| {
        let report = Simulation::new(&pushed, StandardLagrange, integrator)
            .breaks(breaks)
            .run(0.0..=10.0, every(10.0), |_| ControlFlow::Continue(()))
            .expect("nothing stops it");
        PushedLater::velocity(&report.state, cart).x
    };
    // In any order, some of them outside the run.
    let speed = run(ode45, &[5.03, 20.0, 5.0, -1.0, 5.0]);
    assert!((speed - REACHED).abs() < 1e-6, "{speed}");
    let speed = run(ode45.largest_step(0.01), &[]);
    assert!((speed - REACHED).abs() < 1e-6, "{speed}");
    // What a run passes over without either.
    assert_eq!(run(ode45, &[]), 0.0);
}

#[test]
fn a_stiff_stabilisation_ends_with_the_budget() {
    let rod = Rod::default();
    let stiff = DormandPrince::default().budget(100_000);
    let error = Simulation::new(&rod, Baumgarte::new(1e12, 1e12), stiff)
        .run(0.0..=1.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("it would take for ever");
    println!("{error}");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::Budget { .. } | StepFault::SizeUnderflow { .. })
        ),
        "{error}"
    );
    let error = Simulation::new(
        &rod,
        Baumgarte::default(),
        DormandPrince::default().budget(100),
    )
    .run(0.0..=10.0, every(0.1), |_| ControlFlow::Continue(()))
    .expect_err("a hundred are not enough");
    assert!(
        matches!(
            error.fault,
            Fault::Step(StepFault::Budget {
                evaluations: 100..=120,
                joint: None,
            })
        ),
        "{error}"
    );
    assert!(error.time > 0.0 && error.time < 10.0);
}

#[test]
fn an_observer_has_a_word_between_reports() {
    let rod = Rod::default();
    let mut shown = 0;
    let report = Simulation::new(&rod, Baumgarte::new(1e9, 1e9), DormandPrince::default())
        .run(0.0..=1.0, every(1.0).or_steps(1000), |_| {
            shown += 1;
            if shown == 5 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
        .expect("stopped in time");
    assert!(report.stopped && report.accepted == 4000, "{report:?}");
}

#[test]
fn reports_closer_than_the_time_can_tell_are_refused() {
    let rod = Rod::default();
    let error = Simulation::new(&rod, StandardLagrange, DormandPrince::default())
        .run(0.0..=1.0, every(1e-17), |_| ControlFlow::Continue(()))
        .expect_err("two million samples of one instant");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::TooShort { .. })),
        "{error}"
    );
}

/// A door on two hinges, of which five equations follow from others.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "keep")]
struct Door {
    #[body(mass = 20.0, inertia = [3.0, 1.0, 4.0], position = [0.4, 0.0, 1.0], angular_velocity = [0.0, 0.0, 1.0], velocity = [0.0, 0.4, 0.0])]
    leaf: Body,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, 0.2], axis = [0.0, 0.0, 1.0])]
    lower: Revolute,
    #[joint(between = [ground, leaf], point = [0.0, 0.0, 1.8], axis = [0.0, 0.0, 1.0])]
    upper: Revolute,
}

#[test]
fn a_penalty_factor_that_is_lost_in_round_off_is_refused() {
    let door = Door::default();
    let run = |alpha| {
        let mut angle = f64::NAN;
        Simulation::new(
            &door,
            AugmentedLagrangian::new(alpha, 10.0, 1.0),
            Rk4::every(1e-3),
        )
        .run(0.0..=1.0, every(1.0), |sample| {
            angle = sample.angle(Door::HANDLES.lower);
            ControlFlow::Continue(())
        })
        .map(|_| angle)
        .map_err(|error| error.fault)
    };
    for alpha in [1e7, 1e10, 1e13] {
        let angle = run(alpha).expect("it holds");
        assert!((angle - 1.0).abs() < 1e-9, "{alpha:e}: {angle}");
    }
    for alpha in [1e17, 1e30] {
        let fault = run(alpha).expect_err("lost in round-off");
        println!("{fault}");
        assert!(
            matches!(fault, Fault::Start(StartFault::PenaltyFactor { .. })),
            "{fault}"
        );
    }
}

#[test]
fn a_step_beyond_the_limit_of_stability_is_named() {
    let rod = Rod::default();
    let error = Simulation::new(&rod, Baumgarte::new(1000.0, 1000.0), Rk4::every(0.01))
        .run(0.0..=10.0, every(0.1), |_| ControlFlow::Continue(()))
        .expect_err("it explodes");
    println!("{error}");
    assert!(
        matches!(error.fault, Fault::Step(StepFault::TooLong { .. })),
        "{error}"
    );
}

/// Four links of 1 m, the ground among them, all but in a line.
#[derive(Mechanism)]
struct Flat {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 * cos(0.004), 0.5 * sin(0.004), 0.0])]
    crank: Body,
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], position = [0.5 + cos(0.004), sin(0.004), 0.0])]
    coupler: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, coupler], point = [cos(0.004), sin(0.004), 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [ground, coupler], head = [1.0, 0.0, 0.0], tail = [1.0 + cos(0.004), sin(0.004), 0.0])]
    rod: Distance,
}

#[test]
fn a_budget_that_ends_in_a_singular_configuration_names_the_joint() {
    let flat = Flat::default();
    let ode45 = DormandPrince::default().budget(10);
    let simulation = Simulation::new(&flat, StandardLagrange, ode45);
    let run = simulation.run(0.0..=1e3, every(0.1), |_| ControlFlow::Continue(()));
    let error = run.expect_err("ten are not enough");
    println!("{error}");
    let is_named = matches!(
        error.fault,
        Fault::Step(StepFault::Budget {
            joint: Some("rod"),
            ..
        })
    );
    assert!(is_named, "{error}");
}
