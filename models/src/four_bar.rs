//! The N-four-bar mechanism, for N = 1, 2 and 5.

use holonom::prelude::*;

/// A parallelogram of three uniform links of 1 m and 1 kg, upright at the start, moving at 1 m/s,
/// gravity along -y.
///
#[doc = include_str!("sketches/four_bar.svg")]
///
/// ```text
///     y
///     o---------o   coupler      pins at (0, 0), (1, 0), (0, 1), (1, 1) m
///     |         |                z towards the reader
///     | left    | right          the top starts along +x
///     o         o-- x            g = 9.81 m/s^2 along -y
/// ```
///
/// Problem A02 of the library of the IFToMM Technical Committee for Multibody Dynamics (sheet of
/// 2005: Universidade da Coruña), for N = 1. Each link is slender: 1/12 kg m^2 about its centre of
/// mass; moments of inertia about other axes than z do not act: they are ours.
///
/// Four hinges in a loop say three things twice: 20 equations, of which 3 are dropped.
///
/// Good for: passing singular configurations. Twice a turn all links lie on one line, for the first
/// time after 0.70845 s; there the mechanism has two ways to go on and the equations lose rank.
/// Standard Lagrange multipliers and Baumgarte cannot be solved on the line; penalty and augmented
/// Lagrangian can. All of them may leave the way of the parallelogram there when a violation has
/// come about; with a [`Projection`] after every step penalty and augmented Lagrangian stay on it.
/// It has a closed form, `(N + 1 + 3 N) / 3 theta'' = (N + 1 + 2 N) / 2 g sin(theta)` with `theta`
/// of the upright links clockwise from the upward vertical.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct FourBar {
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [0.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    left: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [0.5, 1.0, 0.0],
        velocity = [1.0, 0.0, 0.0]
    )]
    coupler: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [1.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_foot: Revolute,
    #[joint(between = [left, coupler], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_pin: Revolute,
    #[joint(between = [ground, right], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_foot: Revolute,
    #[joint(between = [coupler, right], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_pin: Revolute,
}

impl FourBar {
    /// The upper end of an upright link in its axes, from its centre of mass (m). The sheets
    /// compare that of `left`.
    pub const TOP: [f64; 3] = [0.0, 0.5, 0.0];
}
