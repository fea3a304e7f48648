//! How a screw moves.

holonom::joint! {
    /// Words, an axis, a point and a length.
    pub joint Words(i, j; point: Point, axis: Axis, pitch: Length, size: Number) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        dot(i.axis, j.point - i.point) - pitch / TAU * angle(i, j, axis);
        motion screw, screw axis, screw axis at point, screw axis by pitch, screw at point by pitch,
            screw axis at by pitch, screw axis at point by, screw axis.normal() at point by pitch,
            screw axis at point by size, screw axis at point by 0.1, screw axis at point by j.pitch,
            screw pitch at axis by point, screw axis at point by pich, screws axis at point by pitch;
    }
}

holonom::joint! {
    /// Without turns that are counted.
    pub joint Uncounted(i, j; point: Point, axis: Axis, pitch: Length) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        angle about axis;
        motion screw axis at point by pitch;
    }
}

holonom::joint! {
    /// With a thread of the other hand.
    pub joint Left(i, j; point: Point, axis: Axis, pitch: Length) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        dot(i.axis, j.point - i.point) + pitch / TAU * angle(i, j, axis);
        motion screw axis at point by pitch;
    }
}

fn main() {
    let _ = (Words, Uncounted, Left);
}
