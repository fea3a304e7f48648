// The robot `2dof_planar` of `double_pendulum.urdf`, printed by holonom-urdf 0.1.0. Read it and
// change it: nothing here is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::Revolute;
use holonom::prelude::*;

/// The robot `2dof_planar`, with all joints at zero in the reference configuration.
///
/// The ground is the link `base_link`. Its mass of 0.10159 kg has no effect. Bodies have the axes
/// of their links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Robot2dofPlanar {
    /// Link `link1`.
    // Visuals that are not drawn: `link1.stl`.
    #[body(
        mass = 0.26703,
        inertia = [
            [0.00040827, 1.2675e-9, 1.8738e-5],
            [1.2675e-9, 0.00038791, 3.5443e-8],
            [1.8738e-5, 3.5443e-8, 3.6421e-5],
        ],
        position = [0.0146979, 2.1727e-6, 0.071012]
    )]
    link1: Body,
    /// Joint `joint1`, continuous: at most 0 rad/s, at most 0 N m.
    #[joint(between = [ground, link1], point = [0.0060872, 0.0, 0.035], axis = [1.0, 0.0, 0.0])]
    joint1: Revolute,
    /// Effort of `joint1` (N m), on `link1`.
    #[input]
    pub joint1_torque: f64,
    #[force(
        between = [ground, link1],
        axis = [1.0, 0.0, 0.0],
        moment = joint1_torque - 0.05 * rate
    )]
    joint1_motor: TorsionalActuator,
    /// Link `link2`.
    // Visuals that are not drawn: `link2.stl`.
    #[body(
        mass = 0.33238,
        inertia = [
            [0.0011753, -3.854e-13, -2.9304e-8],
            [-3.854e-13, 0.0011666, -5.2365e-12],
            [-2.9304e-8, -5.2365e-12, 1.4553e-5],
        ],
        position = [0.0240765, 1.9371e-10, 0.23588]
    )]
    link2: Body,
    /// Joint `joint2`, continuous: at most 0 rad/s, at most 0 N m.
    #[joint(between = [link1, link2], point = [0.0290872, 0.0, 0.135], axis = [1.0, 0.0, 0.0])]
    joint2: Revolute,
    /// Effort of `joint2` (N m), on `link2`.
    #[input]
    pub joint2_torque: f64,
    #[force(between = [link1, link2], axis = [1.0, 0.0, 0.0], moment = joint2_torque - 0.05 * rate)]
    joint2_motor: TorsionalActuator,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl Robot2dofPlanar {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 2] = [
        "joint1",
        "joint2",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 2] = [
        [f64::NEG_INFINITY, f64::INFINITY],
        [f64::NEG_INFINITY, f64::INFINITY],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 2] = [
        0.0,
        0.0,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 2] = [
        0.0,
        0.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl Robot2dofPlanar {
    /// Link `base_link`, on the ground.
    pub const BASE_LINK_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `link1`, on `link1`.
    pub const LINK1_ORIGIN: [f64; 3] = [-0.0086107, -2.1727e-6, -0.036012];
    /// Link `link2`, on `link2`.
    pub const LINK2_ORIGIN: [f64; 3] = [0.0050107, -1.9371e-10, -0.10088];
}
