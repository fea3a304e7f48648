//! Expressions of the wrong shape.

holonom::joint! {
    /// Scalars and vectors do not mix.
    pub joint Shapes(i, j; point: Point, axis: Axis, vector: Vector, length: Length) {
        i.point - length;
        length + i.axis;
        i.axis * j.axis;
        dot(i.axis, length);
        cross(length, i.axis);
        squared(length);
        dot(i.axis);
        squared(i.axis, j.axis);
        i.axis.normals() - j.axis;
        dot(i.axis.normals(), j.axis) - length;
        cross(i.axis.normals(), i.axis) * 2.0 + i.axis;
        i.vector.normals();
        i.point.normals();
        i.vector.normal();
        i.axis.normals().binormal();
        i.axis.normal(1.0);
        i.axis / j.axis;
        length / i.axis;
        cross(i.axis, j.axis) / squared;
        length == 2.0;
        !length;
        "length";
        [1.0, 0.0];
        [1.0, i.axis, 0.0];
        [dot(i.axis.normals(), j.axis), 0.0, 0.0];
        if length { 1.0 } else { 2.0 };
    }
}

fn main() {}
