//! Momenta of one body in the user's axes, which are turned against the principal ones.

extern crate std;

use std::string::ToString as _;

use nalgebra::{UnitQuaternion, Vector3};

use super::rod::{ROD, Rod, rod};
use crate::error::ReadingFault;
use crate::state::State;
use crate::*;

/// About the user's x, y and z: y is the principal z.
const INERTIA: Vector3<f64> = Vector3::new(0.585_526_5, 0.585_526_5, 0.001_053);

#[test]
fn momenta_are_those_of_the_users_inertia() {
    let rod = rod();
    let constants = rod.constants().unwrap();
    // Of no unit length: what is read has it.
    let state = State::<f64, 7, 6>::from_parts(
        [1.0, 2.0, 3.0, 0.6, -1.0, 0.4, 1.2],
        [0.1, 0.2, 0.3, 4.0, 5.0, 6.0],
    );
    let view = View::<f64, Rod>::new(&constants, 0.0, &state);
    let near = |a: Vector3<f64>, b: Vector3<f64>| assert!((a - b).norm() < 1e-13, "{a} {b}");
    let pose = view.pose(ROD);
    let turn = UnitQuaternion::from_quaternion(pose.orientation);
    let own = turn * INERTIA.component_mul(&view.angular_velocity(ROD));
    let about = Vector3::new(-1.0, 0.5, 4.0);
    let linear = view.linear_momentum(ROD);
    assert!((view.mass(..) - rod.mass).abs() < 1e-15);
    near(linear, view.velocity(ROD) * rod.mass);
    near(view.angular_momentum_about_centre(..).unwrap(), own);
    let arm = pose.position - about;
    near(
        view.angular_momentum([ROD], about),
        own + arm.cross(&linear),
    );
    // To the last bit, by an array, a slice, and a body that is named twice.
    let all = [ROD, ROD];
    assert_eq!(view.centre_of_mass(ROD).unwrap(), pose.position);
    assert_eq!(view.centre_of_mass(all).unwrap(), pose.position);
    let velocity = view.velocity(ROD);
    assert_eq!(view.centre_of_mass_velocity(&all[..]).unwrap(), velocity);
}

#[test]
fn nothing_has_no_centre_of_mass() {
    let rod = rod();
    let (constants, state) = (rod.constants().unwrap(), rod.described_state().unwrap());
    let view = View::<f64, Rod>::new(&constants, 0.0, &state);
    let none: [BodyHandle<Rod>; 0] = [];
    assert_eq!(view.linear_momentum(none), Vector3::zeros());
    let fault = view.centre_of_mass(none).unwrap_err();
    assert_eq!(fault, ReadingFault::NoMass { bodies: 0 });
    assert_eq!(
        fault.to_string(),
        "no body was named: there is no centre of mass"
    );
    assert!(view.centre_of_mass_velocity(none).is_err());
    assert!(view.angular_momentum_about_centre(none).is_err());
    // A body of another mechanism's size is none of these.
    assert!(view.centre_of_mass(BodyHandle::new(7)).is_err());
}
