//! Forces of the wrong shape.

holonom::force! {
    /// What belongs into a joint.
    pub force Equations(i, j; point: Point, axis: Axis) {
        j.point - i.point;
        drive angle(i, j, axis) to time;
        angle about axis;
        displacement dot(i.axis, j.point - i.point);
    }
}

holonom::force! {
    /// Potentials and efforts.
    pub force Shapes(i, j; head: Point, tail: Point, axis: Axis, stiffness: Number) {
        let d = length(j.tail - i.head);
        potential rate(d);
        potential j.tail - i.head;
        potential;
        -stiffness * d along j.tail - i.head;
        i.axis along d;
        -stiffness * d along rate(d);
        -stiffness along;
        along d;
        rate(rate(d)) along d;
        rate(i.axis) along d;
        rate(d, d) along d;
        initial(rate(d)) along d;
        stifness along d;
        d;
        along;
    }
}

holonom::force! {
    /// Forces at points, moments on bodies.
    pub force Applied(i, j; point: Point, axis: Axis, force: Vector, size: Number) {
        force j.force at i.point + i.axis;
        force j.force at j.axis;
        force j.force at j;
        force j.force at fixed(j, i.point);
        force size at j.point;
        force j.force;
        force j.force on j;
        force i.axis.normals() at j.point;
        force k.force at j.point;
        moment j.force on j.point;
        moment size on j;
        moment j.force on k;
        moment j.force;
        moment j.force at j.point;
    }
}

holonom::force! {
    /// Names.
    pub force Names(i, j; axis: Axis, effort: Law(angle)) {
        effort(angle(i, j, axle)) along angle(i, j, axis);
        effort along angle(i, j, axis);
        effort(k) along angle(i, m, axis);
        effort() along angle(i, j, axis);
    }
}

holonom::force! {
    pub force Idle(i, j; point: Point) {}
}

holonom::force! {
    pub force Lettered(i, j; point: Point) {
        let d = length(j.point - i.point);
    }
}

holonom::force! {
    pub force Bodiless(; stiffness: Number) {
        potential stiffness;
    }
}

holonom::force! {
    pub joint Hinge(i, j; point: Point) {
        j.point - i.point;
    }
}

holonom::force! {
    pub Spring(i, j; point: Point) {
        potential length(j.point - i.point);
    }
}

holonom::force! {
    pub force Headless {
        potential 1.0;
    }
}

holonom::force! {
    pub force Braceless(i, j; point: Point);
}

holonom::force! {
    force
}

holonom::force! {}

fn main() {
    let _ = (Equations, Shapes, Applied, Names, Idle, Lettered, Bodiless, Headless, Braceless);
}
