//! The pendulum of chapter 15.

use holonom::prelude::*;

/// A steel rod of 1 m x 30 mm x 30 mm on a hinge at one end, at rest in the horizontal, gravity
/// along -z.
///
#[doc = include_str!("sketches/rod_pendulum.svg")]
///
/// ```text
///       z
///       |
///       +=======o=======  y     rod along y, hinge about x in the origin; x towards the reader
///       |  g = 9.81 m/s^2
///       v
/// ```
///
/// Flores, *Concepts and Formulations for Spatial Multibody Dynamics* (2015), chapter 15, table
/// 15.1: `m = 7.02` kg, `J = (0.5855265, 0.0010530, 0.5855265)` kg m^2 about the centre of mass,
/// which is 0.5 m from the hinge. The rod starts along +y, the hinge's axis is x.
///
/// Good for: the comparison of formulations in the book; reactions.
///
/// The angle of `pivot` is zero at the start and falls: `angle = phi - pi/2` with `phi` the angle
/// of the chapter's closed form, from the downward vertical.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct RodPendulum {
    #[body(mass = 7.02, inertia = [0.5855265, 0.0010530, 0.5855265], position = [0.0, 0.5, 0.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
}

impl RodPendulum {
    /// The period (s), in elliptic functions.
    pub const PERIOD: f64 = 1.933_552_342_311_354_3;
}
