//! Lists that cannot be read; what can be is still checked.

use holonom::joints::Revolute;
use holonom::prelude::*;

#[derive(Mechanism)]
struct Garbled {
    #[body(mass 7.02, inertia = [1.0, 1.0, 1.0], free)]
    equals: Body,
    #[body(mass = 7.02 inertia = [1.0, 1.0, 1.0], free)]
    comma: Body,
    #[body(mass = , inertia = [1.0, 1.0, 1.0], free)]
    value: Body,
    #[body(mass = 2.0 *, inertia = [1.0, , 1.0], free)]
    operand: Body,
    #[body(mass = 1.0,, inertia = [1.0, 1.0, 1.0], free)]
    commas: Body,
    #[body(7.02, inertia = [1.0, 1.0, 1.0], free)]
    key: Body,
    #[body = 7.02]
    assigned: Body,
    #[body[mass = 7.02]]
    bracketed: Body,
    #[joint(between = [ground, equals]; point = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    semicolon: Revolute,
}

fn main() {}
