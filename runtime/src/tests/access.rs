//! Access by handle, in axes that are turned by 90 degrees about x against the principal ones.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::rod::{PIVOT, ROD, Rod, rod};
use crate::measure::Viewed as _;
use crate::state::State;
use crate::*;

fn state() -> State<f64, 7, 6> {
    State::from_parts(
        [1.0, 2.0, 3.0, 0.5, 0.5, -0.5, 0.5],
        [0.1, 0.2, 0.3, 4.0, 5.0, 6.0],
    )
}

#[test]
fn handles_know_their_names() {
    assert_eq!((ROD.name(), ROD.index()), ("rod", 0));
    assert_eq!((PIVOT.name(), PIVOT.index()), ("pivot", 0));
}

#[test]
fn the_described_orientation_is_that_of_the_users_axes() {
    let described = rod().described_state::<f64>().unwrap();
    let pose = Rod::pose(&described, ROD);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), core::f64::consts::FRAC_PI_2);
    assert!((pose.orientation - turn.into_inner()).norm() < 1e-15);
    // The user's y is the principal z, which is the global z.
    let tip = Rod::point(&described, ROD, Vector3::new(0.0, 1.0, 0.0));
    assert!((tip - Vector3::new(0.0, 0.5, 1.0)).norm() < 1e-15);
}

#[test]
fn what_is_set_is_read() {
    let mut state = state();
    let pose = Pose {
        position: Vector3::new(-1.0, 0.5, 2.0),
        orientation: Quaternion::new(0.1, 0.7, -0.1, 0.7),
    };
    Rod::set_pose(&mut state, ROD, pose);
    Rod::set_velocity(&mut state, ROD, Vector3::new(7.0, 8.0, 9.0));
    Rod::set_angular_velocity(&mut state, ROD, Vector3::new(1.0, 2.0, 3.0));
    let read = Rod::pose(&state, ROD);
    assert_eq!(read.position, pose.position);
    assert!((read.orientation - pose.orientation).norm() < 1e-15);
    assert_eq!(Rod::velocity(&state, ROD), Vector3::new(7.0, 8.0, 9.0));
    assert!((Rod::angular_velocity(&state, ROD) - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-15);

    let global = Vector3::new(-3.0, 0.2, 1.0);
    Rod::set_angular_velocity_global(&mut state, ROD, global);
    assert!((Rod::angular_velocity_global(&state, ROD) - global).norm() < 1e-14);
    let turned = UnitQuaternion::from_quaternion(pose.orientation);
    let local = turned.inverse_transform_vector(&global);
    assert!((Rod::angular_velocity(&state, ROD) - local).norm() < 1e-14);
}

#[test]
fn the_velocity_of_a_point_is_the_rate_of_the_point() {
    let (mut before, mut after) = (state(), state());
    let place = Vector3::new(0.3, -0.4, 0.5);
    let step = 1e-6;
    let constants = Rod::prepare(&[7.02]);
    for (state, half) in [(&mut before, -0.5 * step), (&mut after, 0.5 * step)] {
        let rates = Rod::coordinate_rates(&constants, &*state);
        for (q, rate) in state.coordinates_mut().iter_mut().zip(rates) {
            *q += half * rate;
        }
    }
    let difference = (Rod::point(&after, ROD, place) - Rod::point(&before, ROD, place)) / step;
    assert!((Rod::point_velocity(&state(), ROD, place) - difference).norm() < 1e-8);
}

#[test]
fn a_view_of_a_mechanism_reads_what_one_of_its_constants_reads() {
    let mut rod = rod();
    rod.mass = 3.0;
    let (state, time) = (state(), 0.5);
    let owned = rod.view(time, &state).unwrap();
    let constants = rod.constants().unwrap();
    let borrowed = View::<_, Rod>::new(&constants, time, &state);
    assert_eq!(owned.time(), time);
    assert_eq!(owned.kinetic_energy(), borrowed.kinetic_energy());
    assert_eq!(owned.potential_energy(), borrowed.potential_energy());
    assert_eq!(owned.pose(ROD), borrowed.pose(ROD));
    assert_eq!(owned.angle(PIVOT), borrowed.angle(PIVOT));
    assert_eq!(owned.violation(), borrowed.violation());
    assert_eq!(owned.borrowed().energy(), borrowed.energy());
    rod.mass = -1.0;
    assert!(rod.view(time, &state).is_err());
}
