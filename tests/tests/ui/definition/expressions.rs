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
        i.axis.normal();
        length / 2.0;
        length == 2.0;
        !length;
        "length";
        [1.0, 0.0, 0.0];
        if length { 1.0 } else { 2.0 };
    }
}

fn main() {}
