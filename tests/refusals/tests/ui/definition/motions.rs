//! How a joint moves.

holonom::joint! {
    /// Words, directions and points.
    pub joint Words(i, j; point: Point, axis: Axis, size: Length) {
        j.point - i.point;
        motion twist axis at point, slid axis, turn point at axis, slide i.axis, ball at j.point, slide axes, slide size,
            turn axis, turn at point, slide axis at point, slide, ball point, , slide axis.normals(), slide axis.normal(1),
            slide axis.perpendicular(), slide -axis, ball at pont, ball at j, none, [1.0, 0.0, 0.0], slide axis axis;
    }
}

holonom::joint! {
    /// What stands behind `none`.
    pub joint Nothing(i, j; point: Point) {
        j.point - i.point;
        motion none at point;
    }
}

holonom::joint! {
    /// Said twice.
    pub joint Twice(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        dot(i.axis.normals(), j.axis);
        motion turn axis at point;
        motion turn axis at point;
    }
}

holonom::joint! {
    /// Of three bodies.
    pub joint Three(i, j, k; point: Point) {
        j.point - i.point;
        k.point - i.point;
        motion ball at point;
    }
}

holonom::joint! {
    /// A word alone.
    pub joint Alone(i, j; point: Point) {
        j.point - i.point;
        motion;
    }
}

holonom::joint! {
    /// A slide too many.
    pub joint Sliding(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        dot(i.axis.normals(), j.axis);
        motion turn axis at point, slide axis;
    }
}

holonom::joint! {
    /// About a wrong axis.
    pub joint Wrong(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        dot(i.axis.normals(), j.axis);
        motion turn axis.normal() at point;
    }
}

holonom::joint! {
    /// In the wrong order: the first arm carries the second.
    pub joint Order(i, j; point: Point, axis_i: Axis, axis_j: Axis) {
        j.point - i.point;
        dot(i.axis_i, j.axis_j);
        motion turn axis_j at point, turn axis_i at point;
    }
}

holonom::joint! {
    /// Too few, and a driver's equation.
    pub joint Few(i, j; point: Point, axis: Axis) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        drive angle(i, j, axis) to 0.0;
        motion none;
    }
}

holonom::joint! {
    /// One twice.
    pub joint Again(i, j; point: Point, axis: Axis) {
        dot(i.axis.normals(), j.point - i.point);
        motion slide axis, turn axis at point, ball at point;
    }
}

fn main() {
    let _ = (Words, Nothing, Twice, Three, Alone, Sliding, Wrong, Order, Few, Again);
}
