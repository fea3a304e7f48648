//! An alias names the type of a joint, not its definition.

use holonom::joints::Revolute;
use holonom::prelude::*;

type Hinge = Revolute;

#[derive(Mechanism)]
struct Aliased {
    #[body(mass = 1.0, inertia = [1.0, 1.0, 1.0])]
    rod: Body,
    #[joint(between = [ground, rod], point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    pivot: Hinge,
}

fn main() {}
