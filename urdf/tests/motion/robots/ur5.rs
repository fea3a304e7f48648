// The robot `ur5` of `ur5.urdf`, printed by holonom-urdf 0.1.0. Read it and change it: nothing here
// is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::Revolute;
use holonom::prelude::*;

/// The robot `ur5`, with all joints at zero in the reference configuration.
///
/// The ground is the link `world`, with `base_link` and `base` fixed to it. Its mass of 4.0 kg has
/// no effect. Bodies have the axes of their links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Ur5 {
    /// Link `shoulder_link`.
    // Visuals that are not drawn: `shoulder.dae`.
    #[body(
        mass = 3.7,
        inertia = [0.010267495893, 0.010267495893, 0.00666],
        position = [0.0, 0.0, 0.089159]
    )]
    shoulder_link: Body,
    /// Joint `shoulder_pan_joint`, revolute: from -6.28318530718 to 6.28318530718 rad, at most 3.15
    /// rad/s, at most 150 N m.
    #[joint(
        between = [ground, shoulder_link],
        point = [0.0, 0.0, 0.089159],
        axis = [0.0, 0.0, 1.0],
        limits = [-6.28318530718, 6.28318530718]
    )]
    shoulder_pan_joint: Revolute,
    /// Effort of `shoulder_pan_joint` (N m), on `shoulder_link`.
    #[input]
    pub shoulder_pan_torque: f64,
    #[force(
        between = [ground, shoulder_link],
        axis = [0.0, 0.0, 1.0],
        moment = shoulder_pan_torque
    )]
    shoulder_pan_motor: TorsionalActuator,
    /// Link `upper_arm_link`.
    // Visuals that are not drawn: `upperarm.dae`.
    #[body(
        mass = 8.393,
        inertia = [0.22689067591, 0.22689067591, 0.0151074],
        position = [0.28, 0.13585, 0.08915900000137104],
        orientation = [0.7071067811882786, 0.0, 0.7071067811848163, 0.0]
    )]
    upper_arm_link: Body,
    /// Joint `shoulder_lift_joint`, revolute: from -6.28318530718 to 6.28318530718 rad, at most
    /// 3.15 rad/s, at most 150 N m.
    #[joint(
        between = [shoulder_link, upper_arm_link],
        point = [0.0, 0.13585, 0.089159],
        axis = [0.0, 1.0, 0.0],
        limits = [-6.28318530718, 6.28318530718]
    )]
    shoulder_lift_joint: Revolute,
    /// Effort of `shoulder_lift_joint` (N m), on `upper_arm_link`.
    #[input]
    pub shoulder_lift_torque: f64,
    #[force(
        between = [shoulder_link, upper_arm_link],
        axis = [0.0, 1.0, 0.0],
        moment = shoulder_lift_torque
    )]
    shoulder_lift_motor: TorsionalActuator,
    /// Link `forearm_link`.
    // Visuals that are not drawn: `forearm.dae`.
    #[body(
        mass = 2.275,
        inertia = [0.049443313556, 0.049443313556, 0.004095],
        position = [0.675, 0.016149999999999998, 0.08915900000330519],
        orientation = [0.7071067811882786, 0.0, 0.7071067811848163, 0.0]
    )]
    forearm_link: Body,
    /// Joint `elbow_joint`, revolute: from -3.14159265359 to 3.14159265359 rad, at most 3.15 rad/s,
    /// at most 150 N m.
    #[joint(
        between = [upper_arm_link, forearm_link],
        point = [0.425, 0.016149999999999998, 0.08915900000208105],
        axis = [0.0, 1.0, 0.0],
        limits = [-3.14159265359, 3.14159265359]
    )]
    elbow_joint: Revolute,
    /// Effort of `elbow_joint` (N m), on `forearm_link`.
    #[input]
    pub elbow_torque: f64,
    #[force(
        between = [upper_arm_link, forearm_link],
        axis = [0.0, 1.0, 0.0],
        moment = elbow_torque
    )]
    elbow_motor: TorsionalActuator,
    /// Link `wrist_1_link`.
    // Visuals that are not drawn: `wrist1.dae`.
    #[body(
        mass = 1.219,
        inertia = [0.111172755531, 0.111172755531, 0.21942],
        position = [0.81725, 0.016149999999999998, 0.08915900000400173],
        orientation = [4.8965888601467475e-12, 0.0, 1.0, 0.0]
    )]
    wrist_1_link: Body,
    /// Joint `wrist_1_joint`, revolute: from -6.28318530718 to 6.28318530718 rad, at most 3.2
    /// rad/s, at most 28 N m.
    #[joint(
        between = [forearm_link, wrist_1_link],
        point = [0.81725, 0.016149999999999998, 0.08915900000400173],
        axis = [0.0, 1.0, 0.0],
        limits = [-6.28318530718, 6.28318530718]
    )]
    wrist_1_joint: Revolute,
    /// Effort of `wrist_1_joint` (N m), on `wrist_1_link`.
    #[input]
    pub wrist_1_torque: f64,
    #[force(
        between = [forearm_link, wrist_1_link],
        axis = [0.0, 1.0, 0.0],
        moment = wrist_1_torque
    )]
    wrist_1_motor: TorsionalActuator,
    /// Link `wrist_2_link`.
    // Visuals that are not drawn: `wrist2.dae`.
    #[body(
        mass = 1.219,
        inertia = [0.111172755531, 0.111172755531, 0.21942],
        position = [0.81725, 0.10915, 0.08915900000400173],
        orientation = [4.8965888601467475e-12, 0.0, 1.0, 0.0]
    )]
    wrist_2_link: Body,
    /// Joint `wrist_2_joint`, revolute: from -6.28318530718 to 6.28318530718 rad, at most 3.2
    /// rad/s, at most 28 N m.
    #[joint(
        between = [wrist_1_link, wrist_2_link],
        point = [0.81725, 0.10915, 0.08915900000400173],
        axis = [9.793177720293495e-12, 0.0, -1.0],
        limits = [-6.28318530718, 6.28318530718]
    )]
    wrist_2_joint: Revolute,
    /// Effort of `wrist_2_joint` (N m), on `wrist_2_link`.
    #[input]
    pub wrist_2_torque: f64,
    #[force(
        between = [wrist_1_link, wrist_2_link],
        axis = [9.793177720293495e-12, 0.0, -1.0],
        moment = wrist_2_torque
    )]
    wrist_2_motor: TorsionalActuator,
    /// Link `wrist_3_link`, with `ee_link` and `tool0` fixed to it: mass, centre of mass and
    /// inertia are those of all.
    // Visuals that are not drawn: `wrist3.dae`.
    #[body(
        mass = 0.1879,
        inertia = [0.0171364731454, 0.0171364731454, 0.033822],
        position = [0.817250000000927, 0.10915, -0.005490999995998266],
        orientation = [4.8965888601467475e-12, 0.0, 1.0, 0.0]
    )]
    wrist_3_link: Body,
    /// Origin of link `ee_link`.
    #[point(on = wrist_3_link, at = [0.817250000000927, 0.19145, -0.005490999995998266])]
    ee_link: Point,
    /// Origin of link `tool0`.
    #[point(on = wrist_3_link, at = [0.817250000000927, 0.19145, -0.005490999995998266])]
    tool0: Point,
    /// Joint `wrist_3_joint`, revolute: from -6.28318530718 to 6.28318530718 rad, at most 3.2
    /// rad/s, at most 28 N m.
    #[joint(
        between = [wrist_2_link, wrist_3_link],
        point = [0.817250000000927, 0.10915, -0.005490999995998266],
        axis = [0.0, 1.0, 0.0],
        limits = [-6.28318530718, 6.28318530718]
    )]
    wrist_3_joint: Revolute,
    /// Effort of `wrist_3_joint` (N m), on `wrist_3_link`.
    #[input]
    pub wrist_3_torque: f64,
    #[force(
        between = [wrist_2_link, wrist_3_link],
        axis = [0.0, 1.0, 0.0],
        moment = wrist_3_torque
    )]
    wrist_3_motor: TorsionalActuator,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl Ur5 {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 6] = [
        "shoulder_pan_joint",
        "shoulder_lift_joint",
        "elbow_joint",
        "wrist_1_joint",
        "wrist_2_joint",
        "wrist_3_joint",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 6] = [
        [-6.28318530718, 6.28318530718],
        [-6.28318530718, 6.28318530718],
        [-3.14159265359, 3.14159265359],
        [-6.28318530718, 6.28318530718],
        [-6.28318530718, 6.28318530718],
        [-6.28318530718, 6.28318530718],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 6] = [
        3.15,
        3.15,
        3.15,
        3.2,
        3.2,
        3.2,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 6] = [
        150.0,
        150.0,
        150.0,
        28.0,
        28.0,
        28.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl Ur5 {
    /// Link `base_link`, on the ground.
    pub const BASE_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `shoulder_link`, on `shoulder_link`.
    pub const SHOULDER_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `upper_arm_link`, on `upper_arm_link`.
    pub const UPPER_ARM_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, -0.28];
    /// Link `forearm_link`, on `forearm_link`.
    pub const FOREARM_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, -0.25];
    /// Link `wrist_1_link`, on `wrist_1_link`.
    pub const WRIST_1_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `wrist_2_link`, on `wrist_2_link`.
    pub const WRIST_2_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `wrist_3_link`, on `wrist_3_link`.
    pub const WRIST_3_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `ee_link`, on `wrist_3_link`.
    pub const EE_LINK_ORIGIN: [f64; 3] = [0.0, 0.0823, 0.0];
    /// Axes of `ee_link`.
    pub const EE_LINK_AXES: [f64; 4] = [0.7071067811882786, 0.0, 0.0, 0.7071067811848163];
    /// Link `base`, on the ground.
    pub const BASE_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Axes of `base`.
    pub const BASE_AXES: [f64; 4] = [1.0341155355510722e-13, 0.0, 0.0, 1.0];
    /// Link `tool0`, on `wrist_3_link`.
    pub const TOOL0_ORIGIN: [f64; 3] = [0.0, 0.0823, 0.0];
    /// Axes of `tool0`.
    pub const TOOL0_AXES: [f64; 4] = [0.7071067811882786, -0.7071067811848163, 0.0, 0.0];
    /// Link `world`, on the ground.
    pub const WORLD_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
}
