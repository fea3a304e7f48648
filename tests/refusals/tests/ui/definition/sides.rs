//! Which of the configurations that satisfy the equations is meant.

holonom::joint! {
    /// Nothing to compare with zero.
    pub joint Halves(i, j; axis: Axis) {
        dot(i.axis.normals(), j.axis);
        require dot(i.axis, j.axis);
        require dot(i.axis, j.axis) < 0;
        require dot(i.axis, j.axis) > 1;
        require dot(i.axis, j.axis) >= 0;
        require 0 > dot(i.axis, j.axis);
        require > 0;
        require;
    }
}

holonom::joint! {
    /// What is no scalar, and what is no matter of places.
    pub joint Shapes(i, j; axis: Axis, speed: Number, ramp: Law) {
        dot(i.axis.normals(), j.axis);
        require j.axis > 0;
        require dot(i.axis.normals(), j.axis) > 0;
        require rate(dot(i.axis, j.axis)) > 0;
        require time * dot(i.axis, j.axis) > 0;
        require ramp() * dot(i.axis, j.axis) > 0;
        require angle(i, j, axis) > 0;
        require speed > 0;
    }
}

holonom::force! {
    /// A force has no sides.
    pub force Push(i, j; axis: Axis, point: Point) {
        force i.axis at j.point;
        require dot(i.axis, j.axis) > 0;
    }
}

fn main() {}
