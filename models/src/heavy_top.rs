//! The heavy top.

use holonom::prelude::*;

/// A fast top on a ball joint at the origin, its axis in the horizontal at the start, gravity along
/// -z.
///
#[doc = include_str!("sketches/heavy_top.svg")]
///
/// ```text
///        z
///        |
///        o--------(top)  y     tip in the origin, axis along y; x towards the reader
///        |  g = 9.81 m/s^2
///        v
/// ```
///
/// Brüls, Cardona and Arnold, *Lie group generalized-alpha time integration of constrained flexible
/// multibody systems*, Mechanism and Machine Theory 48 (2012): `m = 15` kg,
/// `J = (0.234375, 0.46875, 0.234375)` kg m^2 about the centre of mass, which is 1 m from the fixed
/// point; the top spins at 150 rad/s about its axis, which starts at -4.61538 rad/s about z.
///
/// It is drawn as the thin disc of 0.25 m that has these moments, on a rod.
///
/// Good for: large rotations and Euler parameters, 24 turns a second; the order of convergence of
/// an integrator. The energy, 5435.696790865547 J, the angular momentum about z, -70.3124296875 kg
/// m^2/s, and the spin of 150 rad/s about the axis stay.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct HeavyTop {
    #[body(
        mass = 15.0,
        inertia = [0.234375, 0.46875, 0.234375],
        position = [0.0, 1.0, 0.0],
        velocity = [4.61538, 0.0, 0.0],
        angular_velocity = [0.0, 150.0, -4.61538],
        shapes = [
            disc(radius = 0.25, thickness = 0.02, at = [0.0, 1.0, 0.0], axis = [0.0, 1.0, 0.0]),
            rod(radius = 0.01, from = [0.0, 0.0, 0.0], to = [0.0, 1.0, 0.0]),
        ]
    )]
    top: Body,
    #[joint(between = [ground, top], point = [0.0, 0.0, 0.0])]
    tip: Spherical,
}
