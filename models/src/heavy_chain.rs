//! The heavy bob on a light chain.

use holonom::joints::{Distance, PointOnPlane};
use holonom::prelude::*;

/// Three point masses of 1 g and a bob of 1000 kg on four massless links of 0.25 m, straight, at rest, 60 degrees from
/// the vertical, gravity along -y, in the xy plane.
///
/// ```text
///     y
///     o------- x       z towards the reader
///     |  .
///     |    .           three masses of 1 g, 0.25 m apart
///     |      .
///     v        O       1000 kg, 1 m from the origin; 60 degrees between chain and -y
///     g = 9.81 m/s^2
/// ```
///
/// Own data.
///
/// Good for: what a ratio of masses of 1e6 does to the digits of a solution. The bob swings with 3 rad/s, the small
/// masses sing with 1e4 rad/s (explicit steps must stay below 2e-4 s), and the penalty must be large against tensions
/// of 1e4 N.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "joints")]
pub struct HeavyChain {
    #[body(mass = 1e-3, position = [0.25 * sin(deg(60.0)), -0.25 * cos(deg(60.0)), 0.0])]
    first: Particle,
    #[body(mass = 1e-3, position = [0.5 * sin(deg(60.0)), -0.5 * cos(deg(60.0)), 0.0])]
    second: Particle,
    #[body(mass = 1e-3, position = [0.75 * sin(deg(60.0)), -0.75 * cos(deg(60.0)), 0.0])]
    third: Particle,
    #[body(mass = 1000.0, position = [1.0 * sin(deg(60.0)), -1.0 * cos(deg(60.0)), 0.0])]
    bob: Particle,
    #[joint(
        between = [ground, first],
        head = [0.0, 0.0, 0.0],
        tail = [0.25 * sin(deg(60.0)), -0.25 * cos(deg(60.0)), 0.0],
        length = 0.25
    )]
    link_1: Distance,
    #[joint(
        between = [first, second],
        head = [0.25 * sin(deg(60.0)), -0.25 * cos(deg(60.0)), 0.0],
        tail = [0.5 * sin(deg(60.0)), -0.5 * cos(deg(60.0)), 0.0],
        length = 0.25
    )]
    link_2: Distance,
    #[joint(
        between = [second, third],
        head = [0.5 * sin(deg(60.0)), -0.5 * cos(deg(60.0)), 0.0],
        tail = [0.75 * sin(deg(60.0)), -0.75 * cos(deg(60.0)), 0.0],
        length = 0.25
    )]
    link_3: Distance,
    #[joint(
        between = [third, bob],
        head = [0.75 * sin(deg(60.0)), -0.75 * cos(deg(60.0)), 0.0],
        tail = [1.0 * sin(deg(60.0)), -1.0 * cos(deg(60.0)), 0.0],
        length = 0.25
    )]
    link_4: Distance,
    #[joint(
        between = [ground, first],
        point = [0.25 * sin(deg(60.0)), -0.25 * cos(deg(60.0)), 0.0],
        normal = [0.0, 0.0, 1.0]
    )]
    plane_1: PointOnPlane,
    #[joint(
        between = [ground, second],
        point = [0.5 * sin(deg(60.0)), -0.5 * cos(deg(60.0)), 0.0],
        normal = [0.0, 0.0, 1.0]
    )]
    plane_2: PointOnPlane,
    #[joint(
        between = [ground, third],
        point = [0.75 * sin(deg(60.0)), -0.75 * cos(deg(60.0)), 0.0],
        normal = [0.0, 0.0, 1.0]
    )]
    plane_3: PointOnPlane,
    #[joint(
        between = [ground, bob],
        point = [1.0 * sin(deg(60.0)), -1.0 * cos(deg(60.0)), 0.0],
        normal = [0.0, 0.0, 1.0]
    )]
    plane_4: PointOnPlane,
}
