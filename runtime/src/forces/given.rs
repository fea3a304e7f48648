//! Given forces and moments.

crate::force! {
    /// A force (N) at the point of `j`, fixed in the axes of `i`: constant where `i` is the ground.
    /// There is no reaction on `i`.
    #[doc(alias("ExternalForce"))]
    pub force PointForce(i, j; point: Point, force: Vector) {
        force i.force at j.point;
    }
}

crate::force! {
    /// A force (N) at the point of `j` that turns with it.
    pub force FollowerForce(j; point: Point, force: Vector) {
        force j.force at j.point;
    }
}

crate::force! {
    /// A moment (N m) on `j`, fixed in the axes of `i`: constant where `i` is the ground. There is
    /// no reaction on `i`.
    pub force ConstantMoment(i, j; moment: Vector) {
        moment i.moment on j;
    }
}

crate::force! {
    /// A moment (N m) on `j` that turns with it.
    pub force FollowerMoment(j; moment: Vector) {
        moment j.moment on j;
    }
}
