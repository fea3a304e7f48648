//! What somebody found who had the documents alone.

use std::f64::consts::TAU;

use holonom::forces::{Actuator, ConstantMoment, PointForce};
use holonom::joints::{AngleDriver, PointOnLine, Prismatic, Revolute};
use holonom::prelude::*;
use holonom::{ImplicitMidpoint, Real, Runs, SemiImplicitEuler, Warning};
use holonom_models::RodPendulum;

use crate::between::Wheel;

holonom::force! {
    /// A spring whose other end is shaken.
    force Shaken(i, j; head: Point, tail: Point, axis: Axis, stiffness: Number, frequency: Number) {
        let off = dot(i.axis, j.tail - i.head) - 0.5 * sin(frequency * time);
        potential 0.5 * stiffness * off * off;
    }
}

/// An arm that a motor turns by a quarter and holds there.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Arm {
    #[body(mass = 1.0, inertia = [0.1, 0.01, 0.1], position = [0.0, 0.5, 0.0])]
    arm: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
    #[joint(between = [ground, arm], axis = [1.0, 0.0, 0.0], motion = 0.25 * TAU * smooth_step(time / 2.0))]
    motor: AngleDriver,
}

/// A cart under a force that changes faster than the steps of a default run are meant for.
#[derive(Mechanism)]
struct Cart {
    #[body(mass = 1.0, position = [1.0, 0.0, 0.0])]
    cart: Particle,
    #[joint(between = [ground, cart], point = [1.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: PointOnLine,
    #[force(between = [ground, cart], head = [-10.0, 0.0, 0.0], tail = [1.0, 0.0, 0.0], force = 5.0 * sin(frequency * time))]
    push: Actuator,
    #[param]
    frequency: f64,
}

/// A cart on a spring that is shaken at 30 rad/s, at fixed steps.
#[derive(Mechanism)]
struct Shaker {
    #[body(mass = 1.0)]
    cart: Particle,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: PointOnLine,
    #[force(
        between = [ground, cart],
        head = [0.0, 0.0, 0.0],
        tail = [0.0, 0.0, 0.0],
        axis = [1.0, 0.0, 0.0],
        stiffness = 4.0,
        frequency = 30.0
    )]
    spring: Shaken,
}

/// A rod of a millimetre a thousand kilometres away.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Far {
    #[body(mass = 1.0, inertia = [1e-7, 1e-9, 1e-7], position = [0.0, 1000000.0005, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 1e6, 0.0], axis = [1.0, 0.0, 0.0])]
    hinge: Revolute,
}

fn warnings<S: Real, M: Mechanism, I: Runs<Problem<M, StandardLagrange, S>>>(
    mechanism: &M,
    integrator: I,
    duration: S,
) -> Vec<Warning> {
    let report = Simulation::new(mechanism, StandardLagrange, integrator)
        .run(S::zero()..=duration, every(duration), |_| {
            ControlFlow::Continue(())
        })
        .expect("nothing stops it");
    let warnings: Vec<Warning> = report.warnings().into_iter().collect();
    warnings.iter().for_each(|warning| println!("{warning}"));
    warnings
}

/// Its velocities fall below the range of numbers, step by step.
#[test]
fn a_motor_that_comes_to_rest_is_corrected_for_ever() {
    for projected in [
        DormandPrince::default(),
        DormandPrince::default().largest_step(0.01),
    ] {
        let arm = Arm::default();
        let report = Simulation::new(&arm, StandardLagrange, projected)
            .projection(Projection::default())
            .run(0.0..=60.0, every(1.0), |_| ControlFlow::Continue(()))
            .expect("it rests");
        assert!(report.warnings().is_empty(), "{}", report.warnings());
    }
}

/// `x'' = 5 sin(w t)`: right to 1e-4 at the defaults, which is no reason for a warning.
#[test]
fn a_fast_force_is_no_reason_for_a_warning() {
    for frequency in [1.0, 2.0, 20.0, 63.0] {
        let cart = Cart::new(frequency).expect("acceptable");
        let found = warnings(&cart, DormandPrince::default(), 20.0);
        assert!(found.is_empty(), "{frequency} rad/s: {found:?}");
    }
}

#[test]
fn steps_that_do_not_follow_a_force_are_warned_of() {
    let found = warnings(&Shaker::default(), Rk4::every(0.2), 20.0);
    assert!(
        found
            .iter()
            .any(|warning| matches!(warning, Warning::Energy { .. }))
    );
    let cart = Cart::new(30.0).expect("acceptable");
    let found = warnings(&cart, Rk4::every(0.1), 20.0);
    assert!(
        found
            .iter()
            .any(|warning| matches!(warning, Warning::CoarseSteps { .. }))
    );
    assert!(warnings(&Shaker::default(), Rk4::every(0.005), 20.0).is_empty());
    assert!(warnings(&Shaker::default(), DormandPrince::default(), 20.0).is_empty());
}

/// The energy of a wheel says nothing of its phase.
#[test]
fn phases_of_a_wheel_are_warned_of_at_long_steps() {
    for step in [0.05, 0.08] {
        let found = warnings(&Wheel::default(), Rk4::every(step), 100.0);
        assert!(
            found
                .iter()
                .any(|warning| matches!(warning, Warning::Orientation { .. })),
            "{step}"
        );
    }
    assert!(warnings(&Wheel::default(), Rk4::every(0.01), 100.0).is_empty());
    assert!(warnings(&Wheel::default(), DormandPrince::default(), 100.0).is_empty());
    assert!(warnings(&Wheel::default(), Rk4::every(0.01_f32), 100.0).is_empty());
}

/// The implicit midpoint rule keeps the energy of a pendulum at any step, and its phase is off by
/// the square of it.
#[test]
fn phases_of_a_method_that_keeps_the_energy_are_warned_of_at_long_steps() {
    let rod = RodPendulum::default();
    let run = |step| {
        let mut angles = Vec::new();
        let report = Simulation::new(&rod, StandardLagrange, ImplicitMidpoint::every(step))
            .joint_coordinates()
            .run(0.0..=2.0, every(0.1), |sample| {
                angles.push(sample.angle(RodPendulum::HANDLES.pivot));
                ControlFlow::Continue(())
            })
            .expect("solvable");
        let tells = report
            .warnings()
            .into_iter()
            .any(|warning| matches!(warning, Warning::LongSteps { .. }));
        (angles, tells)
    };
    let (exact, _) = run(1e-4);
    for step in [0.1, 0.05, 0.025, 0.02, 0.01, 0.005] {
        let (angles, tells) = run(step);
        let errors = angles.iter().zip(&exact).map(|(a, b)| f64::abs(a - b));
        let error = errors.fold(0.0, f64::max);
        println!("{step}: {error:e}, {tells}");
        assert!(tells || error < 1e-2, "{step}: {error:e}");
        // An estimate within ten times.
        assert!(!tells || error > 1e-3, "{step}: {error:e}");
    }
    assert!(run(0.1).1 && !run(0.005).1);
}

#[test]
fn a_mechanism_below_the_digits_of_its_place_is_warned_of() {
    let found = warnings(&Far::default(), Rk4::every(1e-4_f32), 0.01);
    assert!(
        found
            .iter()
            .any(|warning| matches!(warning, Warning::CoarseNumbers { .. }))
    );
}

/// A wheel that a moment of 0.3 N m brings up to speed.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Driven {
    #[body(mass = 1.0, inertia = [0.2, 0.2, 0.3])]
    wheel: Body,
    #[joint(between = [ground, wheel], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, wheel], moment = [0.0, 0.0, moment])]
    drive: ConstantMoment,
    #[param]
    moment: f64,
}

/// Coordinates go by velocities of the ends of steps: the balance of energy is right to round-off.
#[test]
fn velocities_that_are_ahead_of_coordinates_are_warned_of() {
    let driven = Driven::new(0.3).expect("acceptable");
    for step in [0.1, 0.03, 0.01, 0.003, 0.001] {
        let mut angle = f64::NAN;
        let report = Simulation::new(&driven, StandardLagrange, SemiImplicitEuler::every(step))
            .joint_coordinates()
            .run(0.0..=6.0, every_step(), |sample| {
                angle = sample.angle(Driven::HANDLES.shaft);
                ControlFlow::Continue(())
            })
            .expect("nothing stops it");
        let off: f64 = (angle - 18.0) / TAU;
        let error = TAU * (off - off.round()).abs();
        let shift = report
            .warnings()
            .into_iter()
            .find_map(|warning| match warning {
                Warning::LongSteps { shift } => Some(shift),
                _ => None,
            });
        println!("{step}: {error:e}, {shift:?}");
        assert!(shift.is_some() || error < 1e-2, "{step}: {error:e}");
        assert!(
            shift.is_none_or(|shift| (shift / error - 1.0).abs() < 0.1),
            "{step}: {error:e}, {shift:?}"
        );
    }
}

/// Nothing is said of a penalty where there is none, nor of a number that is none.
#[test]
fn energies_beyond_all_numbers_are_named() {
    let driven = Driven::new(1e200).expect("acceptable");
    let report = Simulation::new(&driven, StandardLagrange, Rk4::every(1e-3))
        .joint_coordinates()
        .run(0.0..=0.01, every(0.01), |_| ControlFlow::Continue(()))
        .expect("velocities are numbers");
    let said = report.warnings().to_string();
    assert_eq!(said, "the energy is beyond all numbers at 0 s");
}

/// A cart that is pushed, with a rotor on it that turns evenly and faster than anything changes.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
struct Pushed {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1])]
    cart: Body,
    #[body(mass = 0.001, inertia = [1e-6, 1e-6, 1e-6], angular_velocity = [0.0, 0.0, 100.0], position = [0.5, 0.0, 0.0])]
    rotor: Body,
    #[joint(between = [ground, cart], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    track: Prismatic,
    #[joint(between = [cart, rotor], point = [0.5, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    shaft: Revolute,
    #[force(between = [ground, cart], point = [0.0, 0.0, 0.0], force = [5.0, 0.0, 0.0])]
    push: PointForce,
}

/// What is ahead is asked body by body.
#[test]
fn a_fast_rotor_hides_no_lead_of_velocities() {
    let found = {
        let pushed = Pushed::default();
        let simulation = Simulation::new(&pushed, StandardLagrange, SemiImplicitEuler::every(0.02));
        let simulation = simulation.joint_coordinates();
        let report = simulation.run(0.0..=2.0, every(2.0), |_| ControlFlow::Continue(()));
        report.expect("nothing stops it").warnings()
    };
    let is_told = |warning| matches!(warning, Warning::LongSteps { .. });
    assert!(found.into_iter().any(is_told), "{found}");
}
