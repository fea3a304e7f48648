//! The revolute joint.

crate::joint! {
    /// A hinge: the points of both bodies coincide and the axes stay parallel; one rotation is
    /// left.
    ///
    /// The axis fixed on `j` stays perpendicular to two directions fixed on `i` that are
    /// perpendicular to the axis there (Nikravesh 1988, section 7.2.3; Flores 2015, section 8.3).
    #[doc(alias("Hinge", "HingeJoint", "Pin", "PinJoint", "RevoluteJoint"))]
    pub joint Revolute(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        dot(i.axis.normals(), j.axis);
        angle about axis;
        require dot(i.axis, j.axis) > 0;
        motion turn axis at point;
    }
}
