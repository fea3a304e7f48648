//! The flyball governor.

use holonom::prelude::*;

/// Two balls on rods turn about a vertical shaft at one turn a second and lift a slider through
/// stiff spring-dampers.
///
#[doc = include_str!("sketches/flyball_governor.svg")]
///
/// ```text
///           z
///     hinge | hinge        the view along y: the arms sink from the hinges by alpha = 30 degrees,
///       o---+---o          a spring-damper from the middle of each to the slider on the shaft
///     /     |     \
///   /  ....[ ]....  \      everything turns about z
///  O        |        O     g = 9.81 m/s^2 along -z
///           +-- x
/// ```
///
/// Problem A05 of the library of the IFToMM Technical Committee for Multibody Dynamics, 10 s, all
/// parts of 3000 kg/m^3: the shaft 1 m x 0.01 m x 0.01 m (0.3 kg) on the z axis; the slider a cube
/// of 0.1 m (3 kg) at the height of 0.5 m; the rods 1 m x 0.01 m x 0.01 m (0.3 kg) on hinges at
/// (0.05, 0, 1) and (-0.05, 0, 1) m, 30 degrees below the horizontal, with a point mass of 5 kg at
/// their ends; spring-dampers of 8e5 N/m, 4e4 N s/m and 0.5 m between (0.05, 0, 0.5), (-0.05, 0,
/// 0.5) m on the slider and the middles of the rods. Everything turns about z at 2 pi rad/s.
///
/// Rod and ball are one body here, `arm`: 5.3 kg, the centre of mass `(0.15 + 5) / 5.3` m from the
/// hinge, x along the rod, moments of inertia after Steiner. The point mass is drawn as a ball of
/// 0.0736 m, which has 5 kg at that density.
///
/// Good for: stiffness. The fastest motion about the start decays with 8117 1/s (steps of classical
/// Runge-Kutta must be below 3.4e-4 s), the slowest oscillates with 7.3 rad/s.
///
/// The angles of the arms' hinges are zero at the start and grow as the arms sink:
/// `alpha = pi/6 + angle` below the horizontal. The displacement of `guide` is the height of the
/// slider less 0.5 m.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct FlyballGovernor {
    #[body(
        mass = 0.3,
        inertia = [0.3 * 1.0001 / 12.0, 0.3 * 1.0001 / 12.0, 0.3 * 2e-4 / 12.0],
        position = [0.0, 0.0, 0.5],
        angular_velocity = [0.0, 0.0, TAU],
        shape = block(size = [0.01, 0.01, 1.0], at = [0.0, 0.0, 0.5])
    )]
    shaft: Body,
    #[body(
        mass = 3.0,
        inertia = [0.005, 0.005, 0.005],
        position = [0.0, 0.0, 0.5],
        angular_velocity = [0.0, 0.0, TAU],
        shape = block(size = [0.1, 0.1, 0.1], at = [0.0, 0.0, 0.5])
    )]
    slider: Body,
    #[body(
        mass = 5.3,
        inertia = [0.3 * 2e-4 / 12.0, 0.3 * 1.0001 / 12.0 + 0.3 * 5.0 / 5.3 * 0.25, 0.3 * 1.0001 / 12.0 + 0.3 * 5.0 / 5.3 * 0.25],
        position = [(0.05 + 5.15 / 5.3 * cos(deg(30.0))), 0.0, 1.0 - 5.15 / 5.3 * sin(deg(30.0))],
        orientation = rotation([0.0, 1.0, 0.0], deg(30.0)),
        velocity = [0.0, TAU * (0.05 + 5.15 / 5.3 * cos(deg(30.0))), 0.0],
        angular_velocity = [-TAU * sin(deg(30.0)), 0.0, TAU * cos(deg(30.0))],
        shapes = [
            bar(width = 0.01, height = 0.01, from = [0.05, 0.0, 1.0], to = [(0.05 + cos(deg(30.0))), 0.0, 0.5]),
            ball(radius = 0.0736, at = [(0.05 + cos(deg(30.0))), 0.0, 0.5]),
        ]
    )]
    right_arm: Body,
    #[body(
        mass = 5.3,
        inertia = [0.3 * 2e-4 / 12.0, 0.3 * 1.0001 / 12.0 + 0.3 * 5.0 / 5.3 * 0.25, 0.3 * 1.0001 / 12.0 + 0.3 * 5.0 / 5.3 * 0.25],
        position = [-(0.05 + 5.15 / 5.3 * cos(deg(30.0))), 0.0, 1.0 - 5.15 / 5.3 * sin(deg(30.0))],
        orientation = rotation([0.0, 1.0, 0.0], deg(150.0)),
        velocity = [0.0, -TAU * (0.05 + 5.15 / 5.3 * cos(deg(30.0))), 0.0],
        angular_velocity = [-TAU * sin(deg(150.0)), 0.0, TAU * cos(deg(150.0))],
        shapes = [
            bar(width = 0.01, height = 0.01, from = [-0.05, 0.0, 1.0], to = [-(0.05 + cos(deg(30.0))), 0.0, 0.5]),
            ball(radius = 0.0736, at = [-(0.05 + cos(deg(30.0))), 0.0, 0.5]),
        ]
    )]
    left_arm: Body,
    #[joint(between = [ground, shaft], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [shaft, slider], point = [0.0, 0.0, 0.5], axis = [0.0, 0.0, 1.0])]
    guide: Prismatic,
    #[joint(between = [shaft, right_arm], point = [0.05, 0.0, 1.0], axis = [0.0, 1.0, 0.0])]
    right_hinge: Revolute,
    #[joint(between = [shaft, left_arm], point = [-0.05, 0.0, 1.0], axis = [0.0, -1.0, 0.0])]
    left_hinge: Revolute,
    #[force(
        between = [slider, right_arm],
        head = [0.05, 0.0, 0.5],
        tail = [(0.05 + 0.5 * cos(deg(30.0))), 0.0, 0.75],
        stiffness = 8e5,
        damping = 4e4,
        free_length = 0.5
    )]
    right_spring: SpringDamper,
    #[force(
        between = [slider, left_arm],
        head = [-0.05, 0.0, 0.5],
        tail = [-(0.05 + 0.5 * cos(deg(30.0))), 0.0, 0.75],
        stiffness = 8e5,
        damping = 4e4,
        free_length = 0.5
    )]
    left_spring: SpringDamper,
}

impl FlyballGovernor {
    /// The middle of the rod of an arm, where its spring is fixed, in the arm's axes from its
    /// centre of mass (m).
    pub const MIDDLE: [f64; 3] = [0.5 - 5.15 / 5.3, 0.0, 0.0];
}
