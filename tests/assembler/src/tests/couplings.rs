//! Joints that transmit rotation, with the transmission that is known for them, and the count of
//! turns.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::catalogue::{Data, catalogue, holds_as_described};
use super::integrate;
use crate::accuracy::assert_close;
use crate::angles::counted;
use crate::assembler::Assembler;
use crate::bodies::{BodyId, GROUND};
use crate::forces::Force;
use crate::formulation::{Evaluator, Formulation};
use crate::joints::Joint;
use crate::laws::Motion;
use crate::scenes::{Ends, random_body, two_bodies};
use crate::states::{Spread, generator, make_consistent_at, random_consistent_state};

/// Small enough to stay on one branch.
const NEAR: Spread = Spread {
    position: 0.05,
    angle: 0.2,
    velocity: 1.0,
    rate: 3.0,
    norm: 0.0,
};

/// Two shafts in bearings on the ground along two axes through the origin.
fn shafts(seed: u64, axes: [[f64; 3]; 2]) -> (Assembler, [BodyId; 2]) {
    let mut rng = generator(seed);
    let mut scene = Assembler::new([0.0; 3]);
    let shafts = [(); 2].map(|()| scene.add_body(random_body(&mut rng)));
    for (shaft, axis) in shafts.iter().zip(axes) {
        scene.add_revolute([GROUND, *shaft], [0.0; 3], axis);
    }
    (scene, shafts)
}

/// The rates of turning of two bodies about two fixed axes.
fn rates(scene: &Assembler, bodies: [BodyId; 2], axes: [[f64; 3]; 2], x: &[f64]) -> [f64; 2] {
    let at = scene.kinematics(x);
    [0, 1].map(|k| {
        let frame = at.frame(bodies[k]);
        (frame.rotation * frame.rate).dot(&Vector3::from(axes[k]).normalize())
    })
}

#[test]
fn a_bent_constant_velocity_coupling_keeps_the_rate() {
    let bend = 0.6_f64;
    let axes = [[0.0, 0.0, 1.0], [0.0, bend.sin(), bend.cos()]];
    let (mut scene, shafts) = shafts(30, axes);
    let joint = Joint::constant_velocity(&scene, shafts, [0.0; 3], axes[0], axes[1]);
    scene.add_joint(joint);
    let mut rng = generator(31);
    for _ in 0..20 {
        let x = random_consistent_state(&scene, 0.0, NEAR, &mut rng);
        let [first, second] = rates(&scene, shafts, axes, x.as_slice());
        assert!(first.abs() > 1e-3);
        assert_close("rates", &[first], &[second], 1e-10);
    }
}

#[test]
fn a_bent_universal_joint_has_the_published_ratio() {
    let bend = 0.6_f64;
    let axes = [[0.0, 0.0, 1.0], [0.0, bend.sin(), bend.cos()]];
    let (mut scene, shafts) = shafts(32, axes);
    // The first fork stands across the plane of the shafts, the second one in it.
    let forks = [[1.0, 0.0, 0.0], [0.0, bend.cos(), -bend.sin()]];
    let joint = Joint::universal(&scene, shafts, [0.0; 3], forks[0], forks[1]);
    scene.add_joint(joint);
    let mut rng = generator(33);
    for _ in 0..20 {
        let x = random_consistent_state(&scene, 0.0, NEAR, &mut rng);
        let at = scene.kinematics(x.as_slice());
        let turn = scene.angle([GROUND, shafts[0]], axes[0]).principal(&at);
        let [first, second] = rates(&scene, shafts, axes, x.as_slice());
        // From f_1 = (cos, sin, 0) perpendicular to f_2: tan of the second angle = cos bend tan of
        // the first.
        let ratio = bend.cos() / (1.0 - (bend.sin() * turn.sin()).powi(2));
        assert_close("rates", &[second], &[first * ratio], 1e-10);
    }
}

#[test]
fn gears_and_racks_turn_by_their_ratio() {
    let axes = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
    let (mut scene, shafts) = shafts(34, axes);
    let [i, j] = shafts;
    let joint = Joint::gear(&scene, [i, j, GROUND], axes[0], axes[1], -2.5);
    scene.add_joint(joint);
    let rack = scene.add_body(random_body(&mut generator(35)));
    scene.add_joint(Joint::prismatic(
        &scene,
        [GROUND, rack],
        [0.1; 3],
        [0.0, 2.0, 0.0],
    ));
    scene.add_joint(Joint::rack_and_pinion(
        &scene,
        [j, rack, GROUND],
        axes[1],
        [[0.0; 3], [0.1; 3]],
        [0.0, 2.0, 0.0],
        0.3,
    ));
    let mut rng = generator(36);
    for _ in 0..20 {
        let x = random_consistent_state(&scene, 0.0, NEAR, &mut rng);
        let x = x.as_slice();
        let [first, second] = rates(&scene, shafts, axes, x);
        assert_close("gear", &[second], &[-2.5 * first], 1e-10);
        let slide = scene.kinematics(x).frame(rack).velocity.y;
        assert_close("rack", &[slide], &[0.3 * second], 1e-10);
        let angle = |k: usize| scene.angles()[k].value(&scene.kinematics(x));
        assert_close("angles", &[angle(0)], &[-2.5 * angle(1)], 1e-12);
    }
}

#[test]
fn a_count_goes_to_the_nearest_turn() {
    for turns in -3..=3 {
        let turns = TAU * f64::from(turns);
        for drift in [-3.0, -1.0, 0.0, 1.0, 3.0] {
            let near = 0.4 + turns + drift;
            assert_close("count", &[counted(0.4, near)], &[0.4 + turns], 1e-14);
        }
    }
}

#[test]
fn auxiliary_states_turn_with_their_angles_on_a_hinge() {
    let mut rng = generator(39);
    for ends in Ends::ALL {
        let data = Data::random(&mut rng);
        let (point, axis) = (data.head.into(), data.a.into());
        let mut hinge = [GROUND; 2];
        let mut scene = two_bodies(ends, &mut rng, |scene, between, _| {
            hinge = between;
            Joint::revolute(scene, between, point, axis)
        });
        let spring = Force::torsional_spring_damper(&scene, hinge, axis, 1.0, 0.0, 0.0);
        scene.add_force(spring);
        for _ in 0..10 {
            let x = random_consistent_state(&scene, 0.0, Spread::default(), &mut rng);
            let rate = scene.angles()[0].rate(&scene.kinematics(x.as_slice()));
            let turning = scene.coordinate_rates(x.as_slice())[scene.body_coordinates()];
            assert!(rate.abs() > 1e-3);
            assert_close("s'", &[turning], &[rate], 1e-12);
        }
    }
}

#[test]
fn a_driven_screw_counts_its_turns() {
    let mut rng = generator(37);
    let mut scene = Assembler::new([0.0, 0.0, -9.81]);
    let nut = scene.add_body(random_body(&mut rng));
    let (point, axis) = ([0.1, 0.2, 0.3], [1.0, -2.0, 0.5]);
    scene.add_joint(Joint::screw(&scene, [GROUND, nut], point, axis, 0.2));
    let law = Motion::polynomial([0.0, 7.0, 1.0, 0.0]);
    scene.add_joint(Joint::angle_driver(&scene, [GROUND, nut], axis, law));
    let mut x = scene.initial_state();
    make_consistent_at(&scene, 0.0, x.as_mut_slice()).expect("close");
    let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
    integrate(&mut evaluator, x.as_mut_slice(), 1e-3, 3000);
    // 7 t + t^2 at 3 s: almost five turns.
    let at = scene.kinematics_at(3.0, x.as_slice());
    for angle in scene.angles() {
        assert_close("angle", &[angle.value(&at)], &[30.0], 1e-8);
    }
    assert_close("auxiliary states", &at.turns, &[30.0; 2], 1e-8);
    let unit = Vector3::from(axis).normalize();
    let p = scene.point(nut, point).point(&at) - Vector3::from(point);
    assert_close("advance", &[unit.dot(&p)], &[0.2 * 30.0 / TAU], 1e-8);
    assert!(scene.constraints_at(3.0, x.as_slice()).amax() < 1e-8);
}

#[test]
fn motions_stay_on_the_constraints() {
    let mut rng = generator(38);
    for entry in catalogue() {
        if entry.bodies != 2 || !holds_as_described(entry.name) {
            continue;
        }
        for ends in Ends::ALL {
            let data = Data::random(&mut rng);
            let scene = two_bodies(ends, &mut rng, |scene, [i, j], _| {
                (entry.place)(scene, [i, j, GROUND], &data)
            });
            let mut x = random_consistent_state(&scene, 0.0, NEAR, &mut rng);
            let mut evaluator = Evaluator::new(scene.clone(), Formulation::Standard);
            integrate(&mut evaluator, x.as_mut_slice(), 1e-3, 200);
            let phi = scene.constraints_at(0.2, x.as_slice()).amax();
            let rate = scene.constraint_rates_at(0.2, x.as_slice()).amax();
            // The method's own error, with rates of some rad/s and arms of some metres.
            assert!(
                phi < 1e-7 && rate < 1e-6,
                "{}: {phi:e}, {rate:e}",
                entry.name
            );
        }
    }
}
