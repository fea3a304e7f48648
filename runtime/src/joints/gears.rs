//! Gears and racks.

crate::joint! {
    /// Two gears on a carrier `k`: `j` turns by `ratio` times the angle by which `i` turns, both
    /// against `k` and about axes fixed on it. Parallel axes that point the same way:
    /// `ratio = -(teeth of i) / (teeth of j)`, positive for an internal gear. Bevel gears have axes
    /// of any direction.
    ///
    /// Only this equation: that the gears turn about these axes is for other joints to say (a
    /// `Revolute` of each with `k`, which may be the ground; so may a gear, as the fixed ring of a
    /// planetary set). Turns are counted by auxiliary variables of the state (Nikravesh 1988,
    /// section 7.2.6).
    pub joint Gear(i, j, k; axis_i: Axis, axis_j: Axis, ratio: Number) {
        angle(k, j, axis_j) - ratio * angle(k, i, axis_i);
    }
}

crate::joint! {
    /// A pinion `i` that turns on the carrier `k` about `axis`, and a rack `j` that slides on it
    /// along `slide`: the point of the rack moves by `radius` (m) times the angle of the pinion.
    /// Negative where the rack moves against `slide` as the pinion turns right-handed about `axis`.
    ///
    /// Only this equation: a `Revolute` of the pinion and a `Prismatic` of the rack with `k`, which
    /// may be the ground, say the rest. Turns are counted by an auxiliary variable of the state.
    pub joint RackAndPinion(i, j, k; axis: Axis, point: Point, slide: Axis, radius: Length) {
        dot(k.slide, j.point - k.point) - radius * angle(k, i, axis);
    }
}
