//! A seven-axis arm.

use holonom::prelude::*;

/// Franka Emika's Panda with motors on its axes, fingers locked, upright at the start, at rest,
/// gravity along -z.
///
#[doc = include_str!("sketches/panda.svg")]
///
/// Masses, inertias about the centres of mass and axes: `panda_description`, as in
/// `example-robot-data`, given here along global axes with all angles zero. The joints turn about
/// z, y, z, -y, z, -y and -z. All tensors of inertia are full.
///
/// Good for: a robot of seven hinges in a row, one more than the hand has freedoms; forward
/// dynamics against [Pinocchio](https://github.com/stack-of-tasks/pinocchio), which the tests hold
/// to 1e-12.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass, inverse, jacobian, forward, derivatives, adjoint])]
pub struct Panda {
    /// The moment of the motor of `joint_1` (N m), on the outer link.
    #[input]
    pub joint_1_torque: f64,
    /// The moment of the motor of `joint_2` (N m), on the outer link.
    #[input]
    pub joint_2_torque: f64,
    /// The moment of the motor of `joint_3` (N m), on the outer link.
    #[input]
    pub joint_3_torque: f64,
    /// The moment of the motor of `joint_4` (N m), on the outer link.
    #[input]
    pub joint_4_torque: f64,
    /// The moment of the motor of `joint_5` (N m), on the outer link.
    #[input]
    pub joint_5_torque: f64,
    /// The moment of the motor of `joint_6` (N m), on the outer link.
    #[input]
    pub joint_6_torque: f64,
    /// The moment of the motor of `joint_7` (N m), on the outer link.
    #[input]
    pub joint_7_torque: f64,
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
    #[force(between = [ground, link_1], axis = [0.0, 0.0, 1.0], moment = joint_1_torque)]
    joint_1_motor: TorsionalActuator,
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
    #[force(between = [link_1, link_2], axis = [0.0, 1.0, 0.0], moment = joint_2_torque)]
    joint_2_motor: TorsionalActuator,
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
    #[force(between = [link_2, link_3], axis = [0.0, 0.0, 1.0], moment = joint_3_torque)]
    joint_3_motor: TorsionalActuator,
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
    #[force(between = [link_3, link_4], axis = [0.0, -1.0, 0.0], moment = joint_4_torque)]
    joint_4_motor: TorsionalActuator,
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
    #[force(between = [link_4, link_5], axis = [0.0, 0.0, 1.0], moment = joint_5_torque)]
    joint_5_motor: TorsionalActuator,
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
    #[force(between = [link_5, link_6], axis = [0.0, -1.0, 0.0], moment = joint_6_torque)]
    joint_6_motor: TorsionalActuator,
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
    #[force(between = [link_6, hand], axis = [0.0, 0.0, -1.0], moment = joint_7_torque)]
    joint_7_motor: TorsionalActuator,
}
