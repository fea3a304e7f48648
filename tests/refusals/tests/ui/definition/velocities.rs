//! Equations of velocities that are not linear in them, and rates where none belong.

use holonom::prelude::*;

holonom::joint! {
    /// Squares, functions, products, laws.
    joint Bent(i, j; point: Point, axis: Axis, law: Law(x)) {
        let slip = rate(j.point - i.point);
        squared(slip);
        length(slip) - 1.0;
        sin(rate(angle(i, j, axis)));
        dot(i.axis, slip) * rate(angle(i, j, axis));
        cross(slip, angular_velocity(j));
        law(rate(angle(i, j, axis)));
        drive squared(slip) to time;
        1.0 / rate(angle(i, j, axis));
    }
}

holonom::joint! {
    /// A reading, a side and a constant that are rates; nothing that moves.
    joint Misplaced(i, j; point: Point, axis: Axis, length: Length = rate(2.0)) {
        dot(i.axis, rate(j.point - i.point));
        displacement dot(i.axis, rate(j.point));
        require dot(i.axis, rate(j.point)) > 0;
        rate(rate(j.point));
        fixed(i, rate(j.point));
        rate(time);
        angular_velocity(j) + rate(angle(i, j, axis));
        angular_velocity(i, j, axis);
        angular_velocity(axis);
    }
}

/// A particle does not turn.
#[derive(Mechanism)]
struct Turning {
    #[body(mass = 1.0)]
    ball: Particle,
    #[joint(between = [ground, ball], point = [0.0, 0.0, 0.0])]
    rolls: Rolls,
}

holonom::joint! {
    joint Rolls(i, j; point: Point) {
        angular_velocity(j);
    }
}

fn main() {}
