//! Andrews' squeezing mechanism.

use holonom::View;
use holonom::prelude::*;

/// Seven bodies in a plane, three loops: a motor of 0.033 N m turns a crank of 7 mm against a stiff
/// spring, for 0.03 s or 0.05 s.
///
#[doc = include_str!("sketches/squeezing_mechanism.svg")]
///
/// ```text
///                                        C      y
///                                       :       |
///                B                     :        +-- x
///               / `--- D . . . . . . .:  spring
///              |      /
///     .-- G    |   .'    triangle B, D, E
///    /     `.  |  /
///   A        `- E ----------- O-F               coupler and crank
///    \      .'
///     `-- H'         rockers A-G and A-H, links G-E and H-E; O, A, B, C are fixed on the ground
/// ```
///
/// Problem A03 of the library of the IFToMM Technical Committee for Multibody Dynamics and
/// `andrews` of the Test Set for IVP Solvers (Mazzia and Magherini, release 2.4); Schiehlen,
/// *Multibody Systems Handbook* (1990). No gravity. The centres of mass and the hinges are those of
/// the start of the Test Set, computed from its angles and lengths to 17 digits:
///
/// | body here | number | its points | mass (kg) | about z (kg m^2) |
/// |---|---|---|---|---|
/// | `crank` | 1 | O, F | 0.04325 | 2.194e-6 |
/// | `coupler` | 2 | F, E | 0.00365 | 4.410e-7 |
/// | `triangle` | 3 | B, D, E | 0.02373 | 5.255e-6 |
/// | `upper_link` | 4 | E, G | 0.00706 | 5.667e-7 |
/// | `upper_rocker` | 5 | A, G | 0.07050 | 1.169e-5 |
/// | `lower_link` | 6 | E, H | 0.00706 | 5.667e-7 |
/// | `lower_rocker` | 7 | A, H | 0.05498 | 1.912e-5 |
///
/// On the ground, in m: O = (0, 0), A = (-0.06934, -0.00227), B = (-0.03635, 0.03273), C = (0.014,
/// 0.072). Spring between C and D: 4530 N/m, 0.07785 m. (Copies with `+0.03635` and with 0.02372 kg
/// for body 3 circulate: misprints.) Moments of inertia about other axes than z do not act: they
/// are ours.
///
/// Seven hinges make a tree, and the three loops are closed in E by the two equations in their
/// plane alone ([`PointOnLine`]): all 41 equations are independent. The angles of the hinges are
/// the coordinates of the Test Set, less their values at the start (rad):
///
/// | hinge | coordinate | at the start |
/// |---|---|---|
/// | `o` | beta | -0.0617138900142764 |
/// | `f` | Theta | 0 |
/// | `b` | gamma | 0.455279819163070 |
/// | `g` | phi | 0.222668390165886 |
/// | `a_upper` | delta | 0.487364979543843 |
/// | `h` | Omega | -0.222668390165886 |
/// | `a_lower` | epsilon | 1.23054744454982 |
///
/// Good for: small times, small masses, a crank that turns many times while the rest swings;
/// accuracy against a published state.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct SqueezingMechanism {
    #[body(
        mass = 0.04325,
        inertia = [2.194e-6, 2.194e-6, 2.194e-6],
        position = [0.0009182485980307614, -5.674074562905483e-05, 0.0]
    )]
    crank: Body,
    #[body(
        mass = 0.00365,
        inertia = [4.410e-7, 4.410e-7, 4.410e-7],
        position = [-0.0044914333599330725, 0.0002775362557942899, 0.0]
    )]
    coupler: Body,
    #[body(
        mass = 0.02373,
        inertia = [5.255e-6, 5.255e-6, 5.255e-6],
        position = [-0.018742186670315464, 0.02048510678907393, 0.0]
    )]
    triangle: Body,
    #[body(
        mass = 0.00706,
        inertia = [5.667e-7, 5.667e-7, 5.667e-7],
        position = [-0.030222939830158887, 0.012071182356663938, 0.0]
    )]
    upper_link: Body,
    #[body(
        mass = 0.07050,
        inertia = [1.169e-5, 1.169e-5, 1.169e-5],
        position = [-0.05323682815570414, 0.01663184796661631, 0.0]
    )]
    upper_rocker: Body,
    #[body(
        mass = 0.00706,
        inertia = [5.667e-7, 5.667e-7, 5.667e-7],
        position = [-0.028543268536783597, -0.010722254707252283, 0.0]
    )]
    lower_link: Body,
    #[body(
        mass = 0.05498,
        inertia = [1.912e-5, 1.912e-5, 1.912e-5],
        position = [-0.059262402801791715, -0.010600698332712842, 0.0]
    )]
    lower_rocker: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    o: Revolute,
    #[joint(
        between = [crank, coupler],
        point = [0.006986674115451445, -0.0004317230645688955, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    f: Revolute,
    #[joint(between = [ground, triangle], point = [-0.03635, 0.03273, 0.0], axis = [0.0, 0.0, 1.0])]
    b: Revolute,
    #[joint(between = [ground, upper_rocker], point = [-0.06934, -0.00227, 0.0], axis = [0.0, 0.0, 1.0])]
    a_upper: Revolute,
    #[joint(
        between = [upper_rocker, upper_link],
        point = [-0.03399720388583998, 0.01646197167499768, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    g: Revolute,
    #[joint(between = [ground, lower_rocker], point = [-0.06934, -0.00227, 0.0], axis = [0.0, 0.0, 1.0])]
    a_lower: Revolute,
    #[joint(
        between = [lower_rocker, lower_link],
        point = [-0.03163313450740889, -0.015618868668304533, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    h: Revolute,
    #[joint(
        between = [triangle, coupler],
        point = [-0.020960022346354336, 0.0012951691937066864, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    e_coupler: PointOnLine,
    #[joint(
        between = [triangle, upper_link],
        point = [-0.020960022346354336, 0.0012951691937066864, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    e_upper: PointOnLine,
    #[joint(
        between = [triangle, lower_link],
        point = [-0.020960022346354336, 0.0012951691937066864, 0.0],
        axis = [0.0, 0.0, 1.0]
    )]
    e_lower: PointOnLine,
    #[force(between = [ground, crank], moment = [0.0, 0.0, 0.033])]
    motor: ConstantMoment,
    #[force(
        between = [ground, triangle],
        head = [0.014, 0.072, 0.0],
        tail = [-0.010472393888814626, 0.025357788530275246, 0.0],
        stiffness = 4530.0,
        free_length = 0.07785
    )]
    spring: SpringDamper,
}

impl SqueezingMechanism {
    /// The coordinates of the Test Set at the start, in its order beta, Theta, gamma, phi, delta,
    /// Omega, epsilon (rad).
    pub const START: [f64; 7] = [
        -0.061_713_890_014_276_45,
        0.0,
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_88,
        0.487_364_979_543_842_56,
        -0.222_668_390_165_885_88,
        1.230_547_444_549_821_3,
    ];

    /// The coordinates of the Test Set, in the order of [`Self::START`], without whole turns (rad),
    /// and their rates (rad/s).
    #[must_use]
    pub fn coordinates(view: &View<'_, f64, Self>) -> [[f64; 7]; 2] {
        let h = Self::HANDLES;
        let hinges = [h.o, h.f, h.b, h.g, h.a_upper, h.h, h.a_lower];
        let mut angles = hinges.map(|hinge| view.angle(hinge));
        for (angle, start) in angles.iter_mut().zip(Self::START) {
            *angle += start;
        }
        [angles, hinges.map(|hinge| view.angle_rate(hinge))]
    }
}
