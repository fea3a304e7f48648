//! Constants that are no splines: the compiler sees their numbers.

use holonom::joints::{AngleDriver, Revolute};
use holonom::prelude::*;

const BACK: Spline<3> = Spline::natural([0.0, 2.0, 1.0], [0.0, 1.0, 2.0]);
static OPEN: Spline<3> = Spline::periodic([0.0, 1.0, 2.0], [0.0, 1.0, 2.0]);

#[derive(Mechanism)]
struct Wheel {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Revolute,
    #[joint(
        between = [ground, rod], axis = [1.0, 0.0, 0.0],
        motion = BACK(time) + OPEN(time)
    )]
    motor: AngleDriver,
}

fn main() {}
