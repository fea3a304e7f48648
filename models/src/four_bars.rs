//! Rows of four-bars.

use holonom::prelude::*;

use crate::FourBar;

/// Two parallelograms in a row with one upright link in common, as [`FourBar`] otherwise: N = 2.
///
#[doc = include_str!("sketches/double_four_bar.svg")]
///
/// Problem A02 of the IFToMM library as it stands there ("double four-bar"), 10 s. 35 equations, of
/// which 6 are dropped; the links lie on one line for the first time after 0.71436 s.
///
/// Good for: what the [`FourBar`] is good for, with three ways to go on in the singular
/// configurations.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both", kernels = [mass, inverse])]
pub struct DoubleFourBar {
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
    left_coupler: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [1.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    middle: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [1.5, 1.0, 0.0],
        velocity = [1.0, 0.0, 0.0]
    )]
    right_coupler: Body,
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [2.0, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    right: Body,
    #[joint(between = [ground, left], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_foot: Revolute,
    #[joint(between = [left, left_coupler], point = [0.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_pin: Revolute,
    #[joint(between = [ground, middle], point = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    middle_foot: Revolute,
    #[joint(between = [left_coupler, middle], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    middle_pin: Revolute,
    #[joint(between = [middle, right_coupler], point = [1.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    second_middle_pin: Revolute,
    #[joint(between = [ground, right], point = [2.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_foot: Revolute,
    #[joint(between = [right_coupler, right], point = [2.0, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_pin: Revolute,
}

impl DoubleFourBar {
    /// The upper end of an upright link in its axes, from its centre of mass (m). The sheets
    /// compare that of `left`.
    pub const TOP: [f64; 3] = FourBar::TOP;
}

/// Five parallelograms in a row, as [`FourBar`] otherwise: N = 5.
///
#[doc = include_str!("sketches/quintuple_four_bar.svg")]
///
/// 80 equations, of which 15 are dropped; the links lie on one line for the first time after
/// 0.71869 s.
///
/// Good for: what the [`FourBar`] is good for, with six ways to go on in the singular
/// configurations; and as an example of arrays of bodies and joints: rod `k` stands on the ground
/// at `x = k`, top `k` joins it to the next.
#[derive(Clone, Copy, Debug, Mechanism)]
#[mechanism(gravity = [0.0, -9.81, 0.0], redundant = "drop", coordinates = "both")]
pub struct QuintupleFourBar {
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [k, 0.5, 0.0],
        velocity = [0.5, 0.0, 0.0],
        angular_velocity = [0.0, 0.0, -1.0]
    )]
    rods: [Body; 6],
    #[body(
        mass = 1.0,
        inertia = [1.0 / 12.0, 1.0 / 12.0, 1.0 / 12.0],
        position = [k + 0.5, 1.0, 0.0],
        velocity = [1.0, 0.0, 0.0]
    )]
    tops: [Body; 5],
    #[joint(between = [ground, rods[k]], point = [k, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    feet: [Revolute; 6],
    #[joint(between = [rods[k], tops[k]], point = [k, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    left_pins: [Revolute; 5],
    #[joint(between = [tops[k], rods[k + 1]], point = [k + 1, 1.0, 0.0], axis = [0.0, 0.0, 1.0])]
    right_pins: [Revolute; 5],
}

impl QuintupleFourBar {
    /// The upper end of an upright link in its axes, from its centre of mass (m). The sheets
    /// compare that of the first.
    pub const TOP: [f64; 3] = FourBar::TOP;
}
