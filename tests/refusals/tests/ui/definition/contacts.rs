//! Contacts that are none.

holonom::joint! {
    /// What is no point and normal.
    pub joint Parts(i, j; center: Point, normal: Axis, radius: Length) {
        dot(i.normal, j.center);
        contact j.center - radius * i.normal;
        contact j.center, i.normal, i.normal;
        contact j.center, ;
    }
}

holonom::joint! {
    /// What is no vector, and what is no matter of places.
    pub joint Shapes(i, j; center: Point, normal: Axis, radius: Length, ramp: Law) {
        dot(i.normal, j.center);
        contact radius, i.normal;
        contact j.center, i.normal.normals();
        contact j.center + rate(j.center), i.normal;
        contact j.center, angular_velocity(j);
        contact j.center + ramp() * i.normal, i.normal;
        contact j.center, angle(i, j, normal) * i.normal;
    }
}

holonom::joint! {
    /// More than one.
    pub joint Twice(i, j; center: Point, normal: Axis) {
        dot(i.normal, j.center);
        contact j.center, i.normal;
        contact i.center, i.normal;
    }
}

holonom::joint! {
    /// Alone.
    pub joint Alone(i; center: Point, normal: Axis) {
        dot(i.normal, i.center);
        contact i.center, i.normal;
    }
}

holonom::force! {
    /// A force has none.
    pub force Push(i, j; axis: Axis, point: Point) {
        force i.axis at j.point;
        contact j.point, i.axis;
    }
}

fn main() {}
