//! The spherical joint.

crate::joint! {
    /// A ball: the points of both bodies coincide; three rotations are left (Nikravesh 1988,
    /// section 7.2.1; Flores 2015, section 8.2).
    #[doc(alias("Ball", "BallJoint", "BallAndSocket", "SphericalJoint", "PointToPoint"))]
    pub joint Spherical(i, j; point: Point) {
        j.point - i.point;
        motion ball at point;
    }
}
