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
        contact j.center + arm, i.normal;
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
        contact j.center - radius * i.normal, i.normal;
        let slip = rate(above) - cross(angular_velocity(i), above)
            - radius * cross(angular_velocity(i, j), i.normal);
        dot(i.normal.normals(), slip);
    }
}

crate::joint! {
    /// A ball `j` rolls without slip in a spherical bowl of `i`, about whose centre `bowl` the
    /// radius `bowl_radius` (m) is. With a negative one the ball rolls on the outside of a sphere.
    /// The ball has its `center` and its `radius` (m). `axis` goes from the centre of the bowl to
    /// its bottom, or the other way.
    ///
    /// One equation of positions and two of velocities. The ball may spin about the line of the
    /// centres. Reactions are reduced to the centre of the ball. Where that line is perpendicular
    /// to `axis`, at the rim of half a sphere, the two equations are one. A run that comes there
    /// ends with a fault or warns (Neimark and Fufaev 1972).
    pub joint RollingBallInBowl(
        i, j;
        center: Point,
        bowl: Point,
        axis: Axis,
        radius: Length,
        bowl_radius: Length,
    ) {
        let gap = bowl_radius - radius;
        let line = j.center - i.bowl;
        let outward = line / gap;
        0.5 * (dot(outward, line) - gap);
        contact j.center + radius * outward, -outward;
        let slip = rate(line) - cross(angular_velocity(i), line)
            + radius * cross(angular_velocity(i, j), outward);
        dot(cross(i.axis.normals(), outward), slip);
    }
}

crate::joint! {
    /// Two wheels `j` and `k` of one axle roll on a plane of `i` without slip, as those of a robot
    /// with a differential drive. The wheels have their centres, `center_j` and `center_k`, the
    /// same `axle` and the same `radius` (m). The plane goes through `point`; its `normal` points
    /// to the wheels.
    ///
    /// Two equations of positions: the centres are at the height of the radius. Three of
    /// velocities: neither wheel slips along the plane, which is one equation less than of two
    /// wheels, since the axle moves sideways as a whole. That the wheels turn about the axle is for
    /// other joints to say (a `Revolute` of each with what they carry). What they carry may lean
    /// about the axle (Campion, Bastin and d'Andrea-Novel 1996).
    #[doc(alias("differential", "track", "robot", "cart"))]
    pub joint WheelPair(
        i, j, k;
        center_j: Point,
        center_k: Point,
        axle: Axis,
        point: Point,
        normal: Axis,
        radius: Length,
    ) {
        let first = j.center_j - i.point;
        let second = k.center_k - i.point;
        dot(i.normal, first) - radius;
        dot(i.normal, second) - radius;
        let slip = rate(first) - cross(angular_velocity(i), first)
            - radius * cross(angular_velocity(i, j), i.normal);
        dot(j.axle, slip);
        let along = cross(j.axle, i.normal);
        dot(along, slip);
        dot(
            along,
            rate(second) - cross(angular_velocity(i), second)
                - radius * cross(angular_velocity(i, k), i.normal),
        );
    }
}

crate::joint! {
    /// Two bodies `i` and `j` roll on each other at a `point` of their carrier `k`. Their material
    /// points there have the same velocity along `tangent`, which is fixed on `k`. Cylinders,
    /// bevels and crossed axes in mesh, friction wheels.
    ///
    /// One equation of velocities. Radii are the distances of the axes from the point. They push
    /// each other there along `tangent`, and the carrier feels nothing of it. That the two turn
    /// about axes is for other joints to say (a `Revolute` of each with `k`, which may be the
    /// ground). Angles may drift against each other by the errors of integration; those of a
    /// [`Gear`](crate::joints::Gear) do not (Nikravesh 1988, section 7.2.6).
    #[doc(alias("gear", "bevel", "mesh"))]
    pub joint RollingPair(i, j, k; point: Point, tangent: Axis) {
        let of_first = rate(i.origin) + cross(angular_velocity(i), k.point - i.origin);
        let of_second = rate(j.origin) + cross(angular_velocity(j), k.point - j.origin);
        dot(k.tangent, of_second - of_first);
    }
}
