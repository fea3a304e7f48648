//! Angles and displacements of joints that are set in a state: what hangs on a joint goes along,
//! and nothing else moves.

use core::f64::consts::TAU;

use holonom::error::{AssemblyFault, StepFault};
use holonom::joints::{Cylindrical, Prismatic, Revolute, Spherical};
use holonom::prelude::*;
use holonom::{BodyHandle, View, state::Array};
use nalgebra::{UnitQuaternion, Vector3};

use crate::descriptions::{Crane, FourBar, Loose};

/// What a step of a setting does to a state.
type Setting<'a, M> = &'a dyn Fn(&mut <M as Mechanism>::State<f64>);

/// All orders of four.
fn orders() -> Vec<[usize; 4]> {
    let mut orders = Vec::new();
    for a in 0..4 {
        for b in (0..4).filter(|&b| b != a) {
            for c in (0..4).filter(|&c| c != a && c != b) {
                orders.push([a, b, c, 6 - a - b - c]);
            }
        }
    }
    orders
}

fn numbers<M: Mechanism>(state: &M::State<f64>) -> Vec<f64> {
    [
        &state.coordinates().as_slice(),
        &state.velocities().as_slice(),
    ]
    .into_iter()
    .flat_map(|part| part.to_vec())
    .collect()
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |worst, (a, b)| worst.max((a - b).abs()))
}

/// How a body stands and moves as seen from another one: rotation, arm, angular velocity, velocity,
/// in the other's axes.
fn relative<M: Mechanism>(state: &M::State<f64>, [from, to]: [BodyHandle<M>; 2]) -> Vec<f64> {
    let [i, j] = [from, to].map(|body| {
        let pose = M::pose(state, body);
        let spin = M::angular_velocity_global(state, body);
        (pose, M::velocity(state, body), spin)
    });
    let turn = UnitQuaternion::from_quaternion(i.0.orientation).inverse();
    let rotation = turn * UnitQuaternion::from_quaternion(j.0.orientation);
    let arm = j.0.position - i.0.position;
    let velocity = turn * (j.1 - i.1 - i.2.cross(&arm));
    let (arm, spin) = (turn * arm, turn * (j.2 - i.2));
    let axes = rotation.to_rotation_matrix();
    let mut values: Vec<f64> = axes.matrix().iter().copied().collect();
    values.extend(arm.iter().chain(&spin).chain(&velocity));
    values
}

/// Positions and velocities satisfy the equations to round-off.
fn closed<M: Mechanism>(view: &View<'_, f64, M>) {
    let violations = [view.violation(), view.velocity_violation()];
    assert!(violations.iter().all(|&v| v < 1e-24), "{violations:?}");
}

#[test]
fn a_crane_is_set_in_any_order() {
    let crane = Crane::driven().expect("acceptable");
    let constants = crane.constants::<f64>().expect("acceptable");
    let handles = Crane::HANDLES;
    let start = crane.start::<f64>();
    // Three turns and a half: the coil counts them.
    let (angle, rate, displacement, speed) = (3.5 * TAU - 0.4, -2.0, 0.7, -0.3);
    let settings: [Setting<'_, Crane>; 4] = [
        &|state| crane.set_angle(state, handles.elbow, angle).expect("free"),
        &|state| {
            crane
                .set_angle_rate(state, handles.elbow, rate)
                .expect("free")
        },
        &|state| {
            let rail = handles.rail;
            crane
                .set_displacement(state, rail, displacement)
                .expect("free");
        },
        &|state| {
            let rail = handles.rail;
            crane
                .set_displacement_rate(state, rail, speed)
                .expect("free");
        },
    ];
    let mut first: Option<Vec<f64>> = None;
    for order in orders() {
        let mut state = start;
        for place in order {
            settings[place](&mut state);
            closed(&View::<f64, Crane>::new(&constants, 0.0, &state));
        }
        let view = View::<f64, Crane>::new(&constants, 0.0, &state);
        let turned = (view.angle(handles.elbow) - angle) / TAU;
        assert!((turned - turned.round()).abs() < 1e-14);
        assert!((view.angle_rate(handles.elbow) - rate).abs() < 1e-13);
        assert!((view.displacement(handles.rail) - displacement).abs() < 1e-14);
        assert!((view.displacement_rate(handles.rail) - speed).abs() < 1e-13);
        let counted = Crane::unwrapped_angles(&state, handles.coil);
        assert!((counted[0] - angle).abs() < 1e-13, "{counted:?}");
        let lean = Crane::unwrapped_angles(&state, handles.lean);
        assert!(lean[0].abs() < 1e-14);
        // The motor sees the boom from the cart.
        let motor = Crane::unwrapped_angles(&state, handles.motor);
        assert!((motor[0] + angle).abs() < 1e-13, "{motor:?}");
        // What hangs on the boom stands and moves against it as before.
        for pair in [
            [handles.boom, handles.weight],
            [handles.boom, handles.rod],
            [handles.rod, handles.load],
        ] {
            let [before, after] = [&start, &state].map(|state| relative::<Crane>(state, pair));
            assert!(difference(&before, &after) < 1e-13);
        }
        let numbers = numbers::<Crane>(&state);
        let first = first.get_or_insert_with(|| numbers.clone());
        assert!(difference(first, &numbers) < 1e-12);
        // Once more is nothing more.
        let mut again = state;
        settings.iter().for_each(|set| set(&mut again));
        assert!(difference(first, &self::numbers::<Crane>(&again)) < 1e-12);
    }
}

/// From the side of the last body: `hook` is between the load and the rod, and the rod carries the
/// load.
#[test]
fn a_ball_is_turned() {
    let crane = Crane::driven().expect("acceptable");
    let constants = crane.constants::<f64>().expect("acceptable");
    let handles = Crane::HANDLES;
    let mut state = crane.start::<f64>();
    crane
        .set_angle(&mut state, handles.elbow, 0.6)
        .expect("free");
    let before = relative::<Crane>(&state, [handles.boom, handles.rod]);
    let wanted = UnitQuaternion::from_scaled_axis(Vector3::new(0.7, -1.1, 2.0));
    let given = *wanted.quaternion() * 3.0;
    crane
        .set_relative_orientation(&mut state, handles.hook, given)
        .expect("free");
    closed(&View::<f64, Crane>::new(&constants, 0.0, &state));
    assert!(
        difference(
            &before,
            &relative::<Crane>(&state, [handles.boom, handles.rod])
        ) < 1e-13
    );
    // Both stood along the global axes: the second body of the joint is the rod.
    let [load, rod] = [handles.load, handles.rod]
        .map(|body| UnitQuaternion::from_quaternion(Crane::pose(&state, body).orientation));
    let found = load.inverse() * rod;
    assert!(
        found.angle_to(&wanted) < 1e-14,
        "{}",
        found.angle_to(&wanted)
    );
    // A hinge does not leave that free.
    let fault = crane.set_relative_orientation(&mut state, handles.elbow, given);
    assert_eq!(
        fault,
        Err(Fault::Assembly(AssemblyFault::NotFree { joint: "elbow" }))
    );
}

#[test]
fn sleeves_wires_and_wheels_are_set() {
    let loose = Loose::default();
    let constants = loose.constants::<f64>().expect("acceptable");
    let handles = Loose::HANDLES;
    let start = loose.start();
    let mut state = start;
    loose
        .set_displacement(&mut state, handles.sleeve, -0.2)
        .expect("free");
    loose
        .set_angle(&mut state, handles.bearing, 2.5)
        .expect("free");
    loose
        .set_angle(&mut state, handles.sleeve, -9.0)
        .expect("free");
    loose
        .set_displacement(&mut state, handles.wire, 0.3)
        .expect("free");
    loose
        .set_angle_rate(&mut state, handles.sleeve, 1.5)
        .expect("free");
    loose
        .set_displacement_rate(&mut state, handles.wire, 0.1)
        .expect("free");
    let view = View::<f64, Loose>::new(&constants, 0.0, &state);
    closed(&view);
    let angle = view.angle(handles.sleeve);
    assert!((angle + 9.0).abs() < 1e-14, "{angle}");
    assert!((view.angle_rate(handles.sleeve) - 1.5).abs() < 1e-14);
    assert!((view.displacement(handles.sleeve) + 0.2).abs() < 1e-14);
    assert!((view.displacement(handles.wire) - 0.3).abs() < 1e-14);
    assert!((view.displacement_rate(handles.wire) - 0.1).abs() < 1e-14);
    assert!((view.angle(handles.bearing) - 2.5).abs() < 1e-14);
    let twist = Loose::unwrapped_angles(&state, handles.twist);
    assert!((twist[0] + 9.0).abs() < 1e-14, "{twist:?}");
    // The turns are those that were set.
    loose
        .set_angle(&mut state, handles.bearing, 2.5 + 5.0 * TAU)
        .expect("free");
    let view = View::<f64, Loose>::new(&constants, 0.0, &state);
    assert!((view.angle(handles.bearing) - 2.5 - 5.0 * TAU).abs() < 1e-13);
    assert!((view.wrapped_angle(handles.bearing) - 2.5).abs() < 1e-13);
    // What does not hang on them is where it was.
    for body in [handles.puck, handles.satellite] {
        assert_eq!(
            Loose::pose(&state, body).position,
            Loose::pose(&start, body).position
        );
        assert_eq!(Loose::velocity(&state, body), Loose::velocity(&start, body));
    }
    let fault = loose.set_angle(&mut state, handles.bearing, f64::NAN);
    assert_eq!(fault, Err(Fault::Step(StepFault::StateNotFinite)));
    assert!(numbers::<Loose>(&state).iter().all(|x| x.is_finite()));
}

#[test]
fn what_closes_a_loop_is_not_set() {
    let bars = FourBar::default();
    let constants = bars.constants::<f64>().expect("acceptable");
    let handles = FourBar::HANDLES;
    let mut state = bars.described_state::<f64>().expect("described");
    let before = state;
    let hinges = [handles.first, handles.second, handles.third, handles.fourth];
    let mut closing = 0;
    for hinge in hinges {
        match bars.set_angle(&mut state, hinge, 0.2) {
            Ok(()) => state = before,
            Err(fault) => {
                closing += 1;
                assert_eq!(state, before);
                let Fault::Assembly(AssemblyFault::CarriesNothing { joint, instead }) = fault
                else {
                    panic!("{fault}");
                };
                assert_eq!(joint, hinge.name());
                let instead = instead.expect("a joint of the tree");
                assert!(
                    fault.to_string().contains(&format!("set `{instead}`")),
                    "{fault}"
                );
                let other = hinges.iter().find(|other| other.name() == instead);
                bars.set_angle(&mut state, *other.expect("a hinge"), 0.2)
                    .expect("as advised");
                state = before;
            }
        }
    }
    assert_eq!(closing, 1);
    // The crank, and the rest by assembling.
    bars.set_angle(&mut state, handles.first, 0.3)
        .expect("free");
    let counted = FourBar::unwrapped_angles(&state, handles.mesh);
    assert!(
        counted.iter().any(|angle| (angle - 0.3).abs() < 1e-14),
        "{counted:?}"
    );
    bars.set_angle(&mut state, handles.shaft, -0.6)
        .expect("free");
    bars.assemble(0.0, &mut state).expect("near");
    let view = View::<f64, FourBar>::new(&constants, 0.0, &state);
    closed(&view);
    let [first, shaft] = [handles.first, handles.shaft].map(|joint| view.angle(joint));
    println!("assembled at {first} and {shaft} rad");
    assert!((first - 0.3).abs() < 1e-12, "{first}");
    assert!((shaft + 2.0 * first).abs() < 1e-12, "{shaft}");
}

/// Nothing lies along anything: what vanishes in the rows of the joints does so to round-off only.
#[derive(Mechanism)]
struct Askew {
    #[body(
        mass = 0.8,
        inertia = [[0.02, 0.003, 0.001], [0.003, 0.03, -0.002], [0.001, -0.002, 0.025]],
        position = [0.0, 0.5, 0.0],
        orientation = rotation([1.0, 0.0, 1.0], 0.4)
    )]
    first: Body,
    #[body(
        mass = 1.5,
        inertia = [[0.02, 1e-8, 0.0], [1e-8, 0.03, 0.0], [0.0, 0.0, 0.025]],
        position = [0.0, 1.5, 0.0]
    )]
    second: Body,
    #[body(mass = 1.5, inertia = [0.02, 0.03, 0.025], position = [0.0, 2.5, 0.0], orientation = rotation([0.0, 0.0, 1.0], 0.3))]
    third: Body,
    #[body(mass = 1.5, inertia = [0.02, 0.03, 0.025], position = [0.0, 3.5, 0.0])]
    fourth: Body,
    #[body(mass = 1.0, inertia = [0.02, 0.03, 0.025], position = [0.0, 4.5, 0.0], orientation = rotation([1.0, 2.0, 3.0], 1.0))]
    fifth: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    sleeve: Cylindrical,
    #[joint(between = [first, second], point = [0.0, 1.0, 0.0], axis = [1.0, 1.0, 0.0])]
    slide: Prismatic,
    #[joint(between = [second, third], point = [0.0, 2.0, 0.0])]
    ball: Spherical,
    #[joint(between = [fourth, third], point = [0.0, 3.0, 0.0], axis = [0.0, 0.0, 1.0])]
    hinge: Revolute,
    #[joint(between = [fourth, fifth], point = [0.0, 4.0, 0.0], axis = [1.0, 0.2, 0.3])]
    other: Revolute,
}

#[test]
fn what_lies_askew_is_set_like_anything_else() {
    let askew = Askew::default();
    let constants = askew.constants::<f64>().expect("literal");
    let handles = Askew::HANDLES;
    let mut state = askew.described_state::<f64>().expect("closed");
    for round in 0..8 {
        let value = 0.3 + 0.4 * f64::from(round);
        askew
            .set_displacement(&mut state, handles.sleeve, -value)
            .expect("free");
        askew
            .set_angle(&mut state, handles.sleeve, value)
            .expect("free");
        askew
            .set_displacement(&mut state, handles.slide, value)
            .expect("free");
        askew
            .set_displacement_rate(&mut state, handles.slide, -value)
            .expect("free");
        let orientation = *UnitQuaternion::from_euler_angles(value, 0.2, -value).quaternion();
        askew
            .set_relative_orientation(&mut state, handles.ball, orientation)
            .expect("free");
        askew
            .set_angle(&mut state, handles.hinge, -0.4 * value)
            .expect("free");
        askew
            .set_angle_rate(&mut state, handles.hinge, value)
            .expect("free");
        askew
            .set_angle(&mut state, handles.other, 0.5 * value)
            .expect("free");
        askew
            .set_angle_rate(&mut state, handles.other, -value)
            .expect("free");
        let view = View::<f64, Askew>::new(&constants, 0.0, &state);
        closed(&view);
        let near =
            |read: f64, set: f64| assert!((read - set).sin().abs() < 1e-13, "{read} for {set}");
        near(view.displacement(handles.sleeve), -value);
        near(view.angle(handles.sleeve), value);
        near(view.displacement(handles.slide), value);
        near(view.angle(handles.hinge), -0.4 * value);
        near(view.angle_rate(handles.hinge), value);
        near(view.angle(handles.other), 0.5 * value);
        near(view.angle_rate(handles.other), -value);
    }
}
