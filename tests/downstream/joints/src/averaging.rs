//! Joints between three bodies.

kinematics::joint! {
    /// A point of the third body stays in the middle between a point of the first and a point of
    /// the second.
    pub joint Midpoint(i, j, k; left: Point, right: Point, middle: Point) {
        k.middle - 0.5 * (i.left + j.right);
    }
}

kinematics::joint! {
    /// The directions fixed on three bodies stay in one plane.
    pub joint Coplanar(i, j, k; first: Axis, second: Axis, third: Vector) {
        dot(cross(i.first, j.second), -k.third);
    }
}
