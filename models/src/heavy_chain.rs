//! The heavy bob on a light chain.

use holonom::prelude::*;

/// Three point masses of 1 g and a bob of 1000 kg on four massless links of 0.25 m, straight, at
/// rest, 60 degrees from the vertical, gravity along -y, in the xy plane.
///
#[doc = include_str!("sketches/heavy_chain.svg")]
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
/// Good for: what a ratio of masses of 1e6 does to the digits of a solution. The bob swings with 3
/// rad/s, the small masses sing with 1e4 rad/s (explicit steps must stay below 2e-4 s), and the
/// penalty must be large against tensions of 1e4 N.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both")]
pub struct HeavyChain {
    #[body(
        mass = 1e-3,
        position = [0.25 * (k + 1) * sin(deg(60.0)), -0.25 * (k + 1) * cos(deg(60.0)), 0.0]
    )]
    masses: [Particle; 3],
    #[body(mass = 1000.0, position = [1.0 * sin(deg(60.0)), -1.0 * cos(deg(60.0)), 0.0])]
    bob: Particle,
    #[joint(
        between = [if k == 0 { ground } else { masses[k - 1] }, if k == 3 { bob } else { masses[k] }],
        head = [0.25 * k * sin(deg(60.0)), -0.25 * k * cos(deg(60.0)), 0.0],
        tail = [0.25 * (k + 1) * sin(deg(60.0)), -0.25 * (k + 1) * cos(deg(60.0)), 0.0],
        length = 0.25
    )]
    links: [Distance; 4],
    #[joint(
        between = [ground, if k == 3 { bob } else { masses[k] }],
        point = [0.25 * (k + 1) * sin(deg(60.0)), -0.25 * (k + 1) * cos(deg(60.0)), 0.0],
        normal = [0.0, 0.0, 1.0]
    )]
    planes: [PointOnPlane; 4],
}
