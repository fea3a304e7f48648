//! Drivers: coordinates as explicit functions of time.

crate::joint! {
    /// A motor of given motion: the angle of `j` against `i` about `axis` is `motion` (rad),
    /// right-handed, zero in the reference configuration. Turns are counted by an auxiliary
    /// variable of the state.
    ///
    /// Only this equation: a `Revolute` or another joint says where the axis is. The driving effort
    /// is the moment of the motor (N m).
    #[doc(alias("RotationalMotor"))]
    pub joint AngleDriver(i, j; axis: Axis, motion: Law) {
        drive angle(i, j, axis) to motion();
        angle about axis;
    }
}

crate::joint! {
    /// A cylinder of given motion: the distance of the point `tail` of `j` from the point `head` of
    /// `i` is `motion` (m), never zero.
    ///
    /// The driving effort (N) pushes the points apart where it is positive.
    pub joint DistanceDriver(i, j; head: Point, tail: Point, motion: Law) {
        drive length(j.tail - i.head) to motion();
        displacement length(j.tail - i.head);
    }
}

crate::joint! {
    /// A linear motor of given motion: the point of `j` is displaced against that of `i` along an
    /// axis of `i` by `motion` (m), zero in the reference configuration.
    ///
    /// The driving effort (N) acts on `j` along the axis.
    #[doc(alias("LinearMotor"))]
    pub joint DisplacementDriver(i, j; point: Point, axis: Axis, motion: Law) {
        drive dot(i.axis, j.point - i.point) to motion();
        displacement dot(i.axis, j.point - i.point);
    }
}

crate::joint! {
    /// An orientation of given motion: `j` is turned against `i` by the angle `motion` (rad) about
    /// `axis`, which is fixed on both; zero in the reference configuration. Points are not
    /// constrained.
    ///
    /// The driving effort is the moment about the axis (N m).
    pub joint OrientationDriver(i, j; axis: Axis, motion: Law) {
        dot(i.axis.normals(), j.axis);
        drive angle(i, j, axis) to motion();
        angle about axis;
        require dot(i.axis, j.axis) > 0;
    }
}
