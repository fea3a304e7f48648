//! Constraints between two vectors, of which joints are made (Nikravesh 1988, section 7.1; Flores
//! 2015, chapter 7).

crate::joint! {
    /// Perpendicular, type 1: an axis of `i` and an axis of `j` stay perpendicular.
    pub joint Perpendicular1(i, j; axis_i: Axis, axis_j: Axis) {
        dot(i.axis_i, j.axis_j);
    }
}

crate::joint! {
    /// Perpendicular, type 2: an axis of `i` stays perpendicular to the line from the point `head`
    /// of `i` to the point `tail` of `j`.
    pub joint Perpendicular2(i, j; axis: Axis, head: Point, tail: Point) {
        dot(i.axis, j.tail - i.head);
    }
}

crate::joint! {
    /// Parallel, type 1: an axis of `i` and an axis of `j` stay parallel, and go on pointing the
    /// same way, or opposite ways, as in the reference configuration.
    pub joint Parallel1(i, j; axis_i: Axis, axis_j: Axis) {
        dot(i.axis_i.normals(), j.axis_j);
        require initial(dot(i.axis_i, j.axis_j)) * dot(i.axis_i, j.axis_j) > 0;
    }
}

crate::joint! {
    /// Parallel, type 2: an axis of `i` stays parallel to the line from the point `head` of `i` to
    /// the point `tail` of `j`.
    pub joint Parallel2(i, j; axis: Axis, head: Point, tail: Point) {
        dot(i.axis.normals(), j.tail - i.head);
    }
}
