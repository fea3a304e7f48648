//! The planar slider-crank, free and driven.

use holonom::prelude::*;

/// A slider-crank at 150 rad/s, stretched along x at the start, gravity along -y.
///
#[doc = include_str!("sketches/slider_crank.svg")]
///
/// ```text
///     y
///     |     crank         rod
///     o-----------o---------------------[o]--  x     stretched, z towards the reader
///     bearing     crank_pin             slider_pin, on the slider's guide
///     |  g = 9.81 m/s^2
///     v
/// ```
///
/// Flores, Leine and Glocker, *Modeling and analysis of planar rigid multibody systems with
/// translational clearance joints based on the non-smooth dynamics approach*, Multibody System
/// Dynamics 23 (2010), with joints without clearance: crank 0.153 m, 0.038 kg, 7.4e-5 kg m^2; rod
/// 0.306 m, 0.038 kg, 5.9e-4 kg m^2; slider 0.076 kg, 2.7e-6 kg m^2, its centre of mass on its pin;
/// centres of mass of crank and rod in the middle; `g = 9.81` m/s^2. The crank starts at 150 rad/s,
/// the rod at -75 rad/s. Moments of inertia about other axes than z do not act: they are ours.
///
/// The loop is closed by the two equations in its plane alone (the slider's pin is a
/// [`PointOnLine`]): all 17 equations are independent, and the reactions are unique.
///
/// Good for: a loop at high speed; conservation of energy (7.49554875 J from the crank's axis).
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct SliderCrank {
    #[body(
        mass = 0.038,
        inertia = [7.4e-5, 7.4e-5, 7.4e-5],
        position = [0.0765, 0.0, 0.0],
        velocity = [0.0, 150.0 * 0.0765, 0.0],
        angular_velocity = [0.0, 0.0, 150.0]
    )]
    crank: Body,
    #[body(
        mass = 0.038,
        inertia = [5.9e-4, 5.9e-4, 5.9e-4],
        position = [0.306, 0.0, 0.0],
        velocity = [0.0, 75.0 * 0.153, 0.0],
        angular_velocity = [0.0, 0.0, -75.0]
    )]
    rod: Body,
    #[body(mass = 0.076, inertia = [2.7e-6, 2.7e-6, 2.7e-6], position = [0.459, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [0.153, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_pin: Revolute,
    #[joint(between = [ground, slider], point = [0.459, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [0.459, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    slider_pin: PointOnLine,
}

/// The [`SliderCrank`] with a motor on its crank, whose angle is `150 t + 0.2 (1 - cos(75 t))` rad.
///
#[doc = include_str!("sketches/driven_slider_crank.svg")]
///
/// Geometry and masses: Flores, Leine and Glocker 2010, see there; the motion is ours: it starts as
/// the free mechanism does, and its speed varies by 10 % of the mean.
///
/// Good for: inverse dynamics, as nothing is left free. The moment of the motor has a closed form,
/// `I(theta) theta'' + I'(theta) theta'^2 / 2 + V'(theta)`, with `I` the inertia of everything
/// reduced to the crank and `V` the potential energy.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both")]
pub struct DrivenSliderCrank {
    #[body(
        mass = 0.038,
        inertia = [7.4e-5, 7.4e-5, 7.4e-5],
        position = [0.0765, 0.0, 0.0],
        velocity = [0.0, 150.0 * 0.0765, 0.0],
        angular_velocity = [0.0, 0.0, 150.0]
    )]
    crank: Body,
    #[body(
        mass = 0.038,
        inertia = [5.9e-4, 5.9e-4, 5.9e-4],
        position = [0.306, 0.0, 0.0],
        velocity = [0.0, 75.0 * 0.153, 0.0],
        angular_velocity = [0.0, 0.0, -75.0]
    )]
    rod: Body,
    #[body(mass = 0.076, inertia = [2.7e-6, 2.7e-6, 2.7e-6], position = [0.459, 0.0, 0.0])]
    slider: Body,
    #[joint(between = [ground, crank], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    bearing: Revolute,
    #[joint(between = [crank, rod], point = [0.153, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    crank_pin: Revolute,
    #[joint(between = [ground, slider], point = [0.459, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    guide: Prismatic,
    #[joint(between = [slider, rod], point = [0.459, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    slider_pin: PointOnLine,
    #[joint(
        between = [ground, crank],
        axis = [0.0, 0.0, 1.0],
        motion = 150.0 * time + 0.2 * (1.0 - cos(75.0 * time))
    )]
    motor: AngleDriver,
}
