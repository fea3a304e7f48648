//! Names that a definition does not declare, and names that it may not declare.

holonom::joint! {
    pub joint Names(i, j; point: Point, axis: Axis, length: Length) {
        k.point - i.point;
        j.piont - i.point;
        j.length;
        j.0;
        point - i.point;
        lenght - 1.0;
        width - 1.0;
        dt(i.axis, j.axis);
        sqr(length);
        f.g(i.axis);
        (i + j).point;
        i.point - crate::ORIGIN;
        angle about axes;
        angle about axis;
        angle about axis;
    }
}

holonom::joint! {
    pub joint Declared(i, ground, i; point: Pont, axis: Axis, between: Length, axis: Vector, size: Mass, time: Number) {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Three(i, j, k; axis: Axis) {
        dot(i.axis, k.axis);
        angle about axis;
    }
}

holonom::joint! {
    pub joint Nobody(; length: Length) {
        length;
    }
}

holonom::joint! {
    pub joint Nothing(i, j) {}
}

fn main() {}
