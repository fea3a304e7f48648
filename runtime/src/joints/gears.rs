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
    /// A pinion `i` turns on the carrier `k` about the line along `axis` through `hub`. A rack `j`
    /// slides on `k` along `slide`, by `radius` (m) times the angle of the pinion. The radius is
    /// negative where the rack moves against `slide` as the pinion turns right-handed about `axis`.
    /// A drum `i` with its load `j` on a rope that stays taut is the same.
    ///
    /// Rack and pinion push each other along `slide`, at `point`; where they meet there, the
    /// carrier feels nothing of it, and the bearing of the pinion carries the force.
    ///
    /// Only this equation: a `Revolute` of the pinion and a `Prismatic` of the rack with `k`, which
    /// may be the ground, say the rest. Turns are counted by an auxiliary variable of the state.
    pub joint RackAndPinion(
        i, j, k;
        axis: Axis,
        hub: Point,
        point: Point,
        slide: Axis,
        radius: Length,
    ) {
        let far = dot(k.slide, j.point - i.hub);
        far - initial(far) - radius * angle(k, i, axis);
    }
}
