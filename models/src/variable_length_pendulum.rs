//! The variable-length pendulum.

use holonom::prelude::*;

/// An arm on a hinge with a torsional spring, and a slider along it on a spring and a damper,
/// released 60 degrees from the vertical.
///
#[doc = include_str!("sketches/variable_length_pendulum.svg")]
///
/// ```text
///     y
///     |
///     o------ x      pin in the origin, with the torsional spring; z towards the reader
///     | \             arm: phi = 60 degrees from the downward vertical, towards +x
///     |   \           slider on the arm, its spring and damper between pin and slider
///     v     []
///     g = 9.81 m/s^2
/// ```
///
/// Nikravesh, *Planar Multibody Dynamics*, examples 13.6 and 13.7. The arm: 2 kg, 0.04 kg m^2 about
/// z, its centre of mass 0.5 m from the pin; the slider: 1 kg, 0.1 kg m^2, at 0.8 m at the start.
/// The torsional spring: 6 N m/rad, relaxed in the vertical; the spring from the pin to the
/// slider's centre: 20 N/m, 0.7 m, with a damper of 5 N s/m. The body axes y point from the centres
/// of mass to the pin. Moments of inertia about x and y do not act in the plane: they are ours.
///
/// The book starts from positions of four digits, (0.4330, -0.2500) and (0.6928, -0.4000), a
/// violation of 1e-5, to show what a formulation does with it; here the start is exact. The book's
/// parameters: Baumgarte `alpha = beta = 5` 1/s, penalty with a mass of 1000 kg, damping ratio 1
/// and 20 pi rad/s.
///
/// Good for: comparing formulations where springs and dampers act and energy is lost.
///
/// The angle of `pin` is zero at the start: `angle = phi - pi/3` with `phi` from the downward
/// vertical.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct VariableLengthPendulum {
    #[body(
        mass = 2.0,
        inertia = [0.04, 0.04, 0.04],
        position = [0.5 * sin(deg(60.0)), -0.5 * cos(deg(60.0)), 0.0],
        orientation = rotation([0.0, 0.0, 1.0], deg(60.0))
    )]
    arm: Body,
    #[body(
        mass = 1.0,
        inertia = [0.1, 0.1, 0.1],
        position = [0.8 * sin(deg(60.0)), -0.8 * cos(deg(60.0)), 0.0],
        orientation = rotation([0.0, 0.0, 1.0], deg(60.0))
    )]
    slider: Body,
    #[joint(between = [ground, arm], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    pin: Revolute,
    #[joint(between = [arm, slider], point = [0.0, 0.0, 0.0], axis = [-sin(deg(60.0)), cos(deg(60.0)), 0.0])]
    guide: Prismatic,
    #[force(between = [ground, arm], axis = [0.0, 0.0, 1.0], stiffness = 6.0, free_angle = deg(-60.0))]
    torsion: TorsionalSpringDamper,
    #[force(
        between = [ground, slider],
        head = [0.0, 0.0, 0.0],
        tail = [0.8 * sin(deg(60.0)), -0.8 * cos(deg(60.0)), 0.0],
        stiffness = 20.0,
        damping = 5.0,
        free_length = 0.7
    )]
    spring: SpringDamper,
}
