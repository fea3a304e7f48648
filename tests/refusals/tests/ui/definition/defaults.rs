//! Defaults and laws in a signature.

holonom::joint! {
    pub joint Defaults(
        i,
        j;
        point: Point = [0.0, 0.0, 0.0],
        axis: Axis = i.axis,
        motion: Law = time,
        moving: Length = length(j.point - i.point),
        timed: Angle = 2.0 * time,
        vector: Length = i.point,
        named: Number = unknown,
        called: Number(x) = 1.0,
        text: Number = "one"
    ) {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Laws(i, j; axis: Axis, motion: Law, curve: Law(x, y), twice: Law(x, x), clock: Law(time)) {
        dot(i.axis, j.axis) - motion;
        dot(i.axis, j.axis) - motion(time);
        dot(i.axis, j.axis) - curve(time);
        dot(i.axis, j.axis) - curve;
        dot(i.axis, j.axis) - curve(i.axis, j.axis);
        dot(i.axis, j.axis) - mtion();
        motion;
    }
}

holonom::joint! {
    pub joint Unread(i, j; count: Number =, number: Law(3), more: Number = 1.0 2.0) {
        dot(i.axis, j.axis) - count;
    }
}

fn main() {}
