//! A six-axis arm.

use holonom::prelude::*;

/// Universal Robots' UR5 with motors on its axes, stretched out along x at the start, at rest,
/// gravity along -z.
///
#[doc = include_str!("sketches/ur5.svg")]
///
/// ```text
///     z
///     |         upper arm         forearm
///     o----------------------------------------o wrist    all angles zero, y towards the reader
///     |  lift                elbow             |
///     |  pan                                   o-- third wrist
///     ground                                          x
/// ```
///
/// Masses, inertias about the centres of mass and axes: `ur_description` (`ur5`), as in
/// `example-robot-data`, given here along global axes with all angles zero. `pan`, `lift`, `elbow`,
/// `wrist_1`, `wrist_2`, `wrist_3` turn about z, y, y, y, -z and y; what the numbers have left of
/// the last digits of a URDF file is kept.
///
/// Good for: a robot of six hinges in a row; forward dynamics against
/// [Pinocchio](https://github.com/stack-of-tasks/pinocchio), which the tests hold to 1e-12.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass, inverse, jacobian, forward, derivatives, adjoint])]
pub struct Ur5 {
    /// The moment of the motor of `pan` (N m), on the outer link.
    #[input]
    pub pan_torque: f64,
    /// The moment of the motor of `lift` (N m), on the outer link.
    #[input]
    pub lift_torque: f64,
    /// The moment of the motor of `elbow` (N m), on the outer link.
    #[input]
    pub elbow_torque: f64,
    /// The moment of the motor of `wrist_1` (N m), on the outer link.
    #[input]
    pub wrist_1_torque: f64,
    /// The moment of the motor of `wrist_2` (N m), on the outer link.
    #[input]
    pub wrist_2_torque: f64,
    /// The moment of the motor of `wrist_3` (N m), on the outer link.
    #[input]
    pub wrist_3_torque: f64,
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
    #[force(between = [ground, shoulder], axis = [0.0, 0.0, 1.0], moment = pan_torque)]
    pan_motor: TorsionalActuator,
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
    #[force(between = [shoulder, upper_arm], axis = [0.0, 1.0, 0.0], moment = lift_torque)]
    lift_motor: TorsionalActuator,
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
    #[force(between = [upper_arm, forearm], axis = [0.0, 1.0, 0.0], moment = elbow_torque)]
    elbow_motor: TorsionalActuator,
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
    #[force(between = [forearm, first_wrist], axis = [0.0, 1.0, 0.0], moment = wrist_1_torque)]
    wrist_1_motor: TorsionalActuator,
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
    #[force(between = [first_wrist, second_wrist], axis = [9.793277300218506e-12, 0.0, -1.0], moment = wrist_2_torque)]
    wrist_2_motor: TorsionalActuator,
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
    #[force(between = [second_wrist, third_wrist], axis = [0.0, 1.0, 0.0], moment = wrist_3_torque)]
    wrist_3_motor: TorsionalActuator,
}
