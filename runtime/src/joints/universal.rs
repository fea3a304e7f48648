//! The universal joint.

crate::joint! {
    /// A universal joint (Cardan, Hooke): the points of both bodies coincide, and the arm of the
    /// cross that `i` carries stays perpendicular to the arm that `j` carries; two rotations are
    /// left, one about each arm.
    ///
    /// `axis_i` and `axis_j` are perpendicular in the reference configuration (Nikravesh 1988,
    /// section 7.2.2; Flores 2015, section 8.4). With the angles `a` about `axis_i` and `b` about
    /// `axis_j`, `j` is turned against `i` by the rotation by `a` after the one by `b`, both about
    /// the axes of the reference configuration.
    #[doc(alias("Cardan", "Hooke", "UniversalJoint"))]
    pub joint Universal(i, j; point: Point, axis_i: Axis, axis_j: Axis) {
        j.point - i.point;
        dot(i.axis_i, j.axis_j);
        angle about axis_i, axis_j;
        motion turn axis_i at point, turn axis_j at point;
    }
}
