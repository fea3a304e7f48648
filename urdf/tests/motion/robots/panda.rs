// The robot `panda` of `panda.urdf`, printed by holonom-urdf 0.1.0. Read it and change it: nothing
// here is bound to the file.

use holonom::forces::TorsionalActuator;
use holonom::joints::{Prismatic, Revolute};
use holonom::prelude::*;

holonom::force! {
    /// A motor of a slide: `force` (N) pushes `j` along `axis`, and `i` the opposite way. It is an
    /// expression of `travel` (m, zero in the reference configuration), `rate` (m/s) and `time`
    /// (s).
    pub force SlideActuator(i, j; point: Point, axis: Axis, force: Law(travel, rate)) {
        let d = dot(i.axis, j.point - i.point);
        force(d, rate(d)) along d;
    }
}

holonom::joint! {
    /// A joint from `i` to `k` follows one from `i` to `j`: its displacement (m) is `multiplier`
    /// times the displacement (m) of the other, plus `offset`. The joints themselves are other
    /// fields.
    pub joint SlideMimicsSlideBeside(
        i, j, k;
        point: Point,
        axis: Axis,
        leader_point: Point,
        leader_axis: Axis,
        multiplier: Number,
        offset: Number = 0.0
    ) {
        let leader = dot(i.leader_axis, j.leader_point - i.leader_point);
        dot(i.axis, k.point - i.point) - multiplier * leader - offset;
    }
}

/// The robot `panda`, with all joints at zero in the reference configuration.
///
/// The ground is the link `panda_link0`. Its mass of 0.629769 kg has no effect. Bodies have the
/// axes of their links.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "joints")]
pub struct Panda {
    /// Link `panda_link1`.
    // Visuals that are not drawn: `link1.dae`.
    #[body(
        mass = 4.970684,
        inertia = [
            [0.70337, -0.000139, 0.006772],
            [-0.000139, 0.70661, 0.019169],
            [0.006772, 0.019169, 0.009117],
        ],
        position = [0.003875, 0.002081, 0.28538]
    )]
    panda_link1: Body,
    /// Joint `panda_joint1`, revolute: from -2.8973 to 2.8973 rad, at most 2.175 rad/s, at most 87
    /// N m.
    #[joint(
        between = [ground, panda_link1],
        point = [0.0, 0.0, 0.333],
        axis = [0.0, 0.0, 1.0],
        limits = [-2.8973, 2.8973]
    )]
    panda_joint1: Revolute,
    /// Effort of `panda_joint1` (N m), on `panda_link1`.
    #[input]
    pub panda_joint1_torque: f64,
    #[force(
        between = [ground, panda_link1],
        axis = [0.0, 0.0, 1.0],
        moment = panda_joint1_torque - 0.003 * rate
    )]
    panda_joint1_motor: TorsionalActuator,
    /// Link `panda_link2`.
    // Visuals that are not drawn: `link2.dae`.
    #[body(
        mass = 0.646926,
        inertia = [
            [0.007962, -0.003925, 0.010254],
            [-0.003925, 0.02811, 0.000704],
            [0.010254, 0.000704, 0.025995],
        ],
        position = [-0.003141, 0.003495, 0.36172000000000004],
        orientation = [0.7071067811865475, -0.7071067811865475, 0.0, 0.0]
    )]
    panda_link2: Body,
    /// Joint `panda_joint2`, revolute: from -1.7628 to 1.7628 rad, at most 2.175 rad/s, at most 87
    /// N m.
    #[joint(
        between = [panda_link1, panda_link2],
        point = [0.0, 0.0, 0.333],
        axis = [0.0, 1.0, 0.0],
        limits = [-1.7628, 1.7628]
    )]
    panda_joint2: Revolute,
    /// Effort of `panda_joint2` (N m), on `panda_link2`.
    #[input]
    pub panda_joint2_torque: f64,
    #[force(
        between = [panda_link1, panda_link2],
        axis = [0.0, 1.0, 0.0],
        moment = panda_joint2_torque - 0.003 * rate
    )]
    panda_joint2_motor: TorsionalActuator,
    /// Link `panda_link3`.
    // Visuals that are not drawn: `link3.dae`.
    #[body(
        mass = 3.228604,
        inertia = [
            [0.037242, -0.004761, -0.011396],
            [-0.004761, 0.036155, -0.012805],
            [-0.011396, -0.012805, 0.01083],
        ],
        position = [0.027518, 0.039252, 0.582498]
    )]
    panda_link3: Body,
    /// Joint `panda_joint3`, revolute: from -2.8973 to 2.8973 rad, at most 2.175 rad/s, at most 87
    /// N m.
    #[joint(
        between = [panda_link2, panda_link3],
        point = [0.0, 0.0, 0.649],
        axis = [0.0, 0.0, 1.0],
        limits = [-2.8973, 2.8973]
    )]
    panda_joint3: Revolute,
    /// Effort of `panda_joint3` (N m), on `panda_link3`.
    #[input]
    pub panda_joint3_torque: f64,
    #[force(
        between = [panda_link2, panda_link3],
        axis = [0.0, 0.0, 1.0],
        moment = panda_joint3_torque - 0.003 * rate
    )]
    panda_joint3_motor: TorsionalActuator,
    /// Link `panda_link4`.
    // Visuals that are not drawn: `link4.dae`.
    #[body(
        mass = 3.587895,
        inertia = [
            [0.025853, 0.007796, -0.001332],
            [0.007796, 0.019552, 0.008641],
            [-0.001332, 0.008641, 0.028323],
        ],
        position = [0.029330000000000002, -0.027454, 0.7534190000000001],
        orientation = [0.7071067811865475, 0.7071067811865475, 0.0, 0.0]
    )]
    panda_link4: Body,
    /// Joint `panda_joint4`, revolute: from -3.0718 to -0.0698 rad, at most 2.175 rad/s, at most 87
    /// N m.
    #[joint(
        between = [panda_link3, panda_link4],
        point = [0.0825, 0.0, 0.649],
        axis = [0.0, -1.0, 0.0],
        limits = [-3.0718, -0.0698]
    )]
    panda_joint4: Revolute,
    /// Effort of `panda_joint4` (N m), on `panda_link4`.
    #[input]
    pub panda_joint4_torque: f64,
    #[force(
        between = [panda_link3, panda_link4],
        axis = [0.0, -1.0, 0.0],
        moment = panda_joint4_torque - 0.003 * rate
    )]
    panda_joint4_motor: TorsionalActuator,
    /// Link `panda_link5`.
    // Visuals that are not drawn: `link5.dae`.
    #[body(
        mass = 1.225946,
        inertia = [
            [0.035549, -0.002117, -0.004037],
            [-0.002117, 0.029474, 0.000229],
            [-0.004037, 0.000229, 0.008627],
        ],
        position = [-0.011953, 0.041065, 0.9945629999999999]
    )]
    panda_link5: Body,
    /// Joint `panda_joint5`, revolute: from -2.8973 to 2.8973 rad, at most 2.61 rad/s, at most 12 N
    /// m.
    #[joint(
        between = [panda_link4, panda_link5],
        point = [0.0, 0.0, 1.033],
        axis = [0.0, 0.0, 1.0],
        limits = [-2.8973, 2.8973]
    )]
    panda_joint5: Revolute,
    /// Effort of `panda_joint5` (N m), on `panda_link5`.
    #[input]
    pub panda_joint5_torque: f64,
    #[force(
        between = [panda_link4, panda_link5],
        axis = [0.0, 0.0, 1.0],
        moment = panda_joint5_torque - 0.003 * rate
    )]
    panda_joint5_motor: TorsionalActuator,
    /// Link `panda_link6`.
    // Visuals that are not drawn: `link6.dae`.
    #[body(
        mass = 1.666555,
        inertia = [
            [0.001964, 0.000109, -0.001158],
            [0.000109, 0.004354, 0.000341],
            [-0.001158, 0.000341, 0.005433],
        ],
        position = [0.060149, 0.010517, 1.018883],
        orientation = [0.7071067811865475, 0.7071067811865475, 0.0, 0.0]
    )]
    panda_link6: Body,
    /// Joint `panda_joint6`, revolute: from -0.0175 to 3.7525 rad, at most 2.61 rad/s, at most 12 N
    /// m.
    #[joint(
        between = [panda_link5, panda_link6],
        point = [0.0, 0.0, 1.033],
        axis = [0.0, -1.0, 0.0],
        limits = [-0.0175, 3.7525]
    )]
    panda_joint6: Revolute,
    /// Effort of `panda_joint6` (N m), on `panda_link6`.
    #[input]
    pub panda_joint6_torque: f64,
    #[force(
        between = [panda_link5, panda_link6],
        axis = [0.0, -1.0, 0.0],
        moment = panda_joint6_torque - 0.003 * rate
    )]
    panda_joint6_motor: TorsionalActuator,
    /// Link `panda_link7`, with `panda_link8`, `panda_hand` and `panda_hand_tcp` fixed to it: mass,
    /// centre of mass and inertia are those of all.
    // Visuals that are not drawn: `link7.dae` and `hand.dae`.
    #[body(
        mass = 1.465522,
        inertia = [
            [0.016396041602866757, 0.0003949639647318427, -0.0007101156156540998],
            [0.0003949639647318427, 0.01397340252488091, -0.0010538087685085856],
            [-0.0007101156156540998, -0.0010538087685085856, 0.0066753082423586735],
        ],
        position = [0.08975610149239534, -0.001388201581867619, 0.9338435570165442],
        orientation = [0.0, 1.0, 0.0, 0.0]
    )]
    panda_link7: Body,
    /// Origin of link `panda_link8`.
    #[point(on = panda_link7, at = [0.088, 0.0, 0.9259999999999999])]
    panda_link8: Point,
    /// Origin of link `panda_hand`.
    #[point(on = panda_link7, at = [0.088, 0.0, 0.9259999999999999])]
    panda_hand: Point,
    /// Origin of link `panda_hand_tcp`.
    #[point(on = panda_link7, at = [0.088, 0.0, 0.8225999999999999])]
    panda_hand_tcp: Point,
    /// Joint `panda_joint7`, revolute: from -2.8973 to 2.8973 rad, at most 2.61 rad/s, at most 12 N
    /// m.
    #[joint(
        between = [panda_link6, panda_link7],
        point = [0.088, 0.0, 1.033],
        axis = [0.0, 0.0, -1.0],
        limits = [-2.8973, 2.8973]
    )]
    panda_joint7: Revolute,
    /// Effort of `panda_joint7` (N m), on `panda_link7`.
    #[input]
    pub panda_joint7_torque: f64,
    #[force(
        between = [panda_link6, panda_link7],
        axis = [0.0, 0.0, -1.0],
        moment = panda_joint7_torque - 0.003 * rate
    )]
    panda_joint7_motor: TorsionalActuator,
    /// Link `panda_leftfinger`.
    // Visuals that are not drawn: `finger.dae`.
    #[body(
        mass = 0.015,
        inertia = [2.3749999999999997e-6, 2.3749999999999997e-6, 7.5e-7],
        position = [0.088, 0.0, 0.8675999999999999],
        orientation = [0.0, 0.9238795325112867, 0.3826834323650897, 0.0]
    )]
    panda_leftfinger: Body,
    /// Joint `panda_finger_joint1`, prismatic: from 0 to 0.04 m, at most 0.2 m/s, at most 100 N.
    #[joint(
        between = [panda_link7, panda_leftfinger],
        point = [0.088, 0.0, 0.8675999999999999],
        axis = [0.7071067811865475, -0.7071067811865476, 0.0],
        limits = [0.0, 0.04]
    )]
    panda_finger_joint1: Prismatic,
    /// Effort of `panda_finger_joint1` (N), on `panda_leftfinger`.
    #[input]
    pub panda_finger_joint1_force: f64,
    #[force(
        between = [panda_link7, panda_leftfinger],
        point = [0.088, 0.0, 0.8675999999999999],
        axis = [0.7071067811865475, -0.7071067811865476, 0.0],
        force = panda_finger_joint1_force - 0.3 * rate
    )]
    panda_finger_joint1_motor: SlideActuator,
    /// Link `panda_rightfinger`.
    // Visuals that are not drawn: `finger.dae`.
    #[body(
        mass = 0.015,
        inertia = [2.3749999999999997e-6, 2.3749999999999997e-6, 7.5e-7],
        position = [0.088, 0.0, 0.8675999999999999],
        orientation = [0.0, 0.9238795325112867, 0.3826834323650897, 0.0]
    )]
    panda_rightfinger: Body,
    /// Joint `panda_finger_joint2`, prismatic: from 0 to 0.04 m, at most 0.2 m/s, at most 100 N.
    #[joint(
        between = [panda_link7, panda_rightfinger],
        point = [0.088, 0.0, 0.8675999999999999],
        axis = [-0.7071067811865475, 0.7071067811865476, 0.0],
        limits = [0.0, 0.04]
    )]
    panda_finger_joint2: Prismatic,
    #[force(
        between = [panda_link7, panda_rightfinger],
        point = [0.088, 0.0, 0.8675999999999999],
        axis = [-0.7071067811865475, 0.7071067811865476, 0.0],
        force = -0.3 * rate
    )]
    panda_finger_joint2_damper: SlideActuator,
    /// `panda_finger_joint2` mimics `panda_finger_joint1`: its position is 1.0 times that of the
    /// other.
    #[joint(
        between = [panda_link7, panda_leftfinger, panda_rightfinger],
        point = [0.088, 0.0, 0.8675999999999999],
        axis = [-0.7071067811865475, 0.7071067811865476, 0.0],
        leader_point = [0.088, 0.0, 0.8675999999999999],
        leader_axis = [0.7071067811865475, -0.7071067811865476, 0.0],
        multiplier = 1.0
    )]
    panda_finger_joint2_mimic: SlideMimicsSlideBeside,
}

/// What the file says of its joints, in the order of the fields; of a slide m and N in the place of
/// rad and N m. A run holds joints within their positions, unless it says `.without_limits()`;
/// nothing holds rates and efforts.
#[allow(dead_code, clippy::approx_constant)]
impl Panda {
    /// Names in the file.
    #[rustfmt::skip]
    pub const JOINT_NAMES: [&str; 9] = [
        "panda_joint1",
        "panda_joint2",
        "panda_joint3",
        "panda_joint4",
        "panda_joint5",
        "panda_joint6",
        "panda_joint7",
        "panda_finger_joint1",
        "panda_finger_joint2",
    ];

    /// Lowest and highest positions (rad).
    #[rustfmt::skip]
    pub const POSITION_LIMITS: [[f64; 2]; 9] = [
        [-2.8973, 2.8973],
        [-1.7628, 1.7628],
        [-2.8973, 2.8973],
        [-3.0718, -0.0698],
        [-2.8973, 2.8973],
        [-0.0175, 3.7525],
        [-2.8973, 2.8973],
        [0.0, 0.04],
        [0.0, 0.04],
    ];

    /// Largest rates (rad/s).
    #[rustfmt::skip]
    pub const RATE_LIMITS: [f64; 9] = [
        2.175,
        2.175,
        2.175,
        2.175,
        2.61,
        2.61,
        2.61,
        0.2,
        0.2,
    ];

    /// Largest efforts (N m).
    #[rustfmt::skip]
    pub const EFFORT_LIMITS: [f64; 9] = [
        87.0,
        87.0,
        87.0,
        87.0,
        12.0,
        12.0,
        12.0,
        100.0,
        100.0,
    ];
}

/// Frames of the links on their bodies: origins (m) from the centre of mass in axes of the body, as
/// `View::point` takes them; on the ground global. Where a frame has other axes than its body,
/// Euler parameters, scalar first, turn them to those of the body.
#[allow(dead_code, clippy::approx_constant)]
#[rustfmt::skip]
impl Panda {
    /// Link `panda_link0`, on the ground.
    pub const PANDA_LINK0_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `panda_link1`, on `panda_link1`.
    pub const PANDA_LINK1_ORIGIN: [f64; 3] = [-0.003875, -0.002081, 0.04762];
    /// Link `panda_link2`, on `panda_link2`.
    pub const PANDA_LINK2_ORIGIN: [f64; 3] = [0.003141, 0.02872, -0.003495];
    /// Link `panda_link3`, on `panda_link3`.
    pub const PANDA_LINK3_ORIGIN: [f64; 3] = [-0.027518, -0.039252, 0.066502];
    /// Link `panda_link4`, on `panda_link4`.
    pub const PANDA_LINK4_ORIGIN: [f64; 3] = [0.05317, -0.104419, -0.027454];
    /// Link `panda_link5`, on `panda_link5`.
    pub const PANDA_LINK5_ORIGIN: [f64; 3] = [0.011953, -0.041065, 0.038437];
    /// Link `panda_link6`, on `panda_link6`.
    pub const PANDA_LINK6_ORIGIN: [f64; 3] = [-0.060149, 0.014117, 0.010517];
    /// Link `panda_link7`, on `panda_link7`.
    pub const PANDA_LINK7_ORIGIN: [f64; 3] = [-0.001756101492395339, -0.001388201581867619, -0.09915644298345572];
    /// Link `panda_link8`, on `panda_link7`.
    pub const PANDA_LINK8_ORIGIN: [f64; 3] = [-0.001756101492395339, -0.001388201581867619, 0.00784355701654428];
    /// Link `panda_hand`, on `panda_link7`.
    pub const PANDA_HAND_ORIGIN: [f64; 3] = [-0.001756101492395339, -0.001388201581867619, 0.00784355701654428];
    /// Axes of `panda_hand`.
    pub const PANDA_HAND_AXES: [f64; 4] = [0.9238795325112867, 0.0, 0.0, -0.3826834323650897];
    /// Link `panda_hand_tcp`, on `panda_link7`.
    pub const PANDA_HAND_TCP_ORIGIN: [f64; 3] = [-0.001756101492395339, -0.001388201581867619, 0.11124355701654429];
    /// Axes of `panda_hand_tcp`.
    pub const PANDA_HAND_TCP_AXES: [f64; 4] = [0.9238795325112867, 0.0, 0.0, -0.3826834323650897];
    /// Link `panda_leftfinger`, on `panda_leftfinger`.
    pub const PANDA_LEFTFINGER_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
    /// Link `panda_rightfinger`, on `panda_rightfinger`.
    pub const PANDA_RIGHTFINGER_ORIGIN: [f64; 3] = [0.0, 0.0, 0.0];
}
