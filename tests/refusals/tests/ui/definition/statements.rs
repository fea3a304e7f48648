//! What a joint says besides its equations.

holonom::joint! {
    /// Everything twice.
    pub joint Twice(i, j; point: Point, axis: Axis, motion: Law) {
        drive dot(i.axis, j.point - i.point) to motion();
        drive angle(i, j, axis) to motion();
        displacement dot(i.axis, j.point - i.point);
        displacement angle(i, j, axis);
        angle about axis;
        angle about axis;
    }
}

holonom::joint! {
    /// Halves of statements, and operands of the wrong shape.
    pub joint Halves(i, j; point: Point, axis: Axis, motion: Law) {
        drive angle(i, j, axis);
        drive to motion();
        drive j.point - i.point to motion();
        drive angle(i, j, axis) to i.axis;
        drive angle(i, j, axis) at motion();
        displacement j.point - i.point;
        displacement;
        let;
        let x;
        let 3 = length(i.axis);
    }
}

holonom::joint! {
    /// Names that are taken.
    pub joint Named(i, j; point: Point, axis: Axis) {
        let i = j.point - i.point;
        let axis = j.point - i.point;
        let d = j.point - i.point;
        let d = squared(d);
        let time = 3.0;
        let drive = 3.0;
        let wrong = lenght(d);
        wrong * 2.0;
        squared(e);
    }
}

holonom::joint! {
    /// What a force does.
    pub joint Forceful(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        potential 0.5 * squared(j.point - i.point);
        -1.0 along angle(i, j, axis);
        force i.axis at j.point;
        moment i.axis on j;
    }
}

holonom::joint! {
    pub force Spring(i, j; head: Point, tail: Point) {
        potential length(j.tail - i.head);
    }
}

fn main() {}
