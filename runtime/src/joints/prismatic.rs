//! The prismatic joint.

crate::joint! {
    /// A slide: an axis of `j` stays on an axis of `i` and does not turn about it; a translation
    /// along it is left.
    ///
    /// A cylindrical joint, and two vectors perpendicular to the axis stay perpendicular to each
    /// other (Nikravesh 1988, section 7.2.5; Flores 2015, section 8.6). The displacement is that of
    /// `j`'s point along the axis, zero in the reference configuration.
    #[doc(alias("Slider", "SliderJoint", "Slide", "Translational", "PrismaticJoint"))]
    pub joint Prismatic(i, j; point: Point, axis: Axis) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        dot(i.axis.normal(), j.axis.binormal());
        displacement dot(i.axis, j.point - i.point);
        motion slide axis;
        require dot(i.axis, j.axis) > 0;
        require dot(i.axis.binormal(), j.axis.binormal()) > 0;
    }
}
