//! Points on lines and planes.

crate::joint! {
    /// A point of `j` stays on a line of `i`, which passes through the point along `axis`; four
    /// motions are left (Flores 2015, section 8.9). The displacement is that of the point along the
    /// line, zero in the reference configuration.
    pub joint PointOnLine(i, j; point: Point, axis: Axis) {
        dot(i.axis.normals(), j.point - i.point);
        displacement dot(i.axis, j.point - i.point);
        motion slide axis, ball at point;
    }
}

crate::joint! {
    /// A point of `j` stays in a plane of `i`, which passes through the point perpendicular to
    /// `normal`; five motions are left.
    pub joint PointOnPlane(i, j; point: Point, normal: Axis) {
        dot(i.normal, j.point - i.point);
        motion slide normal.normal(), slide normal.binormal(), ball at point;
    }
}
