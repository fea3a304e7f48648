//! The door on two hinges.

use holonom::prelude::*;

/// A door on two hinges whose common axis leans 10 degrees from the vertical, released 90 degrees
/// from where it would come to rest.
///
#[doc = include_str!("sketches/door.svg")]
///
/// ```text
///     z
///     |   o    upper hinge        the edge with the hinges leans by 10 degrees from z towards +x;
///     |  /                        the leaf stretches from it along y at the start, across the page,
///     | o      lower hinge        and would rest in the page, under the edge, on the side of +x
///     |/
///     +------ x                   g = 9.81 m/s^2 along -z
/// ```
///
/// Own data: a box of 0.8 m (width, y) x 2 m (height, z) x 0.04 m (x) and 20 kg, hinged on one edge
/// at the heights 0.25 m and 1.75 m; the edge starts in the origin and leans towards +x; gravity
/// 9.81 m/s^2 along -z.
///
/// Two hinges say everything twice: 10 equations, of which 5 are dropped, so that one of the hinges
/// carries all of the reaction. Which one carries how much, rigid bodies cannot tell.
///
/// Good for: redundant equations in the smallest form. A physical pendulum,
/// `I phi'' = -m g sin(10 deg) d sin(phi)` with `I = 4.269333` kg m^2, `d = 0.4` m. The angle of
/// either hinge is zero at the start: `angle = phi - pi/2`, `phi` from the position at rest.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, 0.0, -9.81], redundant = "drop", coordinates = "both", kernels = [mass, inverse, jacobian])]
pub struct Door {
    #[body(
        mass = 20.0,
        inertia = [
            20.0 * (0.8 * 0.8 + 2.0 * 2.0) / 12.0,
            20.0 * (0.04 * 0.04 + 2.0 * 2.0) / 12.0,
            20.0 * (0.8 * 0.8 + 0.04 * 0.04) / 12.0
        ],
        position = [sin(deg(10.0)), 0.4, cos(deg(10.0))],
        orientation = rotation([0.0, 1.0, 0.0], deg(10.0)),
        shape = block(size = [0.04, 0.8, 2.0], at = [sin(deg(10.0)), 0.4, cos(deg(10.0))])
    )]
    leaf: Body,
    #[joint(
        between = [ground, leaf],
        point = [0.25 * sin(deg(10.0)), 0.0, 0.25 * cos(deg(10.0))],
        axis = [sin(deg(10.0)), 0.0, cos(deg(10.0))]
    )]
    lower_hinge: Revolute,
    #[joint(
        between = [ground, leaf],
        point = [1.75 * sin(deg(10.0)), 0.0, 1.75 * cos(deg(10.0))],
        axis = [sin(deg(10.0)), 0.0, cos(deg(10.0))]
    )]
    upper_hinge: Revolute,
}

impl Door {
    /// The period (s), in elliptic functions.
    pub const PERIOD: f64 = 4.150_999_046_733_716;
}
