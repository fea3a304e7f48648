//! Composite joints: massless links between two bodies.

crate::joint! {
    /// A massless link with a hinge on `i` and a ball on `j`: the point `ball` of `j` keeps its
    /// distance from the point `hinge` and stays in the plane through it perpendicular to `axis`,
    /// both fixed on `i` (Nikravesh 1988, section 7.3.2).
    ///
    /// Where the ball lies beside that plane in the reference configuration, it stays as far from
    /// it.
    pub joint RevoluteSpherical(i, j; hinge: Point, axis: Axis, ball: Point) {
        let arm = j.ball - i.hinge;
        dot(i.axis, arm) - initial(dot(i.axis, arm));
        squared(arm) - initial(squared(arm));
    }
}

crate::joint! {
    /// A massless link with parallel hinges on both bodies: the axes stay parallel, the point
    /// `second` of `j` keeps its distance from the point `first` of `i` and stays in the plane
    /// through it perpendicular to the axis (Nikravesh 1988, section 7.3.2).
    ///
    /// Where the points are apart along the axis in the reference configuration, they stay as far
    /// apart.
    pub joint RevoluteRevolute(i, j; first: Point, second: Point, axis: Axis) {
        let arm = j.second - i.first;
        dot(i.axis.normals(), j.axis);
        dot(i.axis, arm) - initial(dot(i.axis, arm));
        squared(arm) - initial(squared(arm));
        require dot(i.axis, j.axis) > 0;
    }
}
