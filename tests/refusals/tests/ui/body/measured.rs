use holonom::joints::Revolute;
use holonom::prelude::*;

/// Two links of a Puma 560 as published (Armstrong, Khatib and Burdick 1986): a mass, moments.
#[derive(Mechanism)]
struct Puma {
    #[body(mass = 0.0, inertia = [0.0, 0.35, 0.0])]
    first: Body,
    #[body(mass = 4.8, inertia = [0.066, 0.086, 0.0125])]
    third: Body,
    #[joint(between = [ground, first], point = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0])]
    waist: Revolute,
    #[joint(between = [first, third], point = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0])]
    elbow: Revolute,
}

fn main() {}
