//! The planar simple pendulum.

use holonom::prelude::*;

/// A point mass of 1 kg on a massless link of 1 m, released from the horizontal at -x, gravity
/// along -y, moving in the xy plane.
///
#[doc = include_str!("sketches/simple_pendulum.svg")]
///
/// ```text
///     y
///     |
/// o---+--- x     the link along -x at the start, the pivot in the origin; z towards the reader
///     |  g = 9.81 m/s^2
///     v
/// ```
///
/// Problem A01 of the library of the IFToMM Technical Committee for Multibody Dynamics, 10 s long
/// there; the sheet of 2005 (Universidade da Coruña) starts at +x and runs for 2000 s.
///
/// Good for: long runs against a closed form, `sin(phi/2) = sin(phi0/2) cd(w0 t)` of modulus
/// `sin(phi0/2)` with `w0 = sqrt(9.81)` 1/s and `phi` from the downward vertical; the smallest
/// mechanism with a constraint that is not linear.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct SimplePendulum {
    #[body(mass = 1.0, position = [-1.0, 0.0, 0.0])]
    bob: Particle,
    #[joint(between = [ground, bob], head = [0.0, 0.0, 0.0], tail = [-1.0, 0.0, 0.0], length = 1.0)]
    link: Distance,
    #[joint(between = [ground, bob], point = [-1.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0])]
    plane: PointOnPlane,
}

impl SimplePendulum {
    /// The period (s): `4 K(1/2) / w0`.
    pub const PERIOD: f64 = 2.367_841_947_576_237_4;
}
