//! Arrays of bodies, joints, forces and values in a run: handles, names, both descriptions.

use holonom::forces::{Actuator, ConstantMoment};
use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;
use holonom::{Rk4, Stepper, error::ParameterFault};

/// Lengths of links (m), as a table that the macro cannot see.
const LENGTHS: [f64; 3] = [0.5, 0.75, 1.25];

/// A robot of three links on driven hinges.
#[derive(Debug, Mechanism)]
struct Driven {
    #[body(mass = 1.0 + k, inertia = [0.1, 0.1, 0.1], position = [0.0, 0.5 + k, 0.0])]
    links: [Body; 3],
    #[joint(between = [if k == 0 { ground } else { links[k - 1] }, links[k]], point = [0.0, k, 0.0], axis = [1.0, 0.0, 0.0])]
    pins: [Revolute; 3],
    #[joint(between = [if k == 0 { ground } else { links[k - 1] }, links[k]], axis = [1.0, 0.0, 0.0], motion = 0.1 * (k + 1) * time)]
    motors: [AngleDriver; 3],
    #[force(between = [ground, links[2 - k]], moment = [10.0 * k, 0.0, 0.0])]
    loads: [ConstantMoment; 3],
}

const _: () = assert!(Driven::REPORT.degrees_of_freedom == 0 && Driven::HANDLES.links.len() == 3);

#[test]
fn handles_read_their_own_element() {
    let handles = Driven::HANDLES;
    assert_eq!(
        handles.links.map(|link| link.name()),
        ["links[0]", "links[1]", "links[2]"]
    );
    assert_eq!(handles.motors[2].name(), "motors[2]");
    assert_eq!(handles.loads[1].name(), "loads[1]");
    KinematicAnalysis::new(&Driven::default(), StandardLagrange)
        .run(0.0_f64..=1.0, every(0.5), |sample| {
            let (mut total, mut end) = (0.0, [0.0, 0.0]);
            for k in 0..3 {
                let angle = 0.1 * (k + 1) as f64 * sample.time();
                assert!((sample.angle(handles.pins[k]) - angle).abs() < 1e-12);
                total += angle;
                let centre = [end[0] + 0.5 * total.cos(), end[1] + 0.5 * total.sin()];
                let position = sample.pose(handles.links[k]).position;
                assert!((position.y - centre[0]).abs() + (position.z - centre[1]).abs() < 1e-12);
                end = [end[0] + total.cos(), end[1] + total.sin()];
                let rate = sample.angular_velocity(handles.links[k]).x;
                assert!((rate - [0.1, 0.3, 0.6][k]).abs() < 1e-12);
            }
            // The moment about x that motor k holds is that of the loads on the links behind it,
            // and of the centripetal forces.
            let load = |k: usize| 10.0 * (2 - k) as f64;
            let found = sample.driving_effort(handles.motors[2]).expect("regular");
            if sample.time() == 0.0 {
                assert!((found + load(2)).abs() < 1e-9, "{found}");
                let found = sample.driving_effort(handles.motors[0]).expect("regular");
                assert!(
                    (found + load(0) + load(1) + load(2)).abs() < 1e-9,
                    "{found}"
                );
            }
            ControlFlow::Continue(())
        })
        .expect("an analysis");
}

/// Links whose lengths, masses and thrusts are known at run time or in a table, in both
/// descriptions.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct Given {
    #[param]
    masses: [f64; 3],
    #[input]
    thrusts: [f64; 2],
    #[body(
        mass = masses[k],
        inertia = [masses[k] * LENGTHS[k] * LENGTHS[k] / 12.0, 0.01 * masses[0], masses[k] * LENGTHS[k] * LENGTHS[k] / 12.0],
        position = [0.0, k + 0.5 * LENGTHS[k], 0.0]
    )]
    links: [Body; 3],
    #[joint(
        between = [if k == 0 { ground } else { links[k - 1] }, links[k]],
        point = [0.0, k, 0.0],
        axis = if k % 2 == 0 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] }
    )]
    pins: [Revolute; 3],
    #[force(between = [ground, links[k + 1]], head = [2.0, 1.0 + k, 5.0], tail = [0.0, 1.0 + k, 0.0], force = -thrusts[k] - 0.1 * rate)]
    ropes: [Actuator; 2],
}

/// The same, one field after the other.
#[derive(Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81])]
struct Written {
    #[body(mass = 1.0, inertia = [1.0 * 0.25 / 12.0, 0.01, 1.0 * 0.25 / 12.0], position = [0.0, 0.25, 0.0])]
    first: Body,
    #[body(mass = 2.0, inertia = [2.0 * 0.5625 / 12.0, 0.01, 2.0 * 0.5625 / 12.0], position = [0.0, 1.375, 0.0])]
    second: Body,
    #[body(mass = 1.5, inertia = [1.5 * 1.5625 / 12.0, 0.01, 1.5 * 1.5625 / 12.0], position = [0.0, 2.625, 0.0])]
    third: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    base: Revolute,
    #[joint(between = [first, second], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    middle: Revolute,
    #[joint(between = [second, third], point = [0.0, 2.0, 0.0], axis = [1.0, 0.0, 0.0])]
    wrist: Revolute,
    #[force(between = [ground, second], head = [2.0, 1.0, 5.0], tail = [0.0, 1.0, 0.0], force = -12.0 - 0.1 * rate)]
    left: Actuator,
    #[force(between = [ground, third], head = [2.0, 2.0, 5.0], tail = [0.0, 2.0, 0.0], force = -7.0 - 0.1 * rate)]
    right: Actuator,
}

#[test]
fn arrays_move_as_single_fields_do_in_both_descriptions() {
    let mut given = Given::new([1.0, 2.0, 1.5]).expect("acceptable");
    assert_eq!(given.thrusts, [0.0; 2]);
    given.thrusts = [12.0, 7.0];
    let written = Written::default();
    let (handles, single) = (Given::HANDLES, Written::HANDLES);
    let ode45 = DormandPrince::new(Tolerance {
        relative: 1e-11,
        absolute: 1e-12,
    });
    let wanted = {
        let mut angles: Vec<[f64; 3]> = Vec::new();
        Simulation::new(&written, StandardLagrange, ode45)
            .run(0.0..=1.0, every(0.25), |sample| {
                angles
                    .push([single.base, single.middle, single.wrist].map(|pin| sample.angle(pin)));
                ControlFlow::Continue(())
            })
            .expect("a run");
        angles
    };
    assert!(
        wanted[4].iter().all(|angle| angle.abs() > 0.05),
        "{wanted:?}"
    );
    let judge = |found: Vec<[f64; 3]>| {
        assert_eq!(found.len(), wanted.len());
        for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
            assert!((found - wanted).abs() < 1e-8, "{found} and {wanted}");
        }
    };
    let mut angles = Vec::new();
    Simulation::new(&given, StandardLagrange, ode45)
        .absolute_coordinates()
        .run(0.0..=1.0, every(0.25), |sample| {
            angles.push(handles.pins.map(|pin| sample.angle(pin)));
            ControlFlow::Continue(())
        })
        .expect("a run");
    judge(angles);
    let mut angles = Vec::new();
    Simulation::new(&given, StandardLagrange, ode45)
        .joint_coordinates()
        .run(0.0..=1.0, every(0.25), |sample| {
            angles.push(handles.pins.map(|pin| sample.angle(pin)));
            ControlFlow::Continue(())
        })
        .expect("a run");
    judge(angles);
}

#[test]
fn parameters_and_inputs_are_refused_by_element() {
    let error = Given::new([1.0, -2.0, 1.5]).expect_err("a negative mass");
    assert_eq!(
        (error.field, error.attribute, error.fault),
        ("links[1]", "mass", ParameterFault::NotPositive)
    );
    let mut given = Given::new([1.0, 2.0, 1.5]).expect("acceptable");
    let mut stepper = Stepper::new(&given, Baumgarte::<f64>::default(), Rk4).expect("acceptable");
    given.thrusts[1] = f64::NAN;
    let error = stepper
        .update(&given)
        .expect_err("not a number")
        .to_string();
    assert!(error.contains("thrusts[1]"), "{error}");
}

/// More elements than the standard library has a default for.
#[derive(Debug, Mechanism)]
struct Many {
    #[body(mass = 1.0 + k, free)]
    beads: [Particle; 40],
}

#[test]
fn long_arrays_have_a_default() {
    let state = Many::default()
        .described_state::<f64>()
        .expect("acceptable");
    let constants = Many::default().constants::<f64>().expect("acceptable");
    let view = holonom::View::new(&constants, 0.0, &state);
    assert_eq!(Many::HANDLES.beads[39].name(), "beads[39]");
    assert_eq!(view.pose(Many::HANDLES.beads[39]).position.norm(), 0.0);
    assert_eq!(Many::mass(&constants)[3 * 39], 40.0);
}

/// An array that another macro writes, with a length and a type that it was given.
macro_rules! row {
    ($name:ident, $body:ty, $length:literal, $spacing:expr) => {
        #[derive(Debug, Mechanism)]
        struct $name {
            #[body(mass = 1.0, position = [$spacing * k, 0.0, 0.0], free)]
            row: [$body; $length],
        }
    };
}

row!(Beads, Particle, 3, 0.5 + 0.25);

#[test]
fn arrays_come_out_of_macros() {
    let beads = Beads::default()
        .described_state::<f64>()
        .expect("acceptable");
    assert_eq!(Beads::pose(&beads, Beads::HANDLES.row[2]).position.x, 1.5);
}
