//! The screw joint.

crate::joint! {
    /// A screw: an axis of `j` stays on an axis of `i`, and `j` moves along it by `pitch` (m) for
    /// every right-handed turn about it; one motion is left. Negative for a left-handed thread.
    ///
    /// A cylindrical joint and an equation between its displacement and its angle; turns are
    /// counted by an auxiliary variable of the state (Nikravesh 1988, section 7.2.6).
    #[doc(alias("Helical", "ScrewJoint"))]
    pub joint Screw(i, j; point: Point, axis: Axis, pitch: Length) {
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        dot(i.axis, j.point - i.point) - pitch / TAU * angle(i, j, axis);
        angle about axis;
        motion screw axis at point by pitch;
        require dot(i.axis, j.axis) > 0;
        displacement dot(i.axis, j.point - i.point);
    }
}
