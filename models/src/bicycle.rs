//! The benchmark bicycle.

use holonom::prelude::*;

/// Whipple's bicycle with the benchmark parameters, upright at the start; x points forward, y to
/// the right and z **down**, gravity along z.
///
/// ```text
///              frame
///      ____________\ steering axis, leant back by 18 degrees
///    .-+-.         .\-.
///   |  o  |       |  o  |
/// ___`---'_________`---'\___ x    trail: the steering axis meets the ground 0.08 m
///                                 ahead of the point of contact
/// ```
///
/// Shapes are drawn alone. Wheels are thin discs that roll without slip on the ground. Meijaard,
/// Papadopoulos, Ruina and Schwab, *Linearized dynamics equations for the balance and steer of a
/// bicycle: a benchmark and review*, Proceedings of the Royal Society A 463 (2007), table 1.
///
/// Good for: rolling; eigenvalues over the speed, which are stable between 4.292382536341106 and
/// 6.024262015388376 m/s.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, 9.81], coordinates = "both", kernels = [mass, inverse])]
pub struct Bicycle {
    #[body(
        mass = 2.0, inertia = [0.0603, 0.12, 0.0603], position = [0.0, 0.0, -0.3],
        shape = disc(radius = 0.3, thickness = 0.02, at = [0.0, 0.0, -0.3], axis = [0.0, 1.0, 0.0])
    )]
    rear_wheel: Body,
    /// The frame, with the rider.
    #[body(
        mass = 85.0,
        inertia = [[9.2, 0.0, 2.4], [0.0, 11.0, 0.0], [2.4, 0.0, 2.8]],
        position = [0.3, 0.0, -0.9],
        shapes = [
            cylinder(radius = 0.03, from = [0.0, 0.0, -0.3], to = [0.3, 0.0, -0.9]),
            cylinder(radius = 0.03, from = [0.3, 0.0, -0.9], to = [0.8, 0.0, -0.9]),
            cylinder(radius = 0.03, from = [0.3, 0.0, -0.9], to = [0.3, 0.0, -1.4]),
        ]
    )]
    frame: Body,
    /// The fork, with the handlebar.
    #[body(
        mass = 4.0,
        inertia = [[0.05892, 0.0, -0.00756], [0.0, 0.06, 0.0], [-0.00756, 0.0, 0.00708]],
        position = [0.9, 0.0, -0.7],
        shapes = [
            cylinder(radius = 0.02, from = [0.77, 0.0, -1.0], to = [1.02, 0.0, -0.35]),
            cylinder(radius = 0.02, from = [0.77, -0.25, -1.0], to = [0.77, 0.25, -1.0]),
        ]
    )]
    fork: Body,
    #[body(
        mass = 3.0, inertia = [0.1405, 0.28, 0.1405], position = [1.02, 0.0, -0.35],
        shape = disc(
            radius = 0.35, thickness = 0.02, at = [1.02, 0.0, -0.35], axis = [0.0, 1.0, 0.0]
        )
    )]
    front_wheel: Body,
    #[joint(between = [frame, rear_wheel], point = [0.0, 0.0, -0.3], axis = [0.0, 1.0, 0.0])]
    rear_hub: Revolute,
    #[joint(
        between = [frame, fork], point = [1.02 + 0.08, 0.0, 0.0],
        axis = [sin(PI / 10.0), 0.0, cos(PI / 10.0)]
    )]
    steering: Revolute,
    #[joint(between = [fork, front_wheel], point = [1.02, 0.0, -0.35], axis = [0.0, 1.0, 0.0])]
    front_hub: Revolute,
    #[joint(
        between = [ground, rear_wheel], center = [0.0, 0.0, -0.3], axle = [0.0, 1.0, 0.0],
        point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, -1.0], radius = 0.3
    )]
    rear_contact: RollingWheel,
    #[joint(
        between = [ground, front_wheel], center = [1.02, 0.0, -0.35], axle = [0.0, 1.0, 0.0],
        point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, -1.0], radius = 0.35
    )]
    front_contact: RollingWheel,
}
