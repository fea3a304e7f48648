//! The cylindrical joint.

crate::joint! {
    /// A shaft in a sleeve: an axis of `j` stays on an axis of `i`; a rotation about it and a
    /// translation along it are left.
    ///
    /// Two constraints of parallelism, of the axes and of the axis and the line that joins the
    /// points (Nikravesh 1988, section 7.2.4; Flores 2015, section 8.5). The displacement is that
    /// of `j`'s point along the axis, zero in the reference configuration.
    #[doc(alias("CylindricalJoint", "Sleeve"))]
    pub joint Cylindrical(i, j; point: Point, axis: Axis) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        angle about axis;
        require dot(i.axis, j.axis) > 0;
        displacement dot(i.axis, j.point - i.point);
        motion turn axis at point, slide axis;
    }
}
