//! The planar joint.

crate::joint! {
    /// Two planes stay on each other: `j` slides on a plane of `i` and turns about its normal; two
    /// translations and a rotation are left (Flores 2015, section 8.7).
    #[doc(alias("PlanarJoint"))]
    pub joint Planar(i, j; point: Point, normal: Axis) {
        dot(i.normal.normals(), j.normal);
        dot(i.normal, j.point - i.point);
        require dot(i.normal, j.normal) > 0;
        motion slide normal.normal(), slide normal.binormal(), turn normal at point;
    }
}
