//! Inverse dynamics by joints: arms whose every hinge is driven by a law of parameters take the
//! torques that Pinocchio makes of them move as they do.

use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;
use holonom::{JointCoordinates, JointHandle, dynamics::Dynamics, state::Array};

#[path = "references/arms/data.rs"]
mod data;

/// What is known of an arm of `N` joints. Of it only the states are used here.
#[allow(dead_code, reason = "the data are shared with another test")]
struct Reference<const N: usize> {
    points: [[f64; 3]; N],
    axes: [[f64; 3]; N],
    centres: [[f64; 3]; N],
    states: [State<N>; 5],
    later: [[f64; N]; 2],
}

/// Angles (rad), rates (rad/s), torques (N m), accelerations (rad/s^2).
#[allow(dead_code, reason = "the data are shared with another test")]
struct State<const N: usize> {
    angles: [f64; N],
    rates: [f64; N],
    torques: [f64; N],
    accelerations: [f64; N],
    force: [f64; 3],
    moment: [f64; 3],
    last_centre: [f64; 3],
    energies: [f64; 2],
}

/// Ur5 with a driver in every hinge, whose laws the macro cannot see.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct DrivenUr5 {
    #[param]
    angles: [f64; 6],
    #[param]
    rates: [f64; 6],
    #[param]
    accelerations: [f64; 6],
    #[body(
        mass = 3.7,
        inertia = [
            [0.010267495893, 0.0, 0.0],
            [0.0, 0.010267495893, 0.0],
            [0.0, 0.0, 0.00666],
        ],
        position = [0.0, 0.0, 0.089159]
    )]
    shoulder: Body,
    #[joint(between = [ground, shoulder], point = [0.0, 0.0, 0.089159], axis = [0.0, 0.0, 1.0])]
    pan: Revolute,
    #[joint(between = [ground, shoulder], axis = [0.0, 0.0, 1.0], motion = angles[0] + rates[0] * time + 0.5 * accelerations[0] * time * time)]
    driver_1: AngleDriver,
    #[body(
        mass = 8.393,
        inertia = [
            [0.0151074, 0.0, -1.0370261742676579e-12],
            [0.0, 0.22689067591, 0.0],
            [-1.0370261742676579e-12, 0.0, 0.22689067591],
        ],
        position = [0.28, 0.13585, 0.08915900000137106]
    )]
    upper_arm: Body,
    #[joint(between = [shoulder, upper_arm], point = [0.0, 0.13585, 0.089159], axis = [0.0, 1.0, 0.0])]
    lift: Revolute,
    #[joint(between = [shoulder, upper_arm], axis = [0.0, 1.0, 0.0], motion = angles[1] + rates[1] * time + 0.5 * accelerations[1] * time * time)]
    driver_2: AngleDriver,
    #[body(
        mass = 2.275,
        inertia = [
            [0.004095, 0.0, -2.2205430487558295e-13],
            [0.0, 0.049443313556, 0.0],
            [-2.2205430487558295e-13, 0.0, 0.049443313556],
        ],
        position = [0.6749999999999999, 0.016149999999999998, 0.08915900000330523]
    )]
    forearm: Body,
    #[joint(between = [upper_arm, forearm], point = [0.425, 0.016149999999999998, 0.08915900000208107], axis = [0.0, 1.0, 0.0])]
    elbow: Revolute,
    #[joint(between = [upper_arm, forearm], axis = [0.0, 1.0, 0.0], motion = angles[2] + rates[2] * time + 0.5 * accelerations[2] * time * time)]
    driver_3: AngleDriver,
    #[body(
        mass = 1.219,
        inertia = [
            [0.111172755531, 0.0, -1.0600952820694607e-12],
            [0.0, 0.111172755531, 0.0],
            [-1.060095282069461e-12, 0.0, 0.21942],
        ],
        position = [0.81725, 0.016149999999999998, 0.08915900000400177]
    )]
    first_wrist: Body,
    #[joint(between = [forearm, first_wrist], point = [0.81725, 0.016149999999999998, 0.08915900000400177], axis = [0.0, 1.0, 0.0])]
    wrist_1: Revolute,
    #[joint(between = [forearm, first_wrist], axis = [0.0, 1.0, 0.0], motion = angles[3] + rates[3] * time + 0.5 * accelerations[3] * time * time)]
    driver_4: AngleDriver,
    #[body(
        mass = 1.219,
        inertia = [
            [0.111172755531, 0.0, -1.0600952820694607e-12],
            [0.0, 0.111172755531, 0.0],
            [-1.060095282069461e-12, 0.0, 0.21942],
        ],
        position = [0.81725, 0.10915, 0.08915900000400177]
    )]
    second_wrist: Body,
    #[joint(between = [first_wrist, second_wrist], point = [0.81725, 0.10915, 0.08915900000400177], axis = [9.793277300218506e-12, 0.0, -1.0])]
    wrist_2: Revolute,
    #[joint(between = [first_wrist, second_wrist], axis = [9.793277300218506e-12, 0.0, -1.0], motion = angles[4] + rates[4] * time + 0.5 * accelerations[4] * time * time)]
    driver_5: AngleDriver,
    #[body(
        mass = 0.1879,
        inertia = [
            [0.0171364731454, 0.0, -1.6340599138734045e-13],
            [0.0, 0.0171364731454, 0.0],
            [-1.6340599138734045e-13, 0.0, 0.033822],
        ],
        position = [0.817250000000927, 0.10915, -0.005490999995998225]
    )]
    third_wrist: Body,
    #[joint(between = [second_wrist, third_wrist], point = [0.817250000000927, 0.10915, -0.005490999995998225], axis = [0.0, 1.0, 0.0])]
    wrist_3: Revolute,
    #[joint(between = [second_wrist, third_wrist], axis = [0.0, 1.0, 0.0], motion = angles[5] + rates[5] * time + 0.5 * accelerations[5] * time * time)]
    driver_6: AngleDriver,
}

/// Panda with a driver in every hinge, whose laws the macro cannot see.
#[derive(Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
struct DrivenPanda {
    #[param]
    angles: [f64; 7],
    #[param]
    rates: [f64; 7],
    #[param]
    accelerations: [f64; 7],
    #[body(
        mass = 4.970684,
        inertia = [
            [0.70337, -0.000139, 0.006772],
            [-0.000139, 0.70661, 0.019169],
            [0.006772, 0.019169, 0.009117],
        ],
        position = [0.003875, 0.002081, 0.28538]
    )]
    link_1: Body,
    #[joint(between = [ground, link_1], point = [0.0, 0.0, 0.333], axis = [0.0, 0.0, 1.0])]
    joint_1: Revolute,
    #[joint(between = [ground, link_1], axis = [0.0, 0.0, 1.0], motion = angles[0] + rates[0] * time + 0.5 * accelerations[0] * time * time)]
    driver_1: AngleDriver,
    #[body(
        mass = 0.646926,
        inertia = [
            [0.007962, 0.010253999999999997, 0.003925000000000002],
            [0.010253999999999997, 0.025995, -0.0007040000000000005],
            [0.003925000000000002, -0.0007040000000000005, 0.02811],
        ],
        position = [-0.003141, 0.0034949999999999933, 0.36172000000000004]
    )]
    link_2: Body,
    #[joint(between = [link_1, link_2], point = [0.0, 0.0, 0.333], axis = [0.0, 1.0, 0.0])]
    joint_2: Revolute,
    #[joint(between = [link_1, link_2], axis = [0.0, 1.0, 0.0], motion = angles[1] + rates[1] * time + 0.5 * accelerations[1] * time * time)]
    driver_2: AngleDriver,
    #[body(
        mass = 3.228604,
        inertia = [
            [0.037242, -0.004761, -0.011396],
            [-0.004761, 0.036155, -0.012805],
            [-0.011396, -0.012805, 0.01083],
        ],
        position = [0.027518, 0.03925199999999993, 0.582498]
    )]
    link_3: Body,
    #[joint(between = [link_2, link_3], point = [0.0, 0.0, 0.649], axis = [0.0, 0.0, 1.0])]
    joint_3: Revolute,
    #[joint(between = [link_2, link_3], axis = [0.0, 0.0, 1.0], motion = angles[2] + rates[2] * time + 0.5 * accelerations[2] * time * time)]
    driver_3: AngleDriver,
    #[body(
        mass = 3.587895,
        inertia = [
            [0.025853, 0.0013320000000000018, 0.007796],
            [0.0013320000000000018, 0.028322999999999994, -0.008641000000000001],
            [0.007796, -0.008641000000000001, 0.019552000000000007],
        ],
        position = [0.029330000000000023, -0.027454000000000034, 0.753419]
    )]
    link_4: Body,
    #[joint(between = [link_3, link_4], point = [0.0825, 0.0, 0.649], axis = [0.0, -1.0, 0.0])]
    joint_4: Revolute,
    #[joint(between = [link_3, link_4], axis = [0.0, -1.0, 0.0], motion = angles[3] + rates[3] * time + 0.5 * accelerations[3] * time * time)]
    driver_4: AngleDriver,
    #[body(
        mass = 1.225946,
        inertia = [
            [0.035549, -0.002117, -0.004037],
            [-0.002117, 0.029474, 0.000229],
            [-0.004037, 0.000229, 0.008627],
        ],
        position = [-0.011953, 0.04106500000000001, 0.9945629999999999]
    )]
    link_5: Body,
    #[joint(between = [link_4, link_5], point = [0.0, 0.0, 1.033], axis = [0.0, 0.0, 1.0])]
    joint_5: Revolute,
    #[joint(between = [link_4, link_5], axis = [0.0, 0.0, 1.0], motion = angles[4] + rates[4] * time + 0.5 * accelerations[4] * time * time)]
    driver_5: AngleDriver,
    #[body(
        mass = 1.666555,
        inertia = [
            [0.0019640000000000005, 0.001158, 0.00010899999999999975],
            [0.001158, 0.005433, -0.0003410000000000002],
            [0.00010899999999999975, -0.0003410000000000002, 0.004354],
        ],
        position = [0.060149, 0.010517000000000012, 1.018883]
    )]
    link_6: Body,
    #[joint(between = [link_5, link_6], point = [0.0, 0.0, 1.033], axis = [0.0, -1.0, 0.0])]
    joint_6: Revolute,
    #[joint(between = [link_5, link_6], axis = [0.0, -1.0, 0.0], motion = angles[5] + rates[5] * time + 0.5 * accelerations[5] * time * time)]
    driver_6: AngleDriver,
    #[body(
        mass = 1.4955219999999998,
        inertia = [
            [0.016529853712634626, -0.0003948922971191774, 0.0007066957106145019],
            [-0.0003948922971191774, 0.014107248642161839, -0.0010511053270467112],
            [0.0007066957106145019, -0.0010511053270467112, 0.006676955556640957],
        ],
        position = [0.08972087429762865, -0.0013603544171612596, 0.9325147188513441]
    )]
    hand: Body,
    #[joint(between = [link_6, hand], point = [0.088, 0.0, 1.033], axis = [0.0, 0.0, -1.0])]
    joint_7: Revolute,
    #[joint(between = [link_6, hand], axis = [0.0, 0.0, -1.0], motion = angles[6] + rates[6] * time + 0.5 * accelerations[6] * time * time)]
    driver_7: AngleDriver,
}

/// The state of an arm at its angles and rates.
fn set<M: Mechanism, const N: usize>(
    arm: &M,
    joints: [JointHandle<M, Revolute>; N],
    given: &State<N>,
) -> M::State<f64> {
    let mut state = arm.described_state().expect("sound");
    for (k, joint) in joints.into_iter().enumerate() {
        arm.set_angle(&mut state, joint, given.angles[k])
            .expect("a hinge of the tree");
    }
    for (k, joint) in joints.into_iter().enumerate() {
        arm.set_angle_rate(&mut state, joint, given.rates[k])
            .expect("a hinge of the tree");
    }
    state
}

/// Compares what the drivers exert, by joint coordinates alone and in a run of no length.
fn holds<M: JointCoordinates, const N: usize>(
    arm: &M,
    state: &M::State<f64>,
    drivers: [JointHandle<M, AngleDriver>; N],
    given: &State<N>,
) {
    /// Of the largest torque.
    const ASKED: f64 = 1e-11;
    let largest = given
        .torques
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.abs()));
    let off = |found: &[f64]| {
        assert_eq!(found.len(), N);
        let pairs = found.iter().zip(&given.torques);
        pairs.fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / largest
    };
    let dynamics = Dynamics::new(arm, StandardLagrange)
        .expect("sound")
        .joint_coordinates();
    let joints = dynamics.state_of(state).expect("closed");
    let (evaluation, _) = dynamics.evaluate(0.0, &joints).expect("regular");
    let efforts: Vec<f64> = evaluation
        .multipliers
        .as_slice()
        .iter()
        .map(|x| -x)
        .collect();
    assert!(off(&efforts) < ASKED, "{efforts:?}, {:e}", off(&efforts));

    let mut efforts = [0.0; N];
    Simulation::new(arm, StandardLagrange, Rk4::every(0.01))
        .initial_state(*state)
        .joint_coordinates()
        .run(0.0..=0.0, every(1.0), |sample| {
            efforts = drivers.map(|driver| sample.driving_effort(driver).expect("solvable"));
            ControlFlow::Continue(())
        })
        .expect("regular");
    assert!(off(&efforts) < ASKED, "{efforts:?}, {:e}", off(&efforts));
}

#[test]
fn torques_of_ur5() {
    let handles = DrivenUr5::HANDLES;
    let joints = [
        handles.pan,
        handles.lift,
        handles.elbow,
        handles.wrist_1,
        handles.wrist_2,
        handles.wrist_3,
    ];
    let drivers = [
        handles.driver_1,
        handles.driver_2,
        handles.driver_3,
        handles.driver_4,
        handles.driver_5,
        handles.driver_6,
    ];
    for given in data::UR5.states {
        let arm = DrivenUr5::new(given.angles, given.rates, given.accelerations).expect("sound");
        let state = set(&arm, joints, &given);
        holds(&arm, &state, drivers, &given);
    }
}

#[test]
fn torques_of_panda() {
    let handles = DrivenPanda::HANDLES;
    let joints = [
        handles.joint_1,
        handles.joint_2,
        handles.joint_3,
        handles.joint_4,
        handles.joint_5,
        handles.joint_6,
        handles.joint_7,
    ];
    let drivers = [
        handles.driver_1,
        handles.driver_2,
        handles.driver_3,
        handles.driver_4,
        handles.driver_5,
        handles.driver_6,
        handles.driver_7,
    ];
    for given in data::PANDA.states {
        let arm = DrivenPanda::new(given.angles, given.rates, given.accelerations).expect("sound");
        let state = set(&arm, joints, &given);
        holds(&arm, &state, drivers, &given);
    }
}
