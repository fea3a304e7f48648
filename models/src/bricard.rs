//! Bricard's mechanism.

use holonom::prelude::*;

/// Five rods and the ground in a ring of six hinges: it moves, although the count of its equations
/// says that it cannot.
///
#[doc = include_str!("sketches/bricard.svg")]
///
/// ```text
///         P1 ------- P2        y        hinge    axis
///        :           |         |        P1, P4   y
///      P6            |         o-- x    P2, P5   z
///       |            P3       /         P3, P6   x
///       |           /        z
///      P5 ------- P4                    from P6 to P1: the ground; g = 9.81 m/s^2 along -y
/// ```
///
/// Problem A04 of the library of the IFToMM Technical Committee for Multibody Dynamics: rods of 1
/// m, 1 kg, of the section 0.1 m x 0.1 m, the centre of mass in the middle, `(0.1^2 + 0.1^2) / 12`
/// kg m^2 about their axes and `(1 + 0.1^2) / 12` kg m^2 across. The hinges are at
/// `P1 = (0, 0, 0)`, `P2 = (1, 0, 0)`, `P3 = (1, -1, 0)`, `P4 = (1, -1, 1)`, `P5 = (0, -1, 1)`,
/// `P6 = (0, 0, 1)` m; at rest at the start, 10 s. The library compares the path of `P3`.
///
/// 30 equations on 30 velocities; one follows from the others in every position, and is dropped.
///
/// Good for: equations that depend on each other while no two of them are alike; a motion through
/// space with one angle, `cos(A) + cos(B) + cos(A) cos(B) = 0`, `A` that of the hinges 1, 3 and 5
/// and `B` that of the others.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct Bricard {
    #[body(
        mass = 1.0,
        inertia = [0.02 / 12.0, 1.01 / 12.0, 1.01 / 12.0],
        position = [0.5, 0.0, 0.0],
        shape = bar(width = 0.1, height = 0.1, from = [0.0, 0.0, 0.0], to = [1.0, 0.0, 0.0])
    )]
    first: Body,
    #[body(
        mass = 1.0,
        inertia = [1.01 / 12.0, 0.02 / 12.0, 1.01 / 12.0],
        position = [1.0, -0.5, 0.0],
        shape = bar(width = 0.1, height = 0.1, from = [1.0, 0.0, 0.0], to = [1.0, -1.0, 0.0])
    )]
    second: Body,
    #[body(
        mass = 1.0,
        inertia = [1.01 / 12.0, 1.01 / 12.0, 0.02 / 12.0],
        position = [1.0, -1.0, 0.5],
        shape = bar(width = 0.1, height = 0.1, from = [1.0, -1.0, 0.0], to = [1.0, -1.0, 1.0])
    )]
    third: Body,
    #[body(
        mass = 1.0,
        inertia = [0.02 / 12.0, 1.01 / 12.0, 1.01 / 12.0],
        position = [0.5, -1.0, 1.0],
        shape = bar(width = 0.1, height = 0.1, from = [1.0, -1.0, 1.0], to = [0.0, -1.0, 1.0])
    )]
    fourth: Body,
    #[body(
        mass = 1.0,
        inertia = [1.01 / 12.0, 0.02 / 12.0, 1.01 / 12.0],
        position = [0.0, -0.5, 1.0],
        shape = bar(width = 0.1, height = 0.1, from = [0.0, -1.0, 1.0], to = [0.0, 0.0, 1.0])
    )]
    fifth: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    p1: Revolute,
    #[joint(between = [first, second], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    p2: Revolute,
    #[joint(between = [second, third], point = [1.0, -1.0, 0.0], axis = [1.0, 0.0, 0.0])]
    p3: Revolute,
    #[joint(between = [third, fourth], point = [1.0, -1.0, 1.0], axis = [0.0, 1.0, 0.0])]
    p4: Revolute,
    #[joint(between = [fourth, fifth], point = [0.0, -1.0, 1.0], axis = [0.0, 0.0, 1.0])]
    p5: Revolute,
    #[joint(between = [fifth, ground], point = [0.0, 0.0, 1.0], axis = [1.0, 0.0, 0.0])]
    p6: Revolute,
}

impl Bricard {
    /// `P3` in the axes of `second`, from its centre of mass (m).
    pub const P3: [f64; 3] = [0.0, -0.5, 0.0];

    /// The period (s): by two integrations of the angle `A` that agree to 2e-13.
    pub const PERIOD: f64 = 4.991_711_513_687_5;
}
