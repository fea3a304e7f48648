//! Forces along a length or an angle, any function of it, its rate and time.

crate::force! {
    /// An actuator between the point `head` of `i` and the point `tail` of `j`: `force` (N) pushes
    /// them apart where it is positive. It is an expression of `length` (m, the distance of the
    /// points, not at rest at zero), `rate` (m/s) and `time` (s), as in
    /// `force = -1000.0 * (length - 0.5) - 3.0 * rate`.
    #[doc(alias("LinearActuator", "Cylinder", "Ram"))]
    pub force Actuator(i, j; head: Point, tail: Point, force: Law(length, rate)) {
        let d = length(j.tail - i.head);
        force(d, rate(d)) along d;
    }
}

crate::force! {
    /// An actuator about an axis: `moment` (N m) acts on `j`, and the opposite on `i`, right-handed
    /// about `axis`. It is an expression of `angle` (rad, of `j` against `i`, zero in the reference
    /// configuration), `rate` (rad/s) and `time` (s), as in
    /// `moment = 0.5 * sin(10.0 * time) - 0.1 * rate`. Turns are counted by an auxiliary variable
    /// of the state where the law reads the angle.
    #[doc(alias("Motor", "Torque", "RotaryActuator"))]
    pub force TorsionalActuator(i, j; axis: Axis, moment: Law(angle, rate)) {
        let a = angle(i, j, axis);
        moment(a, rate(a)) along a;
    }
}
