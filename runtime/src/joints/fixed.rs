//! The fixed joint.

crate::joint! {
    /// A weld: `j` moves with `i`; no motion is left.
    ///
    /// The points coincide, and three pairs of vectors, along the global axes in the reference
    /// configuration, stay perpendicular.
    #[doc(alias("Weld", "WeldJoint", "FixedJoint"))]
    pub joint Fixed(i, j; point: Point) {
        j.point - i.point;
        let x = [1.0, 0.0, 0.0];
        let y = [0.0, 1.0, 0.0];
        let z = [0.0, 0.0, 1.0];
        dot(fixed(i, y), fixed(j, x));
        dot(fixed(i, z), fixed(j, x));
        dot(fixed(i, y), fixed(j, z));
        motion none;
        require dot(fixed(i, x), fixed(j, x)) > 0;
        require dot(fixed(i, y), fixed(j, y)) > 0;
        require dot(fixed(i, z), fixed(j, z)) > 0;
    }
}
