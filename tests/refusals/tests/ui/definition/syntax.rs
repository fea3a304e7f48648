//! Definitions that cannot be read; their types exist all the same.

holonom::joint! {
    pub Hinge(i, j; point: Point) {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Bodiless {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Braceless(i, j; point: Point);
}

holonom::joint! {
    pub joint Halves(i, j; point: Point; length: Length) {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Kinds(i, 3; point, axis = Axis, length: 2.0) {
        j.point - i.point;
    }
}

holonom::joint! {
    pub joint Equations(i, j; point: Point, axis: Axis) {
        j.point - ;
        j.point - i.point j.axis;;
        angle about ;
        angle about axis point;
        angle about axis + 1.0
    }
}

holonom::joint! {
    pub joint First(i) {
        i.origin;
    }
    pub joint Second(i) {
        i.origin;
    }
}

holonom::joint! {}

holonom::joint! {
    joint
}

fn main() {
    let _ = (Bodiless, Braceless, Halves, Kinds, Equations, First);
}
