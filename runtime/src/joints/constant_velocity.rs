//! The constant-velocity joint.

crate::joint! {
    /// A constant-velocity joint (Rzeppa): the points of both shafts coincide, and `j` does not
    /// turn against `i` about the line that bisects the shafts, so that both turn at one rate at
    /// any angle between them; two rotations are left.
    ///
    /// `axis_i` and `axis_j` are the directions of the shafts, pointing the same way; at less than
    /// a right angle in the reference configuration. With `n`, `b` perpendicular to the axis of
    /// `i`, and the same turned by the least rotation that takes one axis to the other for `j`, the
    /// equation is `b_i . n_j = n_i . b_j`: the relative rotation has no part about the shaft (Haug
    /// 1989, section 9.4).
    #[doc(alias("Homokinetic", "CvJoint"))]
    pub joint ConstantVelocity(i, j; point: Point, axis_i: Axis, axis_j: Axis) {
        j.point - i.point;
        let bisector = i.axis_i + j.axis_j;
        let scale = 1.0 + dot(i.axis_i, j.axis_j);
        let n_i = i.axis_i.normal();
        let b_i = i.axis_i.binormal();
        let n_j = fixed(j, n_i - (dot(n_i, j.axis_j) / scale) * bisector);
        let b_j = fixed(j, b_i - (dot(b_i, j.axis_j) / scale) * bisector);
        dot(b_i, n_j) - dot(n_i, b_j);
        require dot(n_i, n_j) + dot(b_i, b_j) > 0;
    }
}
