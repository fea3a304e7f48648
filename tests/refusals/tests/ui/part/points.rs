//! What is wrong with a named point.
use holonom::prelude::*;

#[derive(Mechanism)]
struct Robot {
    #[body(mass = 1.0, inertia = [0.1, 0.1, 0.1], free)]
    hull: Body,
    #[body(mass = 1.0, free)]
    bead: Particle,
    #[input]
    reach: f64,
    // Neither body nor place.
    #[point]
    first: Point,
    // No such body, and no such key.
    #[point(on = hul, at = [0.0, 0.0, 0.0], axis = [1.0, 0.0, 0.0])]
    second: Point,
    // A particle has no orientation.
    #[point(on = bead, at = [0.0, 0.0, 0.1])]
    third: Point,
    // A point does not move on its body, and has three numbers.
    #[point(on = hull, at = [reach, 0.0, 0.0])]
    fourth: Point,
    #[point(on = hull, at = [0.0, 0.0])]
    fifth: Point,
    // Another type.
    #[point(on = hull, at = [0.0, 0.0, 0.0])]
    sixth: Body,
    // A point is no axis.
    #[point(on = hull, at = [0.0, 0.0, 0.2])]
    tool: Point,
    #[joint(between = [ground, hull], point = tool, axis = tool)]
    hinge: Revolute,
    // What is wrong with a point is said once.
    #[joint(between = [ground, hull], point = fifth)]
    other: Spherical,
    #[joint(between = [ground, hull], point = tol)]
    ball: Spherical,
}

fn main() {
    let _ = Robot::HANDLES.tool;
}
