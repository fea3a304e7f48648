//! Springs and dampers.

crate::force! {
    /// A spring and a damper between the point `head` of `i` and the point `tail` of `j`, in
    /// parallel: they pull with `stiffness (d - free_length) + damping d'` (N), where `d` is the
    /// distance of the points (m). The force turns round where the points pass each other, which a
    /// run finds. At rest at zero there is no direction, and the force is not finite; a
    /// `free_length` of a literal 0 without damping needs none. Stiffness in N/m, damping in N s/m,
    /// potential energy
    /// `stiffness (d - free_length)^2 / 2` (Nikravesh 1988, section 9.3.4).
    #[doc(alias("Spring", "Damper", "LinearSpring"))]
    pub force SpringDamper(
        i, j; head: Point, tail: Point, stiffness: Number, damping: Number = 0.0, free_length: Length
    ) {
        let d = length(j.tail - i.head);
        potential 0.5 * stiffness * (d - free_length) * (d - free_length);
        -damping * rate(d) along d;
    }
}

crate::force! {
    /// A damper against all rotation of `j` against `i`, for a ball joint or no joint at all: the
    /// moment `-damping w` (N m) acts on `j`, and the opposite on `i`, with the angular velocity
    /// `w` (rad/s) of `j` against `i`. Damping in N m s/rad, the same about every axis; power
    /// `-damping w . w`. About one axis alone it is a [`TorsionalSpringDamper`] without stiffness.
    pub force RotationalDamper(i, j; damping: Number) {
        let w = angular_velocity(i, j);
        moment -damping * w on j;
        moment damping * w on i;
    }
}

crate::force! {
    /// A spring and a damper on the angle of `j` against `i` about `axis`, in parallel: they turn
    /// `j` back by `stiffness (a - free_angle) + damping a'` (N m), where `a` is the angle (rad),
    /// right-handed, zero in the reference configuration; turns are counted by an auxiliary
    /// variable of the state. Stiffness in N m/rad, damping in N m s/rad, potential energy
    /// `stiffness (a - free_angle)^2 / 2` (Nikravesh 1988, section 9.3.5).
    #[doc(alias("TorsionSpring", "RotationalSpring", "TorsionalSpring"))]
    pub force TorsionalSpringDamper(
        i, j; axis: Axis, stiffness: Number, damping: Number = 0.0, free_angle: Angle = 0.0
    ) {
        let a = angle(i, j, axis);
        potential 0.5 * stiffness * (a - free_angle) * (a - free_angle);
        -damping * rate(a) along a;
    }
}
