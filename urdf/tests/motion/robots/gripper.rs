// The robot `gripper` of `gripper.urdf`, printed by holonom-urdf 0.1.0. Read it and change it:
// nothing here is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::Revolute;
use holonom::prelude::*;

holonom::joint! {
    /// A joint from `j` to `k` follows one from `i` to `j`: its angle (rad) is `multiplier` times
    /// the angle (rad) of the other, plus `offset`. The joints themselves are other fields.
    pub joint TurnMimicsTurnBefore(
        i, j, k;
        axis: Axis,
        leader_axis: Axis,
        multiplier: Number,
        offset: Number = 0.0
    ) {
        let leader = angle(i, j, leader_axis);
        angle(j, k, axis) - multiplier * leader - offset;
    }
}

holonom::joint! {
    /// A joint from `i` to `k` follows one from `i` to `j`: its angle (rad) is `multiplier` times
    /// the angle (rad) of the other, plus `offset`. The joints themselves are other fields.
    pub joint TurnMimicsTurnBeside(
        i, j, k;
        axis: Axis,
        leader_axis: Axis,
        multiplier: Number,
        offset: Number = 0.0
    ) {
        let leader = angle(i, j, leader_axis);
        angle(i, k, axis) - multiplier * leader - offset;
    }
}

/// The robot `gripper`, with all joints at zero in the reference configuration.
///
/// The ground is the link `palm`. Bodies have the axes of their links.
///
/// A joint that mimics with an offset is not satisfied with all joints at zero: start with
/// `assembled`, or call `assemble`.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Gripper {
    /// Link `left`.
    #[body(mass = 0.05, inertia = [1e-5, 1e-5, 2e-6], position = [0.0, 0.03, 0.02])]
    left: Body,
    /// Joint `left`, revolute: from -1 to 1 rad, at most 5 rad/s, at most 2 N m.
    #[joint(
        between = [ground, left],
        point = [0.0, 0.03, 0.0],
        axis = [1.0, 0.0, 0.0],
        limits = [-1.0, 1.0]
    )]
    left_joint: Revolute,
    /// Effort of `left` (N m), on `left`.
    #[input]
    pub left_torque: f64,
    #[force(between = [ground, left], axis = [1.0, 0.0, 0.0], moment = left_torque)]
    left_motor: TorsionalActuator,
    /// Link `tip`.
    #[body(mass = 0.02, inertia = [2e-6, 2e-6, 1e-6], position = [0.0, 0.03, 0.05])]
    tip: Body,
    /// Joint `tip`, revolute: from -1 to 1 rad, at most 5 rad/s, at most 2 N m.
    #[joint(
        between = [left, tip],
        point = [0.0, 0.03, 0.04],
        axis = [1.0, 0.0, 0.0],
        limits = [-1.0, 1.0]
    )]
    tip_joint: Revolute,
    /// `tip` mimics `left`: its position is 0.5 times that of the other, plus -0.1.
    #[joint(
        between = [ground, left, tip],
        axis = [1.0, 0.0, 0.0],
        leader_axis = [1.0, 0.0, 0.0],
        multiplier = 0.5,
        offset = -0.1
    )]
    tip_mimic: TurnMimicsTurnBefore,
    /// Link `right`.
    #[body(mass = 0.05, inertia = [1e-5, 1e-5, 2e-6], position = [0.0, -0.03, 0.02])]
    right: Body,
    /// Joint `right`, revolute: from -1 to 1 rad, at most 5 rad/s, at most 2 N m.
    #[joint(
        between = [ground, right],
        point = [0.0, -0.03, 0.0],
        axis = [1.0, 0.0, 0.0],
        limits = [-1.0, 1.0]
    )]
    right_joint: Revolute,
    /// `right` mimics `left`: its position is -1.0 times that of the other, plus 0.3.
    #[joint(
        between = [ground, left, right],
        axis = [1.0, 0.0, 0.0],
        leader_axis = [1.0, 0.0, 0.0],
        multiplier = -1.0,
        offset = 0.3
    )]
    right_mimic: TurnMimicsTurnBeside,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl Gripper {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 3] = [
        "left",
        "tip",
        "right",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 3] = [
        [-1.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 1.0],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 3] = [
        5.0,
        5.0,
        5.0,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 3] = [
        2.0,
        2.0,
        2.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl Gripper {
    /// Link `palm`, on the ground.
    pub const PALM_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `left`, on `left`.
    pub const LEFT_ORIGIN: [f64; 3] = [0.0, 0.0, -0.02];
    /// Link `right`, on `right`.
    pub const RIGHT_ORIGIN: [f64; 3] = [0.0, 0.0, -0.02];
    /// Link `tip`, on `tip`.
    pub const TIP_ORIGIN: [f64; 3] = [0.0, 0.0, -0.01];
}
