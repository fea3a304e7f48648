//! Rolling, and edges that do not move sideways: equations of velocities.

crate::joint! {
    /// The point of `j` does not move along `side`, a direction fixed on `j`, against `i`: the
    /// blade of a skate, a keel, a wheel that only steers. One equation of velocities; all
    /// configurations are left (Chaplygin's sleigh: Bloch 2003, section 1.7).
    ///
    /// That the blade stays in a plane is for another joint to say, such as `Planar`.
    pub joint KnifeEdge(i, j; point: Point, side: Axis) {
        let arm = j.point - i.point;
        let slip = rate(arm) - cross(angular_velocity(i), arm);
        dot(j.side, slip);
    }
}

crate::joint! {
    /// A wheel `j` rolls on a plane of `i` without slip, upright or leaning. The wheel has its
    /// `center` and its `axle`. The plane goes through `point`; its `normal` points to the wheel.
    /// `radius` (m) is that of the outermost circle. `crown` (m) is the radius of the section of
    /// the tyre: zero for a thin disc, else the wheel is a torus.
    ///
    /// One equation of positions: the wheel touches the plane. Two of velocities: the point of
    /// contact does not slip along the plane. Reactions are reduced to the centre. A wheel that
    /// lies flat has no lowest point. A run that comes there ends with a fault (Meijaard,
    /// Papadopoulos, Ruina and Schwab 2007).
    #[doc(alias("disc", "disk", "tyre", "tire"))]
    pub joint RollingWheel(
        i, j;
        center: Point,
        axle: Axis,
        point: Point,
        normal: Axis,
        radius: Length,
        crown: Length = 0.0,
    ) {
        let lean = dot(i.normal, j.axle);
        let down = (lean * j.axle - i.normal) / sqrt(1.0 - lean * lean);
        let arm = (radius - crown) * down - crown * i.normal;
        let above = j.center - i.point;
        dot(i.normal, above + arm);
        let slip = rate(above) - cross(angular_velocity(i), above)
            + cross(angular_velocity(i, j), arm);
        dot(i.normal.normals(), slip);
    }
}

crate::joint! {
    /// A ball `j` rolls on a plane of `i` without slip. The ball has its `center`, which need not
    /// be that of its mass, and its `radius` (m). The plane goes through `point`; its `normal`
    /// points to the ball.
    ///
    /// One equation of positions and two of velocities, as of [`RollingWheel`]. The ball may spin
    /// about the normal. Reactions are reduced to the centre (Neimark and Fufaev 1972).
    pub joint RollingBall(i, j; center: Point, point: Point, normal: Axis, radius: Length) {
        let above = j.center - i.point;
        dot(i.normal, above) - radius;
        let slip = rate(above) - cross(angular_velocity(i), above)
            - radius * cross(angular_velocity(i, j), i.normal);
        dot(i.normal.normals(), slip);
    }
}
