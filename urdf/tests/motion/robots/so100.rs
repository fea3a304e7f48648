// The robot `so_arm100` of `so100.urdf`, printed by holonom-urdf 0.1.0. Read it and change it:
// nothing here is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::Revolute;
use holonom::prelude::*;

/// The robot `so_arm100`, with all joints at zero in the reference configuration.
///
/// The ground is the link `base`. Its mass of 1.0 kg has no effect. Bodies have the axes of their
/// links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct SoArm100 {
    /// Link `shoulder`.
    // Visuals that are not drawn: `Rotation_Pitch.stl` and `Rotation_Pitch_Motor.stl`.
    #[body(
        mass = 0.119226,
        inertia = [5.94278e-5, 5.89975e-5, 3.13712e-5],
        position = [-9.07886e-5, -0.0762886261035144, 0.07559739669254376],
        orientation = [0.7071090180427968, 0.707104544323222, 0.0, 0.0]
    )]
    shoulder: Body,
    /// Joint `shoulder_pan`, revolute: from -2 to 2 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [ground, shoulder],
        point = [0.0, -0.0452, 0.0165],
        axis = [0.0, 6.326794896668469e-6, 0.9999999999799858],
        limits = [-2.0, 2.0]
    )]
    shoulder_pan: Revolute,
    /// Effort of `shoulder_pan` (N m), on `shoulder`.
    #[input]
    pub shoulder_pan_torque: f64,
    #[force(
        between = [ground, shoulder],
        axis = [0.0, 6.326794896668469e-6, 0.9999999999799858],
        moment = shoulder_pan_torque
    )]
    shoulder_pan_motor: TorsionalActuator,
    /// Link `upper_arm`.
    // Visuals that are not drawn: `Upper_Arm.stl` and `Upper_Arm_Motor.stl`.
    #[body(
        mass = 0.162409,
        inertia = [0.000213312, 0.000167164, 7.01522e-5],
        position = [-1.72052e-5, -0.006749047002358927, 0.10607890340983055],
        orientation = [0.9934400317577431, -0.11435428851238766, 0.0, 0.0]
    )]
    upper_arm: Body,
    /// Joint `shoulder_lift`, revolute: from 0 to 3.5 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [shoulder, upper_arm],
        point = [0.0, -0.07579935150291066, 0.11900019359787238],
        axis = [1.0, 0.0, 0.0],
        limits = [0.0, 3.5]
    )]
    shoulder_lift: Revolute,
    /// Effort of `shoulder_lift` (N m), on `upper_arm`.
    #[input]
    pub shoulder_lift_torque: f64,
    #[force(between = [shoulder, upper_arm], axis = [1.0, 0.0, 0.0], moment = shoulder_lift_torque)]
    shoulder_lift_motor: TorsionalActuator,
    /// Link `lower_arm`.
    // Visuals that are not drawn: `Lower_Arm.stl` and `Lower_Arm_Motor.stl`.
    #[body(
        mass = 0.147968,
        inertia = [0.000138803, 0.000107748, 4.84242e-5],
        position = [-0.00339604, -0.034290520907746494, 0.1394831990543949],
        orientation = [0.7833308424105808, 0.6216050123095291, 0.0, 0.0]
    )]
    lower_arm: Body,
    /// Joint `elbow_flex`, revolute: from -3.14158 to 0 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [upper_arm, lower_arm],
        point = [0.0, 0.04018834565650026, 0.12069105363252441],
        axis = [1.0, 0.0, 0.0],
        limits = [-3.14158, 0.0]
    )]
    elbow_flex: Revolute,
    /// Effort of `elbow_flex` (N m), on `lower_arm`.
    #[input]
    pub elbow_flex_torque: f64,
    #[force(between = [upper_arm, lower_arm], axis = [1.0, 0.0, 0.0], moment = elbow_flex_torque)]
    elbow_flex_motor: TorsionalActuator,
    /// Link `wrist`.
    // Visuals that are not drawn: `Wrist_Pitch_Roll.stl` and `Wrist_Pitch_Roll_Motor.stl`.
    #[body(
        mass = 0.0661321,
        inertia = [3.45403e-5, 2.39041e-5, 1.94704e-5],
        position = [-0.00852653, -0.1231866013783251, 0.14458365550478505],
        orientation = [0.9854508053159896, 0.16996090815851658, 0.0, 0.0]
    )]
    wrist: Body,
    /// Joint `wrist_flex`, revolute: from -2.5 to 1.2 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [lower_arm, wrist],
        point = [0.0, -0.09000179694127353, 0.15640627126270726],
        axis = [1.0, 0.0, 0.0],
        limits = [-2.5, 1.2]
    )]
    wrist_flex: Revolute,
    /// Effort of `wrist_flex` (N m), on `wrist`.
    #[input]
    pub wrist_flex_torque: f64,
    #[force(between = [lower_arm, wrist], axis = [1.0, 0.0, 0.0], moment = wrist_flex_torque)]
    wrist_flex_motor: TorsionalActuator,
    /// Link `gripper`.
    // Visuals that are not drawn: `Fixed_Jaw.stl` and `Fixed_Jaw_Motor.stl`.
    #[body(
        mass = 0.0929859,
        inertia = [5.03136e-5, 4.64098e-5, 2.72961e-5],
        position = [0.00048361794775016783, -0.17117736315791374, 0.12168463147554764],
        orientation = [0.6968211512764726, 0.12018089087363062, 0.696816742645915, 0.12018013051618885]
    )]
    gripper: Body,
    /// Joint `wrist_roll`, revolute: from -3.14158 to 3.14158 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [wrist, gripper],
        point = [0.0, -0.14662961436296498, 0.1362741999818982],
        axis = [0.0, 0.9422265793958646, 0.3349762276340942],
        limits = [-3.14158, 3.14158]
    )]
    wrist_roll: Revolute,
    /// Effort of `wrist_roll` (N m), on `gripper`.
    #[input]
    pub wrist_roll_torque: f64,
    #[force(
        between = [wrist, gripper],
        axis = [0.0, 0.9422265793958646, 0.3349762276340942],
        moment = wrist_roll_torque
    )]
    wrist_roll_motor: TorsionalActuator,
    /// Link `jaw`.
    // Visuals that are not drawn: `Moving_Jaw.stl`.
    #[body(
        mass = 0.0202444,
        inertia = [1.11265e-5, 8.99651e-6, 2.99548e-6],
        position = [-0.0004497431013527039, -0.20443868521306907, 0.1354441204362029],
        orientation = [0.696812333987465, 0.1201793701539365, -0.6968255598791376, -0.12018165122626173]
    )]
    jaw: Body,
    /// Joint `gripper`, revolute: from -0.2 to 2 rad, at most 1 rad/s, at most 35 N m.
    #[joint(
        between = [gripper, jaw],
        point = [-1.2780125691270306e-7, -0.17638646269829736, 0.14713375693104183],
        axis = [-0.9999999998198725, 6.357977662162594e-6, -1.7883822941126954e-5],
        limits = [-0.2, 2.0]
    )]
    gripper_joint: Revolute,
    /// Effort of `gripper` (N m), on `jaw`.
    #[input]
    pub gripper_torque: f64,
    #[force(
        between = [gripper, jaw],
        axis = [-0.9999999998198725, 6.357977662162594e-6, -1.7883822941126954e-5],
        moment = gripper_torque
    )]
    gripper_motor: TorsionalActuator,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl SoArm100 {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 6] = [
        "shoulder_pan",
        "shoulder_lift",
        "elbow_flex",
        "wrist_flex",
        "wrist_roll",
        "gripper",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 6] = [
        [-2.0, 2.0],
        [0.0, 3.5],
        [-3.14158, 0.0],
        [-2.5, 1.2],
        [-3.14158, 3.14158],
        [-0.2, 2.0],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 6] = [
        1.0,
        1.0,
        1.0,
        1.0,
        1.0,
        1.0,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 6] = [
        35.0,
        35.0,
        35.0,
        35.0,
        35.0,
        35.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl SoArm100 {
    /// Link `base`, on the ground.
    pub const BASE_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `shoulder`, on `shoulder`.
    pub const SHOULDER_ORIGIN: [f64; 3] = [9.07886e-5, -0.0590972, -0.031089];
    /// Link `upper_arm`, on `upper_arm`.
    pub const UPPER_ARM_ORIGIN: [f64; 3] = [1.72052e-5, -0.0701802, -0.00310545];
    /// Link `lower_arm`, on `lower_arm`.
    pub const LOWER_ARM_ORIGIN: [f64; 3] = [0.00339604, -0.00137796, -0.0768007];
    /// Link `wrist`, on `wrist`.
    pub const WRIST_ORIGIN: [f64; 3] = [0.00852653, 0.0352279, 2.34622e-5];
    /// Link `gripper`, on `gripper`.
    pub const GRIPPER_ORIGIN: [f64; 3] = [-0.00552377, 0.0280167, -0.000483583];
    /// Link `jaw`, on `jaw`.
    pub const JAW_ORIGIN: [f64; 3] = [0.00161745, 0.0303473, -0.000449646];
}
