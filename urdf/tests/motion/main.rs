//! Sources that are printed or put in place, compiled: accelerations of the robots against those of
//! Pinocchio.

#![forbid(unsafe_code)]

mod equations;
mod in_place;
mod limits;
mod massless;
mod regressor;
mod robots;
mod shapes;

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::Path;

use holonom::dynamics::Dynamics;
use holonom::prelude::*;
use holonom::state::MovingState;
use serde::Deserialize;

/// What `data/reference.json` has of a robot's motion.
#[derive(Deserialize)]
struct Motion {
    /// Names, in the order of the arrays.
    joints: Vec<String>,
    /// The joints that mimic none, in the order of the efforts.
    leaders: Vec<String>,
    states: Vec<State>,
}

/// In rad and N m, of slides m and N.
#[derive(Deserialize)]
struct State {
    positions: Vec<f64>,
    rates: Vec<f64>,
    efforts: Vec<f64>,
    accelerations: Vec<f64>,
    equations: Option<equations::Reference>,
}

#[derive(Deserialize)]
struct Robot {
    motion: Option<Motion>,
}

fn motion(robot: &str) -> Motion {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference.json");
    let text = fs::read_to_string(path).expect("it is there");
    let mut robots: BTreeMap<String, Robot> = serde_json::from_str(&text).expect("as written");
    robots
        .remove(robot)
        .and_then(|robot| robot.motion)
        .expect("its motion is there")
}

fn by_name<'a>(names: &'a [String], values: &[f64]) -> HashMap<&'a str, f64> {
    names
        .iter()
        .map(String::as_str)
        .zip(values.iter().copied())
        .collect()
}

/// Holds accelerations of joints, hinges and slides by their names in the file, to those of the
/// reference, in given states under given efforts.
macro_rules! moves_as_given {
    ($robot:literal, [$printed:ty, $placed:ty], $($rest:tt)*) => {
        moves_as_given!($robot, $printed, $($rest)*);
        moves_as_given!($robot, $placed, $($rest)*);
        assert_eq!(<$printed>::REPORT, <$placed>::REPORT);
        assert_eq!(<$printed>::JOINT_NAMES, <$placed>::JOINT_NAMES);
        assert_eq!(<$printed>::POSITION_LIMITS, <$placed>::POSITION_LIMITS);
    };
    ($robot:literal, $type:ty, hinges: [$($hinge:literal $a:ident),*], slides: [$($slide:literal $d:ident),*],
        efforts: [$($leader:literal $input:ident),*]) => {{
        let motion = motion($robot);
        let handles = <$type>::HANDLES;
        let mut worst = 0.0_f64;
        for given in &motion.states {
            let positions = by_name(&motion.joints, &given.positions);
            let rates = by_name(&motion.joints, &given.rates);
            let efforts = by_name(&motion.leaders, &given.efforts);
            let wanted = by_name(&motion.joints, &given.accelerations);
            let mut robot = <$type>::default();
            $(robot.$input = efforts[$leader];)*
            let mut state = robot.described_state::<f64>().expect("sound");
            $(robot.set_angle(&mut state, handles.$a, positions[$hinge]).expect("it carries");)*
            $(robot.set_displacement(&mut state, handles.$d, positions[$slide]).expect("it carries");)*
            $(robot.set_angle_rate(&mut state, handles.$a, rates[$hinge]).expect("it carries");)*
            $(robot.set_displacement_rate(&mut state, handles.$d, rates[$slide]).expect("it carries");)*
            let dynamics = Dynamics::new(&robot, StandardLagrange).expect("sound");
            let dynamics = dynamics.joint_coordinates();
            let state = dynamics.state_of(&state).expect("closed");
            let (evaluation, _) = dynamics.evaluate(0.0, &state).expect("regular");
            // Rates of joints are linear in the velocities, whatever these are counted against.
            let mut moving = state;
            moving.rates_slice_mut().copy_from_slice(evaluation.rates.rates_slice());
            let bodies = dynamics.bodies(&moving);
            let view = dynamics.view(0.0, &bodies);
            let found = [
                $(($hinge, view.angle_rate(handles.$a)),)*
                $(($slide, view.displacement_rate(handles.$d)),)*
            ];
            assert_eq!(found.len(), motion.joints.len(), "joints");
            let largest = given.accelerations.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
            for (name, found) in found {
                let error = (found - wanted[name]).abs() / largest;
                worst = worst.max(error);
                assert!(error < LIMIT, "{}, {name}: {found} for {}", $robot, wanted[name]);
            }
        }
        println!("{}: {worst:.1e}", $robot);
    }};
}

/// Of the largest acceleration of a state.
const LIMIT: f64 = 1e-12;

#[test]
fn ur5() {
    moves_as_given!(
        "ur5",
        [robots::ur5::Ur5, in_place::Ur5],
        hinges: [
            "shoulder_pan_joint" shoulder_pan_joint,
            "shoulder_lift_joint" shoulder_lift_joint,
            "elbow_joint" elbow_joint,
            "wrist_1_joint" wrist_1_joint,
            "wrist_2_joint" wrist_2_joint,
            "wrist_3_joint" wrist_3_joint
        ],
        slides: [],
        efforts: [
            "shoulder_pan_joint" shoulder_pan_torque,
            "shoulder_lift_joint" shoulder_lift_torque,
            "elbow_joint" elbow_torque,
            "wrist_1_joint" wrist_1_torque,
            "wrist_2_joint" wrist_2_torque,
            "wrist_3_joint" wrist_3_torque
        ]
    );
}

/// Seven hinges with damping, and two fingers of which one mimics the other.
#[test]
fn panda() {
    moves_as_given!(
        "panda",
        [robots::panda::Panda, in_place::Panda],
        hinges: [
            "panda_joint1" panda_joint1,
            "panda_joint2" panda_joint2,
            "panda_joint3" panda_joint3,
            "panda_joint4" panda_joint4,
            "panda_joint5" panda_joint5,
            "panda_joint6" panda_joint6,
            "panda_joint7" panda_joint7
        ],
        slides: [
            "panda_finger_joint1" panda_finger_joint1,
            "panda_finger_joint2" panda_finger_joint2
        ],
        efforts: [
            "panda_joint1" panda_joint1_torque,
            "panda_joint2" panda_joint2_torque,
            "panda_joint3" panda_joint3_torque,
            "panda_joint4" panda_joint4_torque,
            "panda_joint5" panda_joint5_torque,
            "panda_joint6" panda_joint6_torque,
            "panda_joint7" panda_joint7_torque,
            "panda_finger_joint1" panda_finger_joint1_force
        ]
    );
}

#[test]
fn so100() {
    moves_as_given!(
        "so100",
        [robots::so100::SoArm100, in_place::SoArm100],
        hinges: [
            "shoulder_pan" shoulder_pan,
            "shoulder_lift" shoulder_lift,
            "elbow_flex" elbow_flex,
            "wrist_flex" wrist_flex,
            "wrist_roll" wrist_roll,
            "gripper" gripper_joint
        ],
        slides: [],
        efforts: [
            "shoulder_pan" shoulder_pan_torque,
            "shoulder_lift" shoulder_lift_torque,
            "elbow_flex" elbow_flex_torque,
            "wrist_flex" wrist_flex_torque,
            "wrist_roll" wrist_roll_torque,
            "gripper" gripper_torque
        ]
    );
}

#[test]
fn double_pendulum() {
    moves_as_given!(
        "double_pendulum",
        [robots::double_pendulum::Robot2dofPlanar, in_place::Robot2dofPlanar],
        hinges: ["joint1" joint1, "joint2" joint2],
        slides: [],
        efforts: ["joint1" joint1_torque, "joint2" joint2_torque]
    );
}

/// A cart on a plane, hinges and slides that mimic others, and a load that floats with a flag. All
/// but cart, load and flag move, with efforts on what mimics none.
#[test]
fn crane() {
    moves_as_given!(
        "crane",
        [robots::crane::Crane, in_place::Crane],
        hinges: [
            "type" type_joint,
            "pulley" pulley_joint,
            "drum" drum_joint,
            "flag" flag_joint
        ],
        slides: ["boom" boom_joint, "tip" tip_joint],
        efforts: ["type" type_torque, "boom" boom_force, "flag" flag_torque]
    );
}

/// A link that is fixed to another one is a named point, and has its frame as a constant: both are
/// the same place, wherever the body is.
#[test]
fn links_that_are_fixed_are_points() -> Result<(), Fault> {
    type Panda = in_place::Panda;
    let (panda, h) = (Panda::default(), Panda::HANDLES);
    let mut state = panda.described_state::<f64>()?;
    let joints = [
        h.panda_joint1,
        h.panda_joint2,
        h.panda_joint6,
        h.panda_joint7,
    ];
    for (joint, angle) in joints.into_iter().zip([0.4, -0.3, 0.5, 1.1]) {
        panda.set_angle(&mut state, joint, angle)?;
    }
    let view = panda.view(0.0, &state)?;
    for (point, origin) in [
        (h.panda_link8, Panda::PANDA_LINK8_ORIGIN),
        (h.panda_hand_tcp, Panda::PANDA_HAND_TCP_ORIGIN),
    ] {
        let off = view.position(point) - view.point(h.panda_link7, origin.into());
        assert!(off.norm() < 1e-14, "{}: {off}", point.name());
    }
    // From the flange to between the fingers, as the file says.
    let hand = view.position(h.panda_hand_tcp) - view.position(h.panda_hand);
    assert!((hand.norm() - 0.1034).abs() < 1e-14, "{hand}");
    Ok(())
}

/// With an offset the reference configuration, with all joints at zero, violates the equation.
#[test]
fn a_gripper_is_assembled() -> Result<(), Fault> {
    let gripper = robots::gripper::Gripper::default();
    let handles = robots::gripper::Gripper::HANDLES;
    let mut state = gripper.described_state::<f64>()?;
    gripper.set_angle(&mut state, handles.left_joint, 0.4)?;
    let correction = gripper.assemble(0.0, &mut state)?;
    assert!(correction.violation_before > 0.01 && correction.violation_after < 1e-24);
    let dynamics = Dynamics::new(&gripper, StandardLagrange)?.absolute_coordinates();
    let view = dynamics.view(0.0, &state);
    let angles =
        [handles.left_joint, handles.right_joint, handles.tip_joint].map(|j| view.angle(j));
    let [left, right, tip] = angles;
    assert!((right - (0.3 - left)).abs() < 1e-12, "{angles:?}");
    assert!((tip - (0.5 * left - 0.1)).abs() < 1e-12, "{angles:?}");
    Ok(())
}
