//! A joint with parameters, a default, a driver and readings.

kinematics::joint! {
    /// A telescopic arm: `j` slides along an axis of `i`, as far as `reach` says (m), and turns
    /// with it by `lead` (m) a turn. 6 equations.
    pub joint Telescope(i, j; point: Point, axis: Axis, reach: Law, lead: Length = 0.5) {
        let extension = dot(i.axis, j.point - i.point);
        dot(i.axis.normals(), j.axis);
        dot(i.axis.normals(), j.point - i.point);
        drive extension to reach();
        extension - lead / TAU * angle(i, j, axis);
        angle about axis;
        displacement extension;
    }
}
