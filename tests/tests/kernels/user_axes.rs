//! A body with a full inertia tensor: what is read and set by handle is in the axes in which it was
//! described.

use holonom::prelude::*;
use holonom::{Pose, StateParts};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use crate::comparison::{DOUBLE, distance};
use crate::mechanisms::{FullTensors, TILTED, UPRIGHT, rotation_of};
use crate::scene::{Scene, constants, flat, state, states_to_try, violated};

const HANDLES: <FullTensors as Mechanism>::Handles = FullTensors::HANDLES;

/// `orientation = rotation([0.4, -0.2, 1.0], deg(65.0))`.
fn described() -> UnitQuaternion<f64> {
    let axis = nalgebra::Unit::new_normalize(Vector3::new(0.4, -0.2, 1.0));
    UnitQuaternion::from_axis_angle(&axis, 65_f64.to_radians())
}

fn attitude(pose: &Pose<f64>) -> UnitQuaternion<f64> {
    let p = pose.orientation;
    rotation_of([p.w, p.i, p.j, p.k])
}

fn tensor(rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|row, column| rows[row][column])
}

#[test]
fn the_described_state_reads_as_it_was_written() {
    /// Round-off of a product of rotations.
    const ROUND_OFF: f64 = 1e-15;
    let state = FullTensors::default()
        .described_state::<f64>()
        .expect("described");
    let pose = FullTensors::pose(&state, HANDLES.tilted);
    assert!(attitude(&pose).angle_to(&described()) < 10.0 * ROUND_OFF);
    assert_eq!(pose.position, Vector3::new(0.2, 0.3, -0.1));
    let spin = FullTensors::angular_velocity(&state, HANDLES.tilted);
    assert!((spin - Vector3::new(0.3, 1.2, -0.7)).amax() <= ROUND_OFF);
    let global = FullTensors::angular_velocity_global(&state, HANDLES.tilted);
    assert!((global - described() * spin).amax() <= 10.0 * ROUND_OFF);
    let upright = FullTensors::pose(&state, HANDLES.upright);
    assert!(attitude(&upright).angle() < 10.0 * ROUND_OFF);
}

#[test]
fn what_is_set_is_read_back() {
    let mut state = FullTensors::default()
        .described_state::<f64>()
        .expect("described");
    let pose = Pose {
        position: Vector3::new(-1.0, 2.0, 0.5),
        orientation: Quaternion::new(0.1, -0.7, 0.5, 0.5),
    };
    FullTensors::set_pose(&mut state, HANDLES.tilted, pose);
    FullTensors::set_velocity(&mut state, HANDLES.tilted, Vector3::new(1.0, 2.0, 3.0));
    let spin = Vector3::new(-0.4, 0.9, 2.0);
    FullTensors::set_angular_velocity(&mut state, HANDLES.tilted, spin);
    let read = FullTensors::pose(&state, HANDLES.tilted);
    assert_eq!(read.position, pose.position);
    assert!(attitude(&read).angle_to(&attitude(&pose)) <= 10.0 * f64::EPSILON);
    assert_eq!(
        FullTensors::velocity(&state, HANDLES.tilted),
        Vector3::new(1.0, 2.0, 3.0)
    );
    assert!((FullTensors::angular_velocity(&state, HANDLES.tilted) - spin).amax() <= DOUBLE);
    let global = Vector3::new(0.3, -0.8, 1.1);
    FullTensors::set_angular_velocity_global(&mut state, HANDLES.tilted, global);
    let along_body = attitude(&pose).inverse() * global;
    assert!((FullTensors::angular_velocity(&state, HANDLES.tilted) - along_body).amax() <= DOUBLE);
}

#[test]
fn the_kinetic_energy_is_that_of_the_tensor_as_written() {
    let constants = constants::<f64, FullTensors>();
    for x in violated(&FullTensors::assembler(), states_to_try(), 15) {
        let state = state::<f64, FullTensors>(x.as_slice());
        let mut expected = 0.0;
        for (body, mass, rows) in [
            (HANDLES.tilted, 1.5, TILTED),
            (HANDLES.upright, 0.8, UPRIGHT),
        ] {
            let v = FullTensors::velocity(&state, body);
            let w = FullTensors::angular_velocity(&state, body);
            expected += 0.5 * (mass * v.norm_squared() + w.dot(&(tensor(rows) * w)));
        }
        let computed = FullTensors::kinetic_energy(&constants, &state);
        assert!(distance(&[computed], &[expected], 0.0) <= DOUBLE);
    }
}

#[test]
fn a_moment_in_body_axes_turns_the_body_as_its_tensor_says() {
    // With a huge compliance the joints let go, and J w' = moment - w x J w in the axes as written.
    let moment = Vector3::new(0.3, -0.2, 0.5);
    let weak = Penalty::new(1e-9, 1e-3, 1.0);
    let dynamics =
        holonom::dynamics::Dynamics::<Problem<FullTensors, _>>::new(&FullTensors::default(), weak)
            .expect("acceptable")
            .forces(|_, _, loads| loads.moment_in_body_axes(HANDLES.tilted, moment.into()));
    let state = FullTensors::default()
        .described_state::<f64>()
        .expect("described");
    let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("solvable");
    // The rate of w has the place of w in a state.
    let mut rates = state;
    *rates.velocities_mut() = *evaluation.rates.velocities();
    let spin_rate = FullTensors::angular_velocity(&rates, HANDLES.tilted);
    let w = FullTensors::angular_velocity(&state, HANDLES.tilted);
    let gyroscopic = w.cross(&(tensor(TILTED) * w));
    let error = tensor(TILTED) * spin_rate - (moment - gyroscopic);
    // What the compliance of 1e9 still transmits: 1e-9 times accelerations and stabilisation of the
    // size 10.
    assert!(error.amax() <= 1e-7, "{error}");
}

#[test]
fn a_point_moves_as_the_body_turns() {
    let x = &violated(&FullTensors::assembler(), 1, 16)[0];
    let state = state::<f64, FullTensors>(x.as_slice());
    let arm = Vector3::new(0.4, 0.1, 0.2);
    let pose = FullTensors::pose(&state, HANDLES.tilted);
    let point = FullTensors::point(&state, HANDLES.tilted, arm);
    assert!((point - (pose.position + attitude(&pose) * arm)).amax() <= DOUBLE);
    let speed = FullTensors::point_velocity(&state, HANDLES.tilted, arm);
    let spin = FullTensors::angular_velocity(&state, HANDLES.tilted);
    let expected =
        FullTensors::velocity(&state, HANDLES.tilted) + attitude(&pose) * spin.cross(&arm);
    assert!((speed - expected).amax() <= DOUBLE);
    assert_eq!(flat::<f64, FullTensors>(&state), x.as_slice());
}
