//! The fixed joint.

crate::joint! {
    /// A weld: `j` moves with `i`; no motion is left.
    ///
    /// The points coincide, and three pairs of vectors, along the global axes in the described configuration, stay perpendicular.
    pub joint Fixed(i, j; point: Point) {
        j.point - i.point;
        dot(fixed(i, [1.0, 0.0, 0.0]), fixed(j, [0.0, 1.0, 0.0]));
        dot(fixed(i, [0.0, 1.0, 0.0]), fixed(j, [0.0, 0.0, 1.0]));
        dot(fixed(i, [0.0, 0.0, 1.0]), fixed(j, [1.0, 0.0, 0.0]));
    }
}
