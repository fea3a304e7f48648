//! A robot with a differential drive, and shafts that roll on each other, against closed forms.

use holonom::nalgebra::Vector3;
use holonom::prelude::*;

/// A robot on two wheels of 0.1 m, 0.4 m apart, and a castor.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both")]
pub(crate) struct Robot {
    /// How far its centre of mass is before the axle (m).
    #[param]
    ahead: f64,
    /// The rates of its wheels (rad/s).
    #[param]
    left_rate: f64,
    #[param]
    right_rate: f64,
    #[body(mass = 6.0, inertia = [0.1, 0.12, 0.15], position = [ahead, 0.0, 0.15])]
    cart: Body,
    #[body(mass = 0.5, inertia = [0.0015, 0.003, 0.0015], position = [0.0, 0.2, 0.1])]
    left: Body,
    #[body(mass = 0.5, inertia = [0.0015, 0.003, 0.0015], position = [0.0, -0.2, 0.1])]
    right: Body,
    #[joint(between = [cart, left], point = [0.0, 0.2, 0.1], axis = [0.0, 1.0, 0.0])]
    left_hub: Revolute,
    #[joint(between = [cart, right], point = [0.0, -0.2, 0.1], axis = [0.0, 1.0, 0.0])]
    right_hub: Revolute,
    #[joint(
        between = [ground, left, right], center_j = [0.0, 0.2, 0.1], center_k = [0.0, -0.2, 0.1],
        axle = [0.0, 1.0, 0.0], point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0], radius = 0.1
    )]
    wheels: WheelPair,
    #[joint(between = [ground, cart], point = [0.3, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    castor: PointOnPlane,
    #[joint(between = [cart, left], axis = [0.0, 1.0, 0.0], motion = left_rate * time)]
    left_motor: AngleDriver,
    #[joint(between = [cart, right], axis = [0.0, 1.0, 0.0], motion = right_rate * time)]
    right_motor: AngleDriver,
}

/// At constant rates of its wheels the robot turns at `W = r (right - left) / (2 b)`, about a
/// centre `v / W` beside it, with `v = r (right + left) / 2`. Its centre of mass, `a` before the
/// axle, takes `m a W^2` towards the axle and the moment `m a v W`: the motors push it.
///
/// Wheels of masses `n` and moments of inertia `J` load each other by what is turned about the
/// ground under the axle: `b (N_l - N_r) = -(m z + 2 n r) v W - J (left + right) W`.
#[test]
fn a_differential_drive_runs_along_an_arc() {
    let (h, [mass, radius, half_track]) = (Robot::HANDLES, [6.0, 0.1, 0.2]);
    for (ahead, left, right) in [(0.0, 4.0, 7.0), (0.08, 6.0, -2.0), (0.08, 5.0, 4.0)] {
        let robot = Robot::new(ahead, left, right).expect("a robot");
        let (speed, turn) = (
            0.5 * radius * (left + right),
            0.5 * radius * (right - left) / half_track,
        );
        let along = -0.5 * mass * ahead * turn * turn;
        let across = 0.5 * mass * ahead * speed * turn / half_track;
        let observe = |sample: &Sample<'_, f64, Robot>| -> Result<(), Fault> {
            let (sine, cosine) = (turn * sample.time()).sin_cos();
            let circle = speed / turn;
            let middle = Vector3::new(circle * sine, circle * (1.0 - cosine), 0.1);
            let side = half_track * Vector3::new(-sine, cosine, 0.0);
            for (wheel, expected) in [(h.left, middle + side), (h.right, middle - side)] {
                let place = sample.pose(wheel).position;
                assert!((place - expected).norm() < 1e-9, "{place} for {expected}");
            }
            for (motor, push) in [
                (h.left_motor, along - across),
                (h.right_motor, along + across),
            ] {
                let effort = sample.driving_effort(motor)?;
                assert!((effort - radius * push).abs() < 1e-9, "{effort} {push}");
            }
            let ahead = Vector3::new(cosine, sine, 0.0);
            let [of_left, of_right] = [
                sample.reaction(h.wheels, h.left)?,
                sample.reaction(h.wheels, h.right)?,
            ];
            let across = of_left.force.dot(&Vector3::new(-sine, cosine, 0.0));
            assert!((across - (mass + 1.0) * speed * turn).abs() < 1e-8);
            let lean = (0.15 * mass + 1.0 * radius) * speed * turn + 0.003 * (left + right) * turn;
            let load = half_track * (of_left.force.z - of_right.force.z);
            assert!((load + lean).abs() < 1e-8, "{load} {lean}");
            // At the point of contact, the radius under the centre.
            let moment = of_left.moment.dot(&ahead);
            assert!((moment - radius * across).abs() < 1e-8, "{moment} {across}");
            Ok(())
        };
        let simulation = || Simulation::new(&robot, StandardLagrange, Rk4::every(1e-3)).assembled();
        simulation()
            .absolute_coordinates()
            .run(0.0..=4.0, every(0.5), observe)
            .expect("a run");
        simulation()
            .joint_coordinates()
            .run(0.0..=4.0, every(0.5), observe)
            .expect("a run");
    }
}

/// Two cylinders of 0.1 and 0.2 m, and a bevel of 0.08 on one of 0.06 m.
#[derive(Mechanism)]
#[mechanism(coordinates = "both")]
pub(crate) struct Shafts {
    /// A torque on the first one (N m).
    #[input]
    torque: f64,
    #[body(mass = 1.0, inertia = [0.02, 0.02, 0.03])]
    first: Body,
    #[body(mass = 2.0, inertia = [0.04, 0.04, 0.05], position = [0.3, 0.0, 0.0])]
    second: Body,
    #[body(mass = 1.0, inertia = [0.01, 0.02, 0.02], position = [0.5, 0.0, 0.11])]
    third: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    first_bearing: Revolute,
    #[joint(between = [ground, second], point = [0.3, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    second_bearing: Revolute,
    #[joint(between = [ground, third], point = [0.5, 0.0, 0.11], axis = [1.0, 0.0, 0.0])]
    third_bearing: Revolute,
    #[joint(between = [first, second, ground], point = [0.1, 0.0, 0.0], tangent = [0.0, 1.0, 0.0])]
    cylinders: RollingPair,
    #[joint(between = [second, third, ground], point = [0.38, 0.0, 0.05], tangent = [0.0, 1.0, 0.0])]
    bevels: RollingPair,
    #[force(between = [ground, first], axis = [0.0, 0.0, 1.0], moment = torque)]
    motor: TorsionalActuator,
}

/// Rates are in proportion, `w_2 = -w_1 / 2` and `w_3 = 4/3 w_2`; so are the inertias that the
/// torque accelerates. The force between two shafts is what accelerates those behind it.
#[test]
fn shafts_that_roll_on_each_other_turn_in_proportion() {
    let h = Shafts::HANDLES;
    let shafts = Shafts {
        torque: 0.3,
        ..Shafts::default()
    };
    let ratios = [1.0, -0.5, -2.0 / 3.0];
    let inertia = 0.03 + 0.05 * 0.25 + 0.01 * 4.0 / 9.0;
    let acceleration = 0.3 / inertia;
    let on_third = 0.01 * ratios[2] * acceleration / 0.06;
    let on_second = -(0.05 * ratios[1] * acceleration + 0.08 * on_third) / 0.2;
    let observe = |sample: &Sample<'_, f64, Shafts>| -> Result<(), Fault> {
        let time = sample.time();
        let turned = 0.5 * acceleration * time * time;
        let angles = [h.first_bearing, h.second_bearing, h.third_bearing];
        for (bearing, ratio) in angles.into_iter().zip(ratios) {
            let rate = sample.angle_rate(bearing);
            assert!((rate - ratio * acceleration * time).abs() < 1e-11, "{rate}");
            let turns = (sample.angle(bearing) - ratio * turned) / core::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < 1e-11, "{turns}");
        }
        let [first, second] = [Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.38, 0.0, 0.05)];
        for (pair, body, force, at) in [
            (h.cylinders, h.second, on_second, first),
            (h.bevels, h.third, on_third, second),
        ] {
            let reaction = sample.reaction(pair, body)?;
            let expected = Vector3::new(0.0, force, 0.0);
            assert!(
                (reaction.force - expected).norm() < 1e-10,
                "{reaction:?} {force}"
            );
            // It acts at the point of the carrier; that of the body has turned away.
            let arm = reaction.point - at;
            assert!((reaction.moment + arm.cross(&reaction.force)).norm() < 1e-10);
        }
        Ok(())
    };
    let simulation = || Simulation::new(&shafts, StandardLagrange, Rk4::every(1e-3));
    simulation()
        .absolute_coordinates()
        .run(0.0..=1.0, every(0.25), observe)
        .expect("a run");
    simulation()
        .joint_coordinates()
        .run(0.0..=1.0, every(0.25), observe)
        .expect("a run");
}
